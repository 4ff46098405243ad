"""Relief on a body: what all surfaces that lie on another have in common."""

from __future__ import annotations

import math
from abc import abstractmethod

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.rounding import ROUND_OFF
from tribo.surfaces.flat import Flat
from tribo.surfaces.surface import Surface

FEWEST = 4
"""Cells that a wave must have for its contact to be more than a sample."""


class Laid(Surface):
    """A relief on another surface: z = z_on + relief."""

    on: Surface = Flat()
    """The surface that it lies on."""

    def height(self, grid: Grid) -> Array:
        """Return the height of both."""
        return self.on.height(grid) + self.relief(grid)

    def smoothed(self) -> Surface:
        """Return the surface that the relief lies on."""
        return self.on.smoothed()

    @abstractmethod
    def relief(self, grid: Grid) -> Array:
        """Return what is added to the height of `on`, shape (nx, ny), in m."""


def check_resolved(shortest: float, spacing: float, field: str) -> None:
    """Raise `CaseError` for a feature, in m, of fewer than four cells of length `spacing`."""
    if shortest < FEWEST * spacing * (1 - ROUND_OFF):
        finer = math.ceil(10 * FEWEST * spacing / shortest) / 10
        raise CaseError(
            f"{1e6 * shortest:.4g} µm are {shortest / spacing:.2g} cells of "
            f"{1e6 * spacing:.4g} µm, and {FEWEST} at least are needed; raise grid.cells "
            f"{finer:g} times, or give a longer {field}"
        )
