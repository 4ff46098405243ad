"""Relief on a body: what all surfaces share that lie on another; waves, dimples and grooves."""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import model_validator

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.rounding import ROUND_OFF
from tribo.core.units import Quantity
from tribo.surfaces.forms import Flat
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
        """Return the relief added to the height of `on`, shape (nx, ny), in m."""


def check_resolved(shortest: float, spacing: float, field: str) -> None:
    """Raise `CaseError` for a feature, in m, of fewer than four cells of length `spacing`."""
    if shortest < FEWEST * spacing * (1 - ROUND_OFF):
        finer = math.ceil(10 * FEWEST * spacing / shortest) / 10
        raise CaseError(
            f"{1e6 * shortest:.4g} µm are {shortest / spacing:.2g} cells of "
            f"{1e6 * spacing:.4g} µm, and {FEWEST} at least are needed; raise grid.cells "
            f"{finer:g} times, or give a longer {field}"
        )


class Waves(Laid):
    """z = A cos(2π t/λ), with t along x or y and a crest at the origin.

    Examples
    --------
    >>> height = tribo.Waves(amplitude="1 um", wavelength="1 mm").height(tribo.Grid("1 mm", 64))
    >>> round(float(height.std()) * 1e6, 3)  # Sq in µm: A/√2
    0.707
    """

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


Length = Annotated[float, Quantity("m", above=0, usual=(1e-8, 0.1))]


class Texture(Laid):
    """Hollows of parabolic section, z = -d (1 - (2 t/w)²), at regular distances.

    Dimples stand in a square lattice, t from their middle; grooves lie along x or y, t across. One
    lies at the origin.

    Examples
    --------
    >>> dimples = tribo.Texture(depth="2 um", width="0.1 mm", pitch="0.25 mm")
    >>> hollow = dimples.height(tribo.Grid("1 mm", 400)) < 0
    >>> round(float(hollow.mean()), 3)  # part of the area, π/4 (w/pitch)²
    0.126
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
