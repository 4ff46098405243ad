"""Values so far from the usual that a slip of units is more likely than what they say."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from tribo.case import Case
from tribo.config.usual import unusual
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError, NumericalError, PluginError

DEEP = 0.1
"""Wear depth, relative to the radius of curvature, from which on it is doubted."""


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
            # First: what follows from a forgotten unit has remedies that mislead.
            error.args = (f"{' '.join(doubts)} {error}",)
        raise


def too_deep(system: ContactSystem, depths: Mapping[str, float]) -> list[str]:
    """Ask about each body whose wear depth, in m, is implausible for the contact's curvature."""
    curvature = max(system.curvature or (0.0, 0.0))
    return [
        f"{name} would wear about {1e3 * depth:.3g} mm deep, which is {depth * curvature:.3g} "
        f"times the radius of curvature of {1e3 / curvature:.3g} mm: is its wear coefficient in "
        "the unit that was meant? A bare k is in 1/Pa; write '1e-6 mm^3/(N m)' for that unit"
        for name, depth in depths.items()
        if depth * curvature > DEEP
    ]
