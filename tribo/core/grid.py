"""The rectangular window on the contact, divided into equal cells."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import numpy as np
from pydantic import Field, field_validator

from tribo.core.arrays import Array
from tribo.core.table import Table
from tribo.core.units import Quantity

Length = Annotated[float, Quantity("m", above=0, usual=(1e-9, 0.1))]


Cells = Annotated[int, Field(ge=1, le=32768)]
"""Cells along an axis."""


class Grid(Table):
    """A window centred on the origin of the contact frame; one number stands for both axes.

    Arrays on a grid have shape ``cells`` = (nx, ny), axis 0 along the sliding
    direction x, and hold values at cell centres.

    Examples
    --------
    >>> grid = tribo.Grid(size=("2 mm", "1 mm"), cells=(256, 128))
    >>> grid.spacing  # in m
    (7.8125e-06, 7.8125e-06)
    """

    in_order: ClassVar[bool] = True
    size: tuple[Length, Length]
    """Edge lengths along x, the sliding direction, and y."""
    cells: tuple[Cells, Cells]
    """Number of cells along x and y."""
    ends_at_window: bool = False
    """Whether a body ends at the window's edge, as a flat pin does: contact may then reach it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            size: float | str | tuple[float, float],
            cells: int | tuple[int, int],
            ends_at_window: bool = False,
        ) -> None: ...

    @field_validator("size", "cells", mode="before")
    @classmethod
    def _both_axes(cls, value: Any) -> Any:
        return value if isinstance(value, list | tuple) else (value, value)

    @property
    def spacing(self) -> tuple[float, float]:
        """Edge lengths of a cell along x and y, in m."""
        return self.size[0] / self.cells[0], self.size[1] / self.cells[1]

    @property
    def cell_area(self) -> float:
        """Area of a cell, in m²."""
        return (self.size[0] / self.cells[0]) * (self.size[1] / self.cells[1])

    @property
    def period(self) -> int | None:
        """Cells along x after which all repeats; None where nothing does."""
        return None

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


class RepeatingGrid(Grid):
    """A window after which all repeats, along x and y."""

    @property
    def period(self) -> int:
        """Cells along x after which all repeats: the window's."""
        return self.cells[0]


def _centres(count: int, step: float) -> Array:
    # Symmetric to the last bit, so that symmetric cases stay symmetric.
    return np.asarray((np.arange(count) - 0.5 * (count - 1)) * step, dtype=np.float64)
