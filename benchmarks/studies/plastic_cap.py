"""The pressure cap against fits to elastic-plastic finite elements: a ball on a rigid flat.

    python -m benchmarks.studies.plastic_cap

It prints the table of docs/reference/models/hardness.md: area, mean pressure and remaining depth of
a steel ball of 5 mm with H = 2.8 Y = 4 GPa, at multiples of the load of first yield. The fits are

- area and load: Jackson & Green (2005), J. Tribol. 127, 343;
- the depth left after unloading: Etsion, Kligerman & Kadin (2005), Int. J. Solids Struct. 42, 3716,
  for up to 170 times the interference of first yield; the largest load here is at 92.
"""

from __future__ import annotations

from math import exp, pi, sqrt
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from tribo.contact.dcfft import DcFft
from tribo.core.contact import ContactProblem, ContactSystem
from tribo.core.grid import Grid
from tribo.core.material import Material, contact_modulus
from tribo.core.measures import contact_area

RADIUS, HARDNESS, POISSON = 5e-3, 4e9, 0.3
YIELD = HARDNESS / 2.8
MODULUS = contact_modulus([Material(young=207e9, poisson=POISSON)])
LOADS = (3, 8, 20, 50, 150, 400)
"""Multiples of the load of first yield."""
CELLS = 160


class Pressed(NamedTuple):
    """Contact area (m²), mean pressure (Pa) and depth left (m) under a load."""

    area: float
    mean_pressure: float
    depth: float


C = 1.295 * exp(0.736 * POISSON)
"""Peak pressure over the yield stress at first yield."""
FIRST = (pi * C * YIELD / (2 * MODULUS)) ** 2 * RADIUS
"""Interference of first yield, in m."""
FIRST_LOAD = 4 / 3 * (RADIUS / MODULUS) ** 2 * (pi * C * YIELD / 2) ** 3
"""Load of first yield, in N."""


def fitted(load: float) -> Pressed:
    """Return what the fits give at a multiple of the load of first yield."""
    strain = YIELD / MODULUS
    exponent = 0.14 * exp(23 * strain)

    def area(w: float) -> float:
        return w * max(w / 1.9, 1.0) ** exponent

    def loads(w: float) -> float:
        if w <= 1.9:
            return w**1.5
        radius = pi * C * strain / 2 * sqrt(area(w))
        hardness = 2.84 * (1 - exp(-0.82 * radius**-0.7))
        full = 4 * hardness / C * (1 - exp(-(w ** (5 / 9)) / 25))
        return exp(-(w ** (5 / 12)) / 4) * w**1.5 + full * w

    w = brentq(lambda w: loads(w) - load, 1.0, 1e4)
    in_area = pi * RADIUS * FIRST * area(w)
    left = (1 - w**-0.28) * (1 - w**-0.69)
    return Pressed(in_area, load * FIRST_LOAD / in_area, left * w * FIRST)


def capped(load: float) -> Pressed:
    """Return what the pressure cap gives at a multiple of the load of first yield."""
    newton = load * FIRST_LOAD
    hertz = (3 * newton * RADIUS / (4 * MODULUS)) ** (1 / 3)
    size = 2.6 * max(hertz, sqrt(newton / (pi * HARDNESS)))
    grid = Grid((size, size), (CELLS, CELLS))
    x, y = grid.mesh
    system = ContactSystem(grid, MODULUS, newton, HARDNESS)
    found = DcFft().solve(ContactProblem(system, (x**2 + y**2) / (2 * RADIUS), newton))
    area = contact_area(found.pressure, grid)
    return Pressed(area, newton / area, float(np.max(found.overlap)))


def main() -> None:
    """Print the table."""
    print("| P/P_yield | area, cap to fit | mean pressure/Y, cap | fit | depth, µm, cap | fit |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: |")
    for load in LOADS:
        cap, fit = capped(load), fitted(load)
        off = f"{100 * (cap.area / fit.area - 1):+.0f} %"
        means = f"{cap.mean_pressure / YIELD:.2f} | {fit.mean_pressure / YIELD:.2f}"
        depths = f"{1e6 * cap.depth:.3g} | {1e6 * fit.depth:.3g}"
        print(f"| {load} | {off} | {means} | {depths} |".replace("-", "−"))


if __name__ == "__main__":
    main()
