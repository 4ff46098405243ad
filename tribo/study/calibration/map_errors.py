"""Errors of a measured depth map: of its cells, and of where it lies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.study.calibration.cells import cell_means
from tribo.study.calibration.quantities import EDGE_CELL_SIGMA, edge_sigma
from tribo.study.calibration.scar_shift import slopes


@dataclass(frozen=True, eq=False)
class MapErrors:
    """Errors of the cells of a map, whose covariance is σ² + Σ m mᵀ.

    To weigh residuals by its inverse is to fit where the map lies with the rest (Woodbury 1950).
    """

    sigma: Array
    """Standard deviation of each cell, with that of the grid at a scar's edge, in m."""
    moves: Array
    """Changes m of each measured cell, over its σ, by a standard deviation of where the map lies
    along each axis, shape (axes, rows, ny)."""

    @classmethod
    def of(
        cls,
        worn: Array,
        depth: Array,
        sigma: Array | float,
        placed: Sequence[float],
        spacing: tuple[float, float],
    ) -> MapErrors:
        """Return those of a measured depth where a run wears another.

        `placed` has the standard deviations of where the map lies along both axes, in m.
        """
        total = np.hypot(sigma, edge_sigma(worn, EDGE_CELL_SIGMA))
        along = slopes(cell_means(worn), spacing)
        moves = np.array([placed[axis] * slope / total for axis, slope in along.items()])
        return cls(total, np.where(np.isnan(depth), 0.0, moves))

    def places(self, off: Array) -> Array:
        """Return where a map of these residuals lies, in standard deviations of that."""
        whole = np.eye(len(self.moves)) + self._gram
        return np.asarray(np.linalg.solve(whole, np.einsum("kij,ij->k", self.moves, off)))

    def weighed(self, off: Array) -> Array:
        """Return residuals over σ, 0 where missing, weighed by the inverse of the covariance."""
        return np.asarray(off - np.einsum("k,kij->ij", self.places(off), self.moves))

    def moved(self, computed: Array, measured: Array) -> Array:
        """Return computed depths as they are where the map lies."""
        off = np.nan_to_num((computed - measured) / self.sigma)
        return np.asarray(computed - self.sigma * (off - self.weighed(off)))

    @property
    def told(self) -> float:
        """Degrees of freedom that the data tell of where the map lies."""
        gram = self._gram
        return float(np.trace(np.linalg.solve(np.eye(len(gram)) + gram, gram)))

    @property
    def _gram(self) -> Array:
        return np.asarray(np.einsum("kij,lij->kl", self.moves, self.moves))
