"""Lateral shift of the scar in a measured map, by correlation with the model's."""

from __future__ import annotations

import numpy as np
from tribo import Array, Heights

from tribo_inverse.calibration.cells import on_cells

PRIOR_SHIFT = 0.25
"""Prior standard deviation of the shift of a map, relative to the size of the surface."""


def find_shift(heights: Heights, depth: Array, spacing: tuple[float, float]) -> tuple[float, float]:
    """Return the position of the scar from the middle of its map, along and across, in m.

    It has the largest cross-correlation with the model's `depth`, of shape (rows, ny), by a
    parabola through the cells around; a part of a cell may be left.
    """
    measured, _ = on_cells(heights, depth.shape, spacing)
    filled = np.where(np.isfinite(measured), measured - np.nanmedian(measured), 0.0)
    product = np.fft.fft2(filled) * np.conj(np.fft.fft2(depth - np.mean(depth)))
    correlation = np.fft.ifft2(product).real
    best = np.unravel_index(np.argmax(correlation), depth.shape)
    found = []
    for axis, n in enumerate(depth.shape):
        line = np.take(correlation, best[1 - axis], axis=1 - axis)
        below, at, above = line[(best[axis] + np.array([-1, 0, 1])) % n]
        curvature = 2 * at - below - above
        part = 0.5 * (above - below) / curvature if curvature > 0 else 0.0
        found.append(float((best[axis] + n // 2) % n - n // 2 + part) * spacing[axis])
    return found[0], found[1]
