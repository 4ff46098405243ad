"""A cylinder lying along any axis of the surface."""

from __future__ import annotations

import math
from typing import Annotated, Literal

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.surfaces.surface import Surface


class Cylinder(Surface):
    """The exact arc z = √(R² − t²) − R, with t across the cylinder's axis."""

    examples = ({"radius": "5 mm"}, {"radius": "5 mm", "axis": "x", "degrees": 30})
    type = "cylinder"
    radius: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))]
    """Radius of the cylinder."""
    axis: Literal["x", "y"] = "y"
    """Axis along which it lies; y is across the sliding direction."""
    degrees: Annotated[float, Quantity("1", at_least=-45, at_most=45)] = 0.0
    """Angle in degrees by which it is turned from there, from x towards y."""

    def height(self, grid: Grid) -> Array:
        """Return the height of the arc; the window must lie inside the cylinder."""
        x, y = grid.mesh
        across = x if self.axis == "y" else y
        if self.degrees:
            along = y if self.axis == "y" else -x
            angle = math.radians(self.degrees)
            across = across * math.cos(angle) + along * math.sin(angle)
        radius = self.radius
        if float(np.max(np.abs(across))) >= radius:
            raise CaseError(
                f"a cylinder of radius {1e3 * radius:.4g} mm does not reach over the window; "
                "make grid.size smaller"
            )
        arc = -(across**2) / (radius + np.sqrt(radius**2 - across**2))
        return np.broadcast_to(arc, grid.cells).copy()

    @property
    def curvature(self) -> tuple[float, float] | None:
        """1/R across the axis, 0 along it; None where it lies along neither x nor y."""
        if self.degrees:
            return None
        c = 1 / self.radius
        return (c, 0.0) if self.axis == "y" else (0.0, c)
