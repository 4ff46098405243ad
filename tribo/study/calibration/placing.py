"""Where the scar of a measured map lies, beside the model's."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.lab.heights import Heights
from tribo.study.calibration.cells import on_cells

MOVED, CERTAIN = 0.1, 3.0
"""Shift, in cells and in its standard deviations, above which a map is moved."""
_ROUNDS, _SETTLED, _STEP = 30, 0.01, 1.0
"""Steps of Gauss and Newton, the one that ends them, and the longest, in cells."""


class Placed(NamedTuple):
    """How far the scar lies from the map's middle along and across, in m, if that is certain."""

    shift: tuple[float, float] = (0.0, 0.0)
    sigma: tuple[float, float] = (np.inf, np.inf)
    """And the standard deviation of each; infinite where the scar has no shape that tells."""

    def unless_near(self, former: Placed, spacing: tuple[float, float]) -> Placed:
        """Return it with the former shift where the two hardly differ."""
        far = np.abs(np.subtract(self.shift, former.shift)) > MOVED * np.array(spacing)
        return self if np.any(far) else Placed(former.shift, self.sigma)


def slopes(depth: Array, spacing: tuple[float, float]) -> dict[int, Array]:
    """Return the derivatives of a depth by x and y, by the axis, of those it has cells along."""
    axes = [axis for axis in (0, 1) if depth.shape[axis] > 1]
    return {axis: np.gradient(depth, spacing[axis], axis=axis) for axis in axes}


def find_scar(heights: Heights, depth: Array, spacing: tuple[float, float], sigma: float) -> Placed:
    """Find where a map has the model's scar, by least squares with any depth, level and tilt.

    Parameters
    ----------
    heights : Heights
        The measured depths.
    depth : ndarray, shape (rows, ny)
        The model's, in m.
    spacing : tuple of float
        Edge lengths of a cell, in m.
    sigma : float
        Standard deviation of a measured cell, in m; that of the residuals is taken if larger.
    """
    along = slopes(depth, spacing)
    ramps = [np.indices(depth.shape)[axis] / depth.shape[axis] - 0.5 for axis in along]
    columns = np.stack([depth, *along.values(), np.ones_like(depth), *ramps], axis=-1)
    shift, cell = np.zeros(2), np.array(spacing)
    axes = list(along)
    # Begin where the map is most like the scar.
    shift[axes] = _likest(on_cells(heights, depth.shape, spacing), depth, spacing)[axes]
    for _ in range(_ROUNDS):
        try:
            measured = on_cells(heights, depth.shape, spacing, (shift[0], shift[1]))
        except CaseError:
            return Placed()
        known = np.isfinite(measured)
        parts, _, rank, _ = np.linalg.lstsq(columns[known], measured[known])
        if rank < columns.shape[-1] or parts[0] <= 0:
            return Placed()
        step = np.clip(-parts[1 : 1 + len(axes)] / parts[0] / cell[axes], -_STEP, _STEP)
        shift[axes] += step * cell[axes]
        if np.max(np.abs(step)) < _SETTLED:
            break
    else:
        return Placed()
    left = np.std(measured[known] - columns[known] @ parts)
    inverse = np.linalg.inv(columns[known].T @ columns[known])
    own = np.full(2, np.inf)
    own[axes] = max(sigma, left) * np.sqrt(np.diag(inverse))[1 : 1 + len(axes)] / parts[0]
    found = np.where(np.abs(shift) > np.maximum(CERTAIN * own, MOVED * cell), shift, 0.0)
    return Placed((found[0], found[1]), (own[0], own[1]))


def _likest(measured: Array, depth: Array, spacing: tuple[float, float]) -> Array:
    """Return by how many whole cells, in m, a map is off where it goes best with the model."""
    missing = np.where(np.isfinite(measured), measured - np.nanmedian(measured), 0.0)
    product = np.fft.ifft2(np.fft.fft2(missing) * np.conj(np.fft.fft2(depth))).real
    best = np.array(np.unravel_index(np.argmax(product), depth.shape))
    size = np.array(depth.shape)
    return np.asarray(((best + size // 2) % size - size // 2) * np.array(spacing))
