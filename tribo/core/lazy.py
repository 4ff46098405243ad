"""Names of a package that are imported when first used, listed in its stub."""

from functools import cache
from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any


@cache
def homes(file: str) -> dict[str, str]:
    """Return the names of a module that has a stub, each with the module where it is."""
    # As `python -m tribo` begins, these might come from the folder that it was started in.
    import re
    from pathlib import Path

    stub = Path(file).with_suffix(".pyi").read_text(encoding="utf-8")
    return {name: home for home, name in re.findall(r"from (\S+) import (\w+) as", stub)}


def lazy(module: str, file: str) -> "Callable[[str], Any]":
    """Return ``__getattr__`` of a module whose stub (.pyi) says where each of its names is.

    Parameters
    ----------
    module, file : str
        The module's ``__name__`` and ``__file__``.
    """

    def get(name: str) -> "Any":
        if name == "__all__":
            return [*homes(file)]
        if name in homes(file):
            return getattr(import_module(homes(file)[name]), name)
        raise AttributeError(f"module {module!r} has no attribute {name!r}")

    return get
