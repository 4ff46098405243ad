"""Values so far from the usual that a wrong or missing unit is likely."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from tribo.case import Case
from tribo.config.overrides import leaves
from tribo.core import findings
from tribo.core.errors import CaseError, NumericalError, PluginError
from tribo.core.explain import path
from tribo.core.findings import Finding


def unusual(case: Case) -> list[Finding]:
    """Return a question about each quantity of a case that is out of its usual range."""
    found: dict[str, Finding] = {}
    for place, value, mark in leaves(case):
        if not (mark and mark.usual and isinstance(value, float)):
            continue
        if doubt := mark.doubt(value):
            while isinstance(place[-1], int):
                # A pair may be written as one value.
                place = place[:-1]
            limit = min(mark.usual, key=lambda end: abs(end - value))
            found[path(place)] = findings.unusual(path(place), doubt, value, limit)
    return [*found.values()]


@contextmanager
def doubting(case: Case) -> Iterator[None]:
    """Begin the error of a failing calculation with each value of the case that is unusual."""
    try:
        yield
    except PluginError:
        raise
    except (CaseError, NumericalError) as error:
        doubts = unusual(case)
        if doubts:
            # First: what follows from a wrong unit has remedies that mislead.
            error.args = (" ".join([*(doubt.words for doubt in doubts), str(error)]),)
        raise
