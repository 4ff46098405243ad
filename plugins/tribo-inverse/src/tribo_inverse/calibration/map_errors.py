"""Errors of a measured depth map: of its cells, and of its position."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from tribo import Array

from tribo_inverse.calibration.cells import cell_means
from tribo_inverse.calibration.quantities import EDGE_CELL_SIGMA, edge_sigma
from tribo_inverse.calibration.scar_shift import slopes


@dataclass(frozen=True, eq=False)
class MapErrors:
    """Errors of the cells of a map, whose covariance is σ² + Σ m mᵀ.

    To weigh residuals by its inverse is to fit the position of the map too (Woodbury 1950).
    """

    sigma: Array
    """Standard deviation of each cell, including the grid's at a scar's edge, in m."""
    far: Array
    """Standard deviations of the map's position along each axis of more than one cell, in m."""
    moves: Array
    """Changes m of each measured cell, over its σ, by these, shape (axes, rows, ny)."""

    @classmethod
    def of(
        cls,
        worn: Array,
        depth: Array,
        sigma: Array | float,
        placed: Sequence[float],
        spacing: tuple[float, float],
    ) -> MapErrors:
        """Return the errors of a measured depth, given the depth `worn` in a run.

        `placed` has the standard deviations of the map's position along both axes, in m.
        """
        total = np.hypot(sigma, edge_sigma(worn, EDGE_CELL_SIGMA))
        along = slopes(cell_means(worn), spacing)
        far = np.array([placed[axis] for axis in along])
        moves = np.array(
            [each * slope / total for each, slope in zip(far, along.values(), strict=True)]
        )
        return cls(total, far, np.where(np.isnan(depth), 0.0, moves))

    def weighed(self, residuals: Array) -> Array:
        """Return residuals weighed by the inverse of the covariance; over σ, 0 where missing."""
        return residuals - self.moved(residuals)

    def moved(self, residuals: Array) -> Array:
        """Return the part of residuals that is due to the position of the map."""
        return np.asarray(np.einsum("k,kij->ij", self._places(residuals), self.moves))

    def off(self, residuals: Array) -> tuple[float, ...]:
        """Return the offset of the scar from its position in the map, along each axis, in m."""
        return tuple(float(each) for each in self.far * self._places(residuals))

    @property
    def degrees_of_freedom(self) -> float:
        """Degrees of freedom of the map's position that the data determine."""
        return float(np.trace(np.linalg.solve(np.eye(len(self.far)) + self._gram, self._gram)))

    def _places(self, residuals: Array) -> Array:
        """Return the position of the map, in its standard deviations."""
        along = np.einsum("kij,ij->k", self.moves, residuals)
        return np.asarray(np.linalg.solve(np.eye(len(self.far)) + self._gram, along))

    @cached_property
    def _gram(self) -> Array:
        return np.asarray(np.einsum("kij,lij->kl", self.moves, self.moves))
