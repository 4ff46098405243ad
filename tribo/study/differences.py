"""How far the fields of one result are from those of another, at a time both saved."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.results.export import profile
from tribo.results.read import SAME_TIME, Result

PRESSURE = "pressure"


@dataclass(frozen=True)
class Difference:
    """A field against that of the reference, relative to the latter.

    Parameters
    ----------
    field : str
        ``"pressure"``, or ``"bodies.NAME.wear_depth"``.
    l2 : float
        √(Σ(f − f₀)²/Σf₀²), f₀ being the reference's.
    largest : float
        Largest magnitude of f − f₀ over that of f₀.
    """

    field: str
    l2: float
    largest: float


def common_times(results: Sequence[Result]) -> list[float]:
    """Return the times, in s, at which all results hold a save."""
    first, *others = (result.times for result in results)
    return [float(time) for time in first if all(_has(times, time) for times in others)]


def _has(times: Array, time: float) -> bool:
    return bool(np.any(np.abs(times - time) <= SAME_TIME * np.max(times, initial=0.0)))


def common_bodies(results: Sequence[Result]) -> list[str]:
    """Return the names of the bodies that all results have."""
    return [
        name
        for name in results[0].body_names
        if all(name in result.body_names for result in results)
    ]


def same_grid(one: Result, other: Result) -> bool:
    """Whether two results have the same window and cells, so that fields compare cell by cell."""
    return one.grid.size == other.grid.size and one.grid.cells == other.grid.cells


def differences(result: Result, reference: Result, time: float) -> list[Difference]:
    """Return how far the pressure and the wear depths are from the reference.

    On the same grid the norms run over all cells; else over the sections along
    and across sliding through the centre, put on to the reference's positions
    by linear interpolation.

    Parameters
    ----------
    result, reference : Result
        What to compare, with what.
    time : float
        Of a save of both, in s.

    Returns
    -------
    list of Difference
        Without those fields that are zero in the reference.
    """
    whole = same_grid(result, reference)
    found = []
    pairs = zip(_fields(result, reference, time), _fields(reference, reference, time), strict=True)
    for (name, field), (_, of_reference) in pairs:
        if whole:
            values, expected = field, of_reference
        else:
            values = _sections(field, result, reference)
            expected = _sections(of_reference, reference, reference)
        largest = float(np.max(np.abs(expected)))
        if largest > 0:
            off = values - expected
            found.append(
                Difference(
                    name,
                    l2=float(np.sqrt(np.sum(off**2) / np.sum(expected**2))),
                    largest=float(np.max(np.abs(off))) / largest,
                )
            )
    return found


def _fields(result: Result, reference: Result, time: float) -> Iterator[tuple[str, Array]]:
    save = result.save_at(time)
    yield PRESSURE, result.pressure(save)
    for name in common_bodies([reference, result]):
        yield f"bodies.{name}.wear_depth", result.wear_depth(name, save)


def _sections(field: Array, result: Result, reference: Result) -> Array:
    """Return both sections of a field at the reference's positions; nothing is outside a window."""
    grids = (result.grid, reference.grid)
    (x, y), (at_x, at_y) = ((grid.x, grid.y) for grid in grids)
    return np.concatenate(
        [
            np.interp(at_x, x, profile(field, 0), left=0.0, right=0.0),
            np.interp(at_y, y, profile(field, 1), left=0.0, right=0.0),
        ]
    )
