"""How deeply tables and lists may lie in each other."""

from __future__ import annotations

from collections.abc import Mapping

from tribo.core.errors import CaseError

LEVELS = 100
"""Far more than a case needs, and far fewer than exhaust Python's recursion."""


def check_depth(data: object, what: object) -> None:
    """Raise `CaseError` that names `what` if tables or lists in `data` nest too deeply."""
    waiting = [(data, 0)]
    while waiting:
        inside, level = waiting.pop()
        if level > LEVELS:
            raise too_deep(what)
        if isinstance(inside, Mapping):
            waiting += [(value, level + 1) for value in inside.values()]
        elif isinstance(inside, list | tuple):
            waiting += [(value, level + 1) for value in inside]


def too_deep(what: object) -> CaseError:
    """Return the error of what nests too deeply."""
    return CaseError(
        f"{what}: tables or lists are nested too deeply; at most {LEVELS} levels are allowed"
    )
