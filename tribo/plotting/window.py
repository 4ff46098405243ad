"""What part of a result a picture shows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.result.read import Result

MARGIN = 0.2
"""Shown beyond the contact or the scar on each side, in parts of its half-width."""

Limits = tuple[float, float]


def number_of_saves(result: Result) -> int:
    """Return how many saves there are.

    Raises
    ------
    CaseError
        If there is none.
    """
    count = len(result.times)
    if count == 0:
        raise CaseError(f"{result.name} holds no save yet; there is nothing to draw")
    return count


def checked_save(result: Result, save: int) -> int:
    """Return the number of a save, counted from the end where negative.

    Raises
    ------
    CaseError
        If there is no such save.
    """
    count = number_of_saves(result)
    if not -count <= save < count:
        raise CaseError(f"{result.name} has no save {save}; it has {count}, counted from 0")
    return save % count


def limits(marked: Mask, grid: Grid, axis: int, reach: float = 0.0) -> Limits:
    """Return limits in m that show all marked cells, a margin, and no more.

    Parameters
    ----------
    marked : ndarray of bool, shape (nx, ny) or (1, ny)
        What to show; the whole window if nothing is marked.
    grid : Grid
        The window.
    axis : int
        0 for x, 1 for y.
    reach : float, optional
        Distance from the origin to be shown as well, in m.
    """
    edge = 0.5 * grid.size[axis]
    index = np.flatnonzero(np.broadcast_to(marked, grid.cells).any(axis=1 - axis))
    if index.size == 0:
        return -edge, edge
    step = grid.spacing[axis]
    low = min(float(index[0]) * step - edge, -reach)
    high = max(float(index[-1] + 1) * step - edge, reach)
    margin = MARGIN * max(0.5 * (high - low), 2.0 * step)
    return max(low - margin, -edge), min(high + margin, edge)


def section_limits(marked: Mask, grid: Grid, axis: int, reach: float = 0.0) -> Limits:
    """Return the `limits` of a section, which ends at the centres of the outermost cells."""
    low, high = limits(marked, grid, axis, reach)
    x = positions(grid, axis)
    return max(low, float(x[0])), min(high, float(x[-1]))


def joined(windows: Iterable[Limits]) -> Limits:
    """Return limits around all of `windows`."""
    lows, highs = zip(*windows, strict=True)
    return min(lows), max(highs)


def positions(grid: Grid, axis: int) -> Array:
    """Return the cells' centres along an axis, 0 or 1, in m."""
    return (grid.x, grid.y)[axis]


def removed(result: Result, name: str) -> Array:
    """Return how far a body's surface lies below its first at each save, in m."""
    body = result.body(name)
    return np.asarray(body.wear_depth + body.plastic_depth)


def scar_mask(depth: Array) -> Mask:
    """Return where more than a thousandth of the largest depth is gone."""
    deepest = float(np.max(depth, initial=0.0))
    return np.asarray(depth > 1e-3 * deepest)


def spread(parts: Sequence[Array]) -> Limits:
    """Return limits around all values of `parts`, a twentieth wider on each side."""
    low = min(float(np.min(part)) for part in parts)
    high = max(float(np.max(part)) for part in parts)
    margin = 0.05 * (high - low) or 1e-9
    return low - margin, high + margin
