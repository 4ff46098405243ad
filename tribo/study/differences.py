"""Differences between the fields of two results at one time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.result.export import profile
from tribo.result.read import Result


class Difference(NamedTuple):
    """Difference of a field f from the reference's field f₀, relative to f₀."""

    l2: float
    """√(Σ(f − f₀)²/Σf₀²)."""
    largest: float
    """Largest magnitude of f − f₀ over the largest magnitude of f₀."""


def differences(result: Result, reference: Result, time: float) -> dict[str, Difference]:
    """Return the differences of pressure and wear depths from the reference, by field, at a save.

    Fields are ``"pressure"`` and ``"bodies.NAME.wear_depth"``, without those that are zero in the
    reference. On the same grid the norms run over all cells; else over the sections along and
    across sliding through the centre, at the reference's positions in both windows. Values there
    are interpolated linearly, and extrapolated over the last half cell.
    """
    saves = [(each, each.save_at(time)) for each in (result, reference)]
    pairs = {"pressure": [each.field("pressure", save) for each, save in saves]}
    for name in reference.body_names:
        depths = [each.field("wear_depth", save, name) for each, save in saves]
        pairs[f"bodies.{name}.wear_depth"] = depths
    found = {}
    for name, (values, expected) in pairs.items():
        if result.grid != reference.grid:
            values, expected = _sections(values, expected, result.grid, reference.grid)
        largest = float(np.max(np.abs(expected), initial=0.0))
        if largest > 0:
            # Squares of small depths may underflow, so scale first.
            off, expected = (values - expected) / largest, expected / largest
            found[name] = Difference(
                l2=float(np.sqrt(np.sum(off**2) / np.sum(expected**2))),
                largest=float(np.max(np.abs(off))),
            )
    return found


def _sections(field: Array, expected: Array, grid: Grid, on: Grid) -> tuple[Array, Array]:
    """Return both sections of two fields where the windows of both reach, on the grid `on`."""
    values, there = [], []
    for axis in (0, 1):
        own, positions = (grid.x, grid.y)[axis], (on.x, on.y)[axis]
        inside = np.abs(positions) <= 0.5 * grid.size[axis]
        # One more cell at each end, for linear extrapolation; a single cell is constant.
        at, known = (
            np.pad(v, 1, "reflect", reflect_type="odd") for v in (own, profile(field, axis))
        )
        values.append(np.interp(positions[inside], at, known))
        there.append(profile(expected, axis)[inside])
    return np.concatenate(values), np.concatenate(there)
