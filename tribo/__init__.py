"""tribo: simulate wear, with every model a plugin.

Everything that a user types and a plugin needs is a name of this package; what
lies in its modules is not part of the contract. Names are imported when first
used, so that ``import tribo`` stays fast; ``__init__.pyi`` lists them.
"""

from functools import cache
from importlib import import_module


@cache
def _homes() -> dict[str, str]:
    """Return the module of each name."""
    # `python -m tribo` begins with this file, and a folder that it was started in may have others.
    import re
    from pathlib import Path

    stub = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
    return {name: module for module, name in re.findall(r"from (\S+) import (\w+)", stub)}


def __getattr__(name: str) -> object:
    homes = _homes()
    if name == "__all__":
        return [*homes]
    if name in homes:
        return getattr(import_module(homes[name]), name)
    raise AttributeError(f"module 'tribo' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(_homes())
