"""The package of compiled code, where it is installed."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType


@cache
def compiled() -> ModuleType | None:
    """Return tribo-fast, or None where it is not installed."""
    return import_module("tribo_fast") if find_spec("tribo_fast") else None
