"""Dimples or grooves at regular distances."""

from __future__ import annotations

from typing import Annotated, Literal, Self

import numpy as np
from pydantic import model_validator

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.surfaces.laid import Laid, check_resolved

Length = Annotated[float, Quantity("m", above=0, usual=(1e-8, 0.1))]


class Texture(Laid):
    """Hollows of parabolic section, z = -d (1 - (2 t/w)²), at regular distances.

    Dimples stand in a square lattice, t from their middle; grooves lie along x or y, t across. One
    lies at the origin.
    """

    examples = ({"depth": "2 um", "width": "0.1 mm", "pitch": "0.25 mm"},)
    type = "texture"
    depth: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1e-2))]
    """Depth of a hollow d."""
    width: Length
    """Diameter of a dimple, or width of a groove, w."""
    pitch: Length
    """From one to the next."""
    pattern: Literal["dimples", "grooves along x", "grooves along y"] = "dimples"
    """What they are; x is the sliding direction."""

    @model_validator(mode="after")
    def _apart(self) -> Self:
        if self.pitch < self.width:
            raise ValueError("pitch must be at least as long as width")
        return self

    def relief(self, grid: Grid) -> Array:
        """Return the hollows; they must be at least four cells wide."""
        x, y = (t - self.pitch * np.round(t / self.pitch) for t in grid.mesh)
        square = np.zeros((1, 1))
        for axis, t, other in ((0, x, "grooves along x"), (1, y, "grooves along y")):
            if self.pattern != other:
                check_resolved(self.width, grid.spacing[axis], "width")
                square = square + (2 * t / self.width) ** 2
        hollows = -self.depth * np.maximum(1 - square, 0.0)
        return np.array(np.broadcast_to(hollows, grid.cells))
