"""A measured depth map, averaged over the cells of a body's surface."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.ndimage import correlate1d
from tribo import Array, CaseError, Heights

ROUNDING = 1e-6
"""Relative rounding of pixel pitch and cell size."""
COVERED = 0.5 - 1e-6
"""Part of a cell that must be measured."""


def cell_means(depth: Array) -> Array:
    """Return the means over cells of a depth given at their centres.

    The mean is the value at the centre plus h²/24 times the second derivative along each axis.
    """
    found = depth.copy()
    for axis in (0, 1):
        found += correlate1d(depth, [1 / 24, -1 / 12, 1 / 24], axis, mode="nearest")
    return found


def on_cells(
    heights: Heights,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    shift: tuple[float, float] = (0.0, 0.0),
) -> tuple[Array, Array]:
    """Return the mean of a map over each cell of a surface, of its part on the map.

    The point at `shift` from the middle of the map, in m, lies on the middle of the surface.
    Missing pixels are interpolated; NaN in cells of which less than half was measured. The second
    array is the noise of each cell relative to a cell without missing pixels, 1 where NaN.
    """
    averaged = shape[0] == 1
    cell = heights.heights.shape[0] * heights.pitch[0] if averaged else spacing[0], spacing[1]
    if any(pitch > (1 + ROUNDING) * size for pitch, size in zip(heights.pitch, cell, strict=True)):
        raise CaseError(
            f"its pixels, {1e6 * heights.pitch[0]:g} × {1e6 * heights.pitch[1]:g} µm, are larger "
            f"than cells, {1e6 * cell[0]:g} × {1e6 * cell[1]:g} µm; check pitch, or lower "
            "grid.cells"
        )
    total, measured, lengths = heights.filled, np.isfinite(heights.heights), []
    for axis, middle in enumerate((0.0 if averaged else shift[0], shift[1])):
        ends = heights.pitch[axis] * _edges(total.shape[axis])
        edges = np.clip(middle + cell[axis] * _edges(shape[axis]), ends[0], ends[-1])
        total, measured = (_integrals(each, ends, edges, axis) for each in (total, measured))
        lengths.append(np.diff(edges))
    area = cell[0] * cell[1]
    enough = measured >= COVERED * area
    found = np.divide(total, np.outer(*lengths), out=np.full(shape, np.nan), where=enough)
    if not np.any(enough):
        raise CaseError(
            "it does not lie on the window: its middle is taken as the contact's; check pitch, "
            f"{1e6 * heights.pitch[0]:g} × {1e6 * heights.pitch[1]:g} µm"
        )
    return found, np.sqrt(area / np.where(enough, measured, area))


def _edges(count: int) -> Array:
    """Return the edges of cells of length 1 about 0."""
    return np.asarray(np.arange(count + 1) - 0.5 * count, dtype=np.float64)


def _integrals(pixels: Array, ends: Array, edges: Array, axis: int) -> Array:
    """Return the integrals between edges along an axis of pixels with these ends.

    A spline of the sums over whole pixels gives the part of a pixel that an edge cuts.
    """
    sums = np.cumsum(pixels * np.diff(ends)[0], axis=axis)
    spline = make_interp_spline(ends, np.insert(sums, 0, 0.0, axis=axis), axis=axis)
    return np.asarray(np.diff(spline(edges), axis=axis))
