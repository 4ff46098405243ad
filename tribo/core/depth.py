"""The limit on how deeply tables and lists of a case may nest."""

from __future__ import annotations

from collections.abc import Mapping

from tribo.core.errors import CaseError

LEVELS = 100
"""Far more than a case needs, and far fewer than exhaust Python's recursion."""


def check_depth(data: object, what: object, levels: int = LEVELS) -> None:
    """Raise `CaseError` that names `what` if tables or lists nest deeper than `levels`."""
    if levels < 0:
        raise nested_too_deeply(what)
    if isinstance(data, Mapping | list | tuple):
        for part in data.values() if isinstance(data, Mapping) else data:
            check_depth(part, what, levels - 1)


def nested_too_deeply(what: object) -> CaseError:
    """Return the error for tables or lists of `what` that nest too deeply."""
    return CaseError(
        f"{what}: tables or lists are nested too deeply; at most {LEVELS} levels are allowed"
    )
