"""A paraboloid, as Hertz's theory assumes."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import model_validator

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.surfaces.surface import Surface


class Paraboloid(Surface):
    """z = −x²/2Rx − y²/2Ry."""

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
