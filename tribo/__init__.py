"""tribo: simulate wear, with every model a plugin.

Everything that a user types and a plugin needs is a name of this package; what
lies in its modules is not part of the contract. Names are imported when first
used, so that ``import tribo`` stays fast; ``__init__.pyi`` lists them.
"""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path

_STUB = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
_HOME = {name: module for module, name in re.findall(r"from (\S+) import (\w+)", _STUB)}

__all__ = [*_HOME]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'tribo' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(_HOME)
