"""A plane."""

from __future__ import annotations

from typing import Literal

import numpy as np

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.interfaces.surface import Surface, SurfaceConfig


class FlatConfig(SurfaceConfig):
    """Configuration of `Flat`."""

    type: Literal["flat"] = "flat"


class Flat(Surface[FlatConfig]):
    """z = 0."""

    Config = FlatConfig

    def height(self, grid: Grid) -> Array:
        """Return zeros."""
        return np.zeros(grid.cells)

    @property
    def curvature(self) -> tuple[float, float]:
        """0 along both axes."""
        return 0.0, 0.0
