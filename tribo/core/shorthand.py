"""Functions of higher layers behind methods of lower layers, such as ``case.check()``.

`tribo` states the module of each, so that no module names a module above it.
"""

from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

PLACES: dict[str, str] = {}
"""Module and name of each, as ``"tribo.study.check:check_case"``."""


def call(name: str, *given: "Any", **options: "Any") -> "Any":
    """Call a function of a higher layer, whose module is imported by then."""
    module, _, function = PLACES[name].partition(":")
    return getattr(import_module(module), function)(*given, **options)
