"""A round, flat-ended pin."""

from __future__ import annotations

from typing import Annotated, Self

import numpy as np
from pydantic import model_validator

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.surfaces.relief import check_resolved
from tribo.surfaces.surface import Surface

STEEP = 10.0
"""Slope of the pin's side: a cell beyond the edge is ten cells up, and touches nothing."""


class Pin(Surface):
    """z = 0 up to the edge of radius e, there the arc √(e² − t²) − e, and the pin's side beyond.

    t = r − (R − e) is the distance from where the edge begins to be round. Without the rounding
    the pressure at the edge has no limit. With it there is one, but the first contact needs far
    finer cells than practical to reach it; wear soon evens the pressure out.

    References
    ----------
    M. Ciavarella, Int. J. Solids Struct. 36 (1999) 4149-4181.

    Examples
    --------
    >>> height = tribo.Pin(radius="3 mm", edge="0.5 mm").height(tribo.Grid("6 mm", 60))
    >>> (height[:5, 30] * 1e6).round().tolist()  # µm, from the side inwards
    [-283.0, -143.0, -67.0, -23.0, -3.0]
    """

    examples = ({"radius": "3 mm", "edge": "0.5 mm"},)
    type = "pin"
    smooth = True
    radius: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))]
    """Radius R of the pin."""
    edge: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))]
    """Radius e to which its edge is rounded."""

    @model_validator(mode="after")
    def _edge_on_the_pin(self) -> Self:
        if self.edge > self.radius:
            raise ValueError("edge must be at most radius")
        return self

    def height(self, grid: Grid) -> Array:
        """Return the height of the end; the edge must be at least four cells wide."""
        for spacing in grid.spacing:
            check_resolved(self.edge, spacing, "edge")
        beyond = np.maximum(np.hypot(*grid.mesh) - (self.radius - self.edge), 0.0)
        t = np.minimum(beyond, self.edge)
        # −t²/(e + √(e² − t²)) is √(e² − t²) − e without its cancellation.
        arc = -(t**2) / (self.edge + np.sqrt(self.edge**2 - t**2))
        return arc - STEEP * (beyond - t)
