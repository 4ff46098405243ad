"""Steel pins on a steel flat, for the scripts of cases."""

from __future__ import annotations

from typing import Any

import numpy as np

import tribo

STEEL = tribo.Material(young="207 GPa", poisson=0.3)


def pin_on_flat(
    surface: tribo.Surface, wear: tribo.WearLaw | None = None, **case: Any
) -> tribo.Case:
    """Return a case of a pin with this surface, which alone wears, if any does."""
    pin = tribo.Body(surface=surface, material=STEEL, wear=wear)
    flat = tribo.Body(surface=tribo.Flat(), material=STEEL)
    return tribo.Case(bodies={"pin": pin, "flat": flat}, **case)


def disc(grid: tribo.Grid, radius: float) -> tuple[tribo.Surface, float]:
    """Return a flat disc, whose edge is a staircase of cells, and the radius of its area, in m."""
    inside = np.hypot(*grid.mesh) < radius
    surface = tribo.HeightMap(size=grid.size, heights=np.where(inside, 0.0, -1e-3))
    return surface, float(np.sqrt(np.count_nonzero(inside) * grid.cell_area / np.pi))
