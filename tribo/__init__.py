"""tribo: simulate wear, with every model a plugin.

Everything that a user types and a plugin needs is a name of this package; what
lies in its modules is not part of the contract. Names are imported when first
used, so that ``import tribo`` stays fast; ``__init__.pyi`` lists them.
"""

# `python -m tribo` begins here, and a folder that it was started in may have modules of the names
# of Python's, even a `__future__`: these import only what Python starts with.
from tribo.core.lazy import lazy
from tribo.methods import bind
from tribo.packages import NAMES, how_to_install

bind()
_get = lazy(__name__, __file__)


def __getattr__(name: str) -> object:
    if name in NAMES:
        package = NAMES[name]
        raise ImportError(
            f"{name!r} comes with {package}: {how_to_install(package)}, and "
            f"from {package.replace('-', '_')} import {name}"
        )
    return _get(name)


def __dir__() -> list[str]:
    return sorted(_get("__all__"))
