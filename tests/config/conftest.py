from __future__ import annotations

import importlib
from pathlib import Path
from types import ModuleType

import pytest


@pytest.fixture
def dummies(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The module `dummies_in_tables`, importable by name as pickling needs it."""
    monkeypatch.syspath_prepend(Path(__file__).parent)
    return importlib.import_module("dummies_in_tables")
