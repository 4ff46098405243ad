"""Waves in one direction."""

from __future__ import annotations

import math
from typing import Annotated, Literal

import numpy as np

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.surfaces.laid import Laid, check_resolved


class Waves(Laid):
    """z = A cos(2π t/λ), with t along x or y and a crest at the origin."""

    examples = ({"amplitude": "0.1 um", "wavelength": "0.4 mm"},)
    type = "waves"
    amplitude: Annotated[float, Quantity("m", above=0, usual=(1e-10, 1e-3))]
    """Height of a crest above the mean A."""
    wavelength: Annotated[float, Quantity("m", above=0, usual=(1e-8, 0.1))]
    """From crest to crest λ."""
    along: Literal["x", "y"] = "y"
    """Axis along which the height varies; x is the sliding direction."""

    def relief(self, grid: Grid) -> Array:
        """Return the waves; they must be at least four cells long."""
        axis = "xy".index(self.along)
        check_resolved(self.wavelength, grid.spacing[axis], "wavelength")
        t = grid.mesh[axis]
        crests = self.amplitude * np.cos(2 * math.pi / self.wavelength * t)
        return np.array(np.broadcast_to(crests, grid.cells))
