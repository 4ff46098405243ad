"""A measured depth map, averaged over the cells of a body's surface."""

from __future__ import annotations

import numpy as np
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
    """Return the mean of a map over each cell of a surface, weighted by shared area.

    The point at `shift` from the middle of the map, in m, lies on the middle of the surface.
    Missing pixels are interpolated, except on a track. NaN in cells of which less than half was
    measured. The second array is the noise of each cell
    relative to a cell without missing pixels, 1 where NaN.
    """
    averaged = shape[0] == 1
    cell = heights.heights.shape[0] * heights.pitch[0] if averaged else spacing[0], spacing[1]
    if any(pitch > (1 + ROUNDING) * size for pitch, size in zip(heights.pitch, cell, strict=True)):
        raise CaseError(
            f"its pixels, {1e6 * heights.pitch[0]:g} × {1e6 * heights.pitch[1]:g} µm, are larger "
            f"than cells, {1e6 * cell[0]:g} × {1e6 * cell[1]:g} µm; check pitch, or lower "
            "grid.cells"
        )
    known = np.isfinite(heights.heights)
    # Along a track all is alike, so that nothing need be interpolated.
    used = known if averaged else np.ones(known.shape)
    pixels = np.where(used, heights.filled, 0.0)
    # A cell takes parts of pixels: linear interpolation gives the mean of each part.
    slopes = [np.where(used, slope, 0.0) for slope in np.gradient(heights.filled)]
    (in_x, offset_x), (in_y, offset_y) = (
        _overlaps(n, width, m, pitch, off)
        for n, width, m, pitch, off in zip(
            shape,
            cell,
            known.shape,
            heights.pitch,
            (0.0 if averaged else shift[0], shift[1]),
            strict=True,
        )
    )
    total = in_x @ pixels @ in_y.T
    total = total + offset_x @ slopes[0] @ in_y.T + in_x @ slopes[1] @ offset_y.T
    measured = in_x @ known @ in_y.T
    enough = measured >= COVERED * cell[0] * cell[1]
    covered = in_x @ used @ in_y.T
    found = np.divide(total, covered, out=np.full(shape, np.nan), where=enough)
    if not np.any(enough):
        raise CaseError(
            "it does not lie on the window: its middle is taken as the contact's; check pitch, "
            f"{1e6 * heights.pitch[0]:g} × {1e6 * heights.pitch[1]:g} µm"
        )
    return found, np.sqrt(cell[0] * cell[1] / np.where(enough, measured, cell[0] * cell[1]))


def _overlaps(
    cells: int, width: float, pixels: int, pitch: float, shift: float
) -> tuple[Array, Array]:
    """Return the lengths shared by cells and pixels, shape (cells, pixels), at a shift.

    Also each length times the offset of its middle from the pixel's, in pixels.
    """
    to_cell = width * (np.arange(cells + 1)[:, None] - 0.5 * cells)
    to_pixel = pitch * (np.arange(pixels + 1) - 0.5 * pixels) - shift
    begin = np.maximum(to_cell[:-1], to_pixel[:-1])
    end = np.minimum(to_cell[1:], to_pixel[1:])
    shared = np.maximum(end - begin, 0.0)
    return shared, 0.5 * shared * (begin + end - to_pixel[:-1] - to_pixel[1:]) / pitch
