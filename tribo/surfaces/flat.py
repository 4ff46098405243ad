"""A plane."""

from __future__ import annotations

import numpy as np

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.surfaces.surface import Surface


class Flat(Surface):
    """z = 0."""

    type = "flat"

    def height(self, grid: Grid) -> Array:
        """Return zeros."""
        return np.zeros(grid.cells)

    @property
    def curvature(self) -> tuple[float, float]:
        """0 along both axes."""
        return 0.0, 0.0
