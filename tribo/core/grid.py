"""The rectangular window on the contact, divided into equal cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array


@dataclass(frozen=True)
class Grid:
    """A window centred on the origin of the contact frame.

    Arrays on a grid have shape ``cells`` = (nx, ny), axis 0 along the sliding
    direction x, and hold values at cell centres.

    Parameters
    ----------
    size : tuple of float
        Edge lengths along x and y, in m.
    cells : tuple of int
        Number of cells along x and y.
    """

    size: tuple[float, float]
    cells: tuple[int, int]

    @property
    def spacing(self) -> tuple[float, float]:
        """Edge lengths of a cell along x and y, in m."""
        return self.size[0] / self.cells[0], self.size[1] / self.cells[1]

    @property
    def cell_area(self) -> float:
        """Area of a cell, in m²."""
        dx, dy = self.spacing
        return dx * dy

    @property
    def x(self) -> Array:
        """Cell centres along x, shape (nx,), in m."""
        return _centres(self.cells[0], self.spacing[0])

    @property
    def y(self) -> Array:
        """Cell centres along y, shape (ny,), in m."""
        return _centres(self.cells[1], self.spacing[1])

    @property
    def mesh(self) -> tuple[Array, Array]:
        """Coordinates x of shape (nx, 1) and y of shape (1, ny), in m."""
        return self.x[:, None], self.y[None, :]


def _centres(count: int, step: float) -> Array:
    # Symmetric to the last bit, so that symmetric cases stay symmetric.
    return np.asarray((np.arange(count) - 0.5 * (count - 1)) * step, dtype=np.float64)
