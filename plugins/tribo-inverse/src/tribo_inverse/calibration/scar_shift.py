"""Lateral shift of the scar in a measured map, by registration with the model's."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from tribo import Array, CaseError, Heights

from tribo_inverse.calibration.cells import on_cells

LEAST_SHIFT = 0.1
"""Shift, in cells, above which a map is moved, if it is significant too."""
PRIOR_SHIFT = 0.25
"""Prior standard deviation of the shift of a map, relative to the size of the surface."""
SIGNIFICANT = 3.0
"""The same in standard deviations of the shift."""
_ITERATIONS = 30
_CONVERGED = 0.01
"""Gauss-Newton step, in cells, that ends the iteration."""
_LONGEST_STEP = 1.0
"""In cells."""


class ScarShift(NamedTuple):
    """Position of the scar from the middle of its map, along and across, in m."""

    shift: tuple[float, float] = (0.0, 0.0)
    """0 where it is not significant."""
    sigma: tuple[float, float] = (np.inf, np.inf)
    """Standard deviations; infinite where the scar does not determine the shift."""

    def unless_near(self, former: ScarShift, spacing: tuple[float, float]) -> ScarShift:
        """Return it with the former shift if they differ by less than a tenth of a cell."""
        far = np.abs(np.subtract(self.shift, former.shift)) > LEAST_SHIFT * np.array(spacing)
        return self if np.any(far) else ScarShift(former.shift, self.sigma)


def slopes(depth: Array, spacing: tuple[float, float]) -> dict[int, Array]:
    """Return the derivative of a depth along each axis that has more than one cell."""
    axes = [axis for axis in (0, 1) if depth.shape[axis] > 1]
    return {axis: np.gradient(depth, spacing[axis], axis=axis) for axis in axes}


def find_shift(
    heights: Heights,
    depth: Array,
    spacing: tuple[float, float],
    sigma: float,
) -> ScarShift:
    """Find the shift of a map's scar, by least squares with the model's; also its level and tilt.

    Parameters
    ----------
    heights : Heights
        The measured depths.
    depth : ndarray, shape (rows, ny)
        Depth of the model's scar, in m.
    spacing : tuple of float
        Edge lengths of a cell, in m.
    sigma : float
        Standard deviation of a measured cell, in m; the residuals' is used if larger.
    """
    along = slopes(depth, spacing)
    ramps = [np.indices(depth.shape)[axis] / depth.shape[axis] - 0.5 for axis in along]
    columns = np.stack([depth, *along.values(), np.ones_like(depth), *ramps], axis=-1)
    shift, cell = np.zeros(2), np.array(spacing)
    axes = list(along)
    start = _cross_correlated(on_cells(heights, depth.shape, spacing)[0], depth, spacing)
    shift[axes] = start[axes]
    for _ in range(_ITERATIONS):
        try:
            measured, _ = on_cells(heights, depth.shape, spacing, (shift[0], shift[1]))
        except CaseError:
            return ScarShift()
        known = np.isfinite(measured)
        parts, _, rank, _ = np.linalg.lstsq(columns[known], measured[known])
        if rank < columns.shape[-1] or parts[0] <= 0:
            return ScarShift()
        step = np.clip(
            -parts[1 : 1 + len(axes)] / parts[0] / cell[axes], -_LONGEST_STEP, _LONGEST_STEP
        )
        shift[axes] += step * cell[axes]
        if np.max(np.abs(step)) < _CONVERGED:
            break
    else:
        return ScarShift()
    residual = np.std(measured[known] - columns[known] @ parts)
    inverse = np.linalg.inv(columns[known].T @ columns[known])
    sigmas = np.full(2, np.inf)
    sigmas[axes] = max(sigma, residual) * np.sqrt(np.diag(inverse))[1 : 1 + len(axes)] / parts[0]
    found = np.where(
        np.abs(shift) > np.maximum(SIGNIFICANT * sigmas, LEAST_SHIFT * cell), shift, 0.0
    )
    return ScarShift((found[0], found[1]), (sigmas[0], sigmas[1]))


def _cross_correlated(measured: Array, depth: Array, spacing: tuple[float, float]) -> Array:
    """Return the shift of largest cross-correlation, to a whole cell, in m."""
    filled = np.where(np.isfinite(measured), measured - np.nanmedian(measured), 0.0)
    product = np.fft.ifft2(np.fft.fft2(filled) * np.conj(np.fft.fft2(depth))).real
    best = np.array(np.unravel_index(np.argmax(product), depth.shape))
    size = np.array(depth.shape)
    return np.asarray(((best + size // 2) % size - size // 2) * np.array(spacing))
