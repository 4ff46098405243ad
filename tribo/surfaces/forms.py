"""Smooth forms: a plane, a ball, a paraboloid and a cylinder."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import model_validator

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.surfaces.surface import Surface


def _arc(r2: Array, radius: float) -> Array:
    """Return √(R² − r²) − R; `CaseError` if the body is narrower than the window."""
    if float(np.max(r2)) >= radius**2:
        raise CaseError(
            f"a radius of {1e3 * radius:.4g} mm does not reach over the window; make grid.size "
            "smaller"
        )
    # As written here the difference does not cancel.
    return -r2 / (radius + np.sqrt(radius**2 - r2))


class Flat(Surface):
    """z = 0.

    Examples
    --------
    >>> tribo.Flat().curvature  # 1/m: the other body alone curves the gap
    (0.0, 0.0)
    """

    type = "flat"

    def height(self, grid: Grid) -> Array:
        """Return zeros."""
        return np.zeros(grid.cells)

    @property
    def curvature(self) -> tuple[float, float]:
        """0 along both axes."""
        return 0.0, 0.0


class Sphere(Surface):
    """The exact cap z = √(R² − r²) − R of a ball of radius R, highest at the origin.

    Examples
    --------
    >>> height = tribo.Sphere(radius="5 mm").height(tribo.Grid("1 mm", 101))
    >>> round(float(height[0, 50]) * 1e6, 1)  # µm, at 0.495 mm from the top
    -24.6
    """

    examples = ({"radius": "5 mm"},)
    type = "sphere"
    radius: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))]
    """Radius of the ball."""

    def height(self, grid: Grid) -> Array:
        """Return the height of the cap; the window must lie inside the ball."""
        x, y = grid.mesh
        return _arc(x**2 + y**2, self.radius)

    @property
    def curvature(self) -> tuple[float, float]:
        """1/R along both axes."""
        return 1 / self.radius, 1 / self.radius


class Paraboloid(Surface):
    """z = −x²/2Rx − y²/2Ry.

    Examples
    --------
    >>> tribo.Paraboloid(radius_x="5 mm", radius_y="10 mm").curvature  # 1/m
    (200.0, 100.0)
    """

    examples = ({"radius": "5 mm"}, {"radius_x": "5 mm", "radius_y": "10 mm"})
    type = "paraboloid"
    radius: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))] | None = None
    """Radius of curvature at the top, in every direction."""
    radius_x: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))] | None = None
    """Radius of curvature along x."""
    radius_y: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))] | None = None
    """Radius of curvature along y."""

    @model_validator(mode="after")
    def _round_or_elliptic(self) -> Self:
        elliptic = (self.radius_x is not None, self.radius_y is not None)
        if (any(elliptic) and not all(elliptic)) or (self.radius is None) != all(elliptic):
            raise ValueError("give either radius, or both radius_x and radius_y")
        return self

    def height(self, grid: Grid) -> Array:
        """Return the height of the paraboloid."""
        x, y = grid.mesh
        cx, cy = self.curvature
        return -0.5 * (cx * x**2 + cy * y**2)

    @property
    def curvature(self) -> tuple[float, float]:
        """1/Rx and 1/Ry."""
        if self.radius is not None:
            return 1 / self.radius, 1 / self.radius
        assert self.radius_x is not None
        assert self.radius_y is not None
        return 1 / self.radius_x, 1 / self.radius_y


class Cylinder(Surface):
    """The exact arc z = √(R² − t²) − R, with t across the cylinder's axis.

    Examples
    --------
    >>> tribo.Cylinder(radius="5 mm").curvature  # 1/m, along x and y
    (200.0, 0.0)
    """

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
        return np.broadcast_to(_arc(across**2, self.radius), grid.cells).copy()

    @property
    def curvature(self) -> tuple[float, float] | None:
        """1/R across the axis, 0 along it; None where it lies along neither x nor y."""
        if self.degrees:
            return None
        c = 1 / self.radius
        return (c, 0.0) if self.axis == "y" else (0.0, c)
