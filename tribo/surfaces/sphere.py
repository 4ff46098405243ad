"""A ball."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.surfaces.surface import Surface


class Sphere(Surface):
    """The exact cap z = √(R² − r²) − R of a ball of radius R, highest at the origin."""

    examples = ({"radius": "5 mm"},)
    type = "sphere"
    radius: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))]
    """Radius of the ball."""

    def height(self, grid: Grid) -> Array:
        """Return the height of the cap; the window must lie inside the ball."""
        x, y = grid.mesh
        r2 = x**2 + y**2
        radius = self.radius
        if float(np.max(r2)) >= radius**2:
            raise CaseError(
                f"a ball of radius {1e3 * radius:.4g} mm does not reach over a window of "
                f"{1e3 * grid.size[0]:.4g} × {1e3 * grid.size[1]:.4g} mm; make grid.size smaller"
            )
        # −r²/(R + √(R² − r²)) is √(R² − r²) − R without its cancellation.
        return -r2 / (radius + np.sqrt(radius**2 - r2))

    @property
    def curvature(self) -> tuple[float, float]:
        """1/R along both axes."""
        return 1 / self.radius, 1 / self.radius
