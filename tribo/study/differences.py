"""How far the fields of one result are from those of another, at a time both saved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.result.export import profile
from tribo.result.read import SAME_TIME, Result

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


def same_grid(one: Result, other: Result) -> bool:
    """Whether two results have the same window and cells, so that fields compare cell by cell."""
    return one.grid.size == other.grid.size and one.grid.cells == other.grid.cells


def differences(result: Result, reference: Result, time: float) -> list[Difference]:
    """Return how far the pressure and the wear depths are from the reference.

    On the same grid the norms run over all cells; else over the sections along
    and across sliding through the centre, at those of the reference's positions
    that lie in both windows. Values there are interpolated linearly, and
    extrapolated over the last half cell.

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
    save, of_reference = result.save_at(time), reference.save_at(time)
    fields = {PRESSURE: (result.field("pressure", save), reference.field("pressure", of_reference))}
    for name in reference.body_names:
        fields[f"bodies.{name}.wear_depth"] = (
            result.field("wear_depth", save, name),
            reference.field("wear_depth", of_reference, name),
        )
    found = []
    for field, (values, expected) in fields.items():
        if not whole:
            values, expected = _sections(values, expected, result.grid, reference.grid)
        largest = float(np.max(np.abs(expected), initial=0.0))
        if largest > 0:
            # Relative from here on, for squares of small depths may underflow.
            off, expected = (values - expected) / largest, expected / largest
            found.append(
                Difference(
                    field,
                    l2=float(np.sqrt(np.sum(off**2) / np.sum(expected**2))),
                    largest=float(np.max(np.abs(off))),
                )
            )
    return found


def _sections(field: Array, expected: Array, grid: Grid, on: Grid) -> tuple[Array, Array]:
    """Return both sections of two fields where the windows of both reach, on the grid `on`."""
    values, there = [], []
    for axis in (0, 1):
        own, positions = (grid.x, grid.y)[axis], (on.x, on.y)[axis]
        inside = np.abs(positions) <= 0.5 * grid.size[axis]
        # A cell more at each end continues the line there; a single cell is even.
        at, known = (
            np.pad(v, 1, "reflect", reflect_type="odd") for v in (own, profile(field, axis))
        )
        values.append(np.interp(positions[inside], at, known))
        there.append(profile(expected, axis)[inside])
    return np.concatenate(values), np.concatenate(there)
