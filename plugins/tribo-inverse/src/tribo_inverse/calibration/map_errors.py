"""Errors of a measured depth map: of its cells, and of where it lies."""

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

    To weigh residuals by its inverse is to fit where the map lies with the rest (Woodbury 1950).
    """

    sigma: Array
    """Standard deviation of each cell, with that of the grid at a scar's edge, in m."""
    far: Array
    """Standard deviations of where the map lies along each axis of more than one cell, in m."""
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
        """Return those of a measured depth where a run wears another.

        `placed` has the standard deviations of where the map lies along both axes, in m.
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
        """Return the part of residuals that is due to where the map lies."""
        return np.asarray(np.einsum("k,kij->ij", self._places(residuals), self.moves))

    def off(self, residuals: Array) -> tuple[float, ...]:
        """Return how much further the scar lies than the map has it, along each axis, in m."""
        return tuple(float(each) for each in self.far * self._places(residuals))

    @property
    def degrees_of_freedom(self) -> float:
        """How many numbers of where the map lies the data tell."""
        return float(np.trace(np.linalg.solve(np.eye(len(self.far)) + self._gram, self._gram)))

    def _places(self, residuals: Array) -> Array:
        """Return where the map lies, in its standard deviations."""
        along = np.einsum("kij,ij->k", self.moves, residuals)
        return np.asarray(np.linalg.solve(np.eye(len(self.far)) + self._gram, along))

    @cached_property
    def _gram(self) -> Array:
        return np.asarray(np.einsum("kij,lij->kl", self.moves, self.moves))
