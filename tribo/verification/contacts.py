"""Smooth bodies on a half-space in free space, and the line contact on a periodic one."""

from __future__ import annotations

import math

import numpy as np

from tribo.closed_forms import cone, hertz, punch
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.measures import contact_area
from tribo.stepping.step import first_contact
from tribo.verification.check import Check, Found, Quantity
from tribo.verification.problems import (
    LOAD,
    MODULUS,
    POISSON,
    RADIUS,
    YOUNG,
    ball,
    half_space,
    norm,
    on_flat,
    periodic,
    press,
)

PLACEMENTS = 5
SHAPE = "sum |p - p_exact| / sum p"
# Σ|Δp| misses √(distance) in a rim of a cell; counted cells, the rim itself.
PEAK = Quantity("peak pressure", "Pa", 1e-4, 2.0)
APPROACH = Quantity("approach", "m", 1e-4, 2.0)
AREA = Quantity("contact area, counted", "m^2", 1e-2, 1.0)
PRESSURE = Quantity(SHAPE, "1", 2e-3, 1.5, "the root at the edge bounds the order")


def square(width: float, cells: int, placement: float) -> Grid:
    """Return a grid on which the edge of a contact moves by about a cell with the placement."""
    return oblong(width, width, cells, placement)


def oblong(width: float, breadth: float, cells: int, placement: float) -> Grid:
    """Return a grid as `square`, of as many cells along as across."""
    larger = 1 + 3 * placement / cells
    return Grid((larger * width, larger * breadth), (cells, cells))


def _ellipse(radius_x: float, grid: Grid) -> Found:
    x, y = grid.mesh
    exact = hertz.point(MODULUS, LOAD, 1 / radius_x, 1 / RADIUS)
    a, b = exact.semi_axes
    found = press(half_space(), x**2 / (2 * radius_x) + y**2 / (2 * RADIUS), grid, LOAD)
    field = exact.peak_pressure * np.sqrt(np.maximum(1 - (x / a) ** 2 - (y / b) ** 2, 0.0))
    return {
        PEAK.name: (exact.peak_pressure, float(np.max(found.pressure))),
        APPROACH.name: (exact.approach, found.approach),
        AREA.name: (math.pi * a * b, contact_area(found.pressure, grid)),
        SHAPE: norm(found.pressure, field),
    }


def _circular(cells: int, placement: float) -> Found:
    return _ellipse(RADIUS, square(0.5e-3, cells, placement))


def _elliptical(cells: int, placement: float) -> Found:
    # Cells as oblong as this show which of their sides is which.
    return _ellipse(2 * RADIUS, oblong(0.5e-3, 0.3e-3, cells, placement))


def _unlike(cells: int, placement: float) -> Found:
    other = Material(young=70e9, poisson=0.2)
    modulus = 1 / ((1 - POISSON**2) / YOUNG + (1 - 0.2**2) / 70e9)
    exact = hertz.point(modulus, LOAD, 1 / RADIUS, 1 / RADIUS)
    model = on_flat(ball(), square(0.6e-3, cells, placement), half_space(), flat_material=other)
    found = first_contact(model).contact
    return {
        PEAK.name: (exact.peak_pressure, float(np.max(found.pressure))),
        APPROACH.name: (exact.approach, found.approach),
    }


def _line(cells: int, placement: float) -> Found:
    line_load = 1e5
    alone = hertz.line(MODULUS, line_load, 1 / RADIUS)
    period = 32 * alone.half_width * (1 + 48 * placement / cells)
    # The images, at multiples of the period, add this to the gap's curvature.
    images = math.pi**2 / 6 * (alone.half_width / period) ** 2
    exact = hertz.line(MODULUS, line_load, (1 + images) / RADIUS)
    grid = Grid((period, 2 * period / cells), (cells, 2))
    x, y = grid.mesh
    found = press(periodic(), x**2 / (2 * RADIUS) + 0 * y, grid, line_load * grid.size[1])
    field = exact.peak_pressure * np.sqrt(np.maximum(1 - (x / exact.half_width) ** 2, 0.0))
    touching = int(np.count_nonzero(found.pressure[:, 0]))
    return {
        PEAK.name: (exact.peak_pressure, float(np.max(found.pressure))),
        "half-width, counted": (exact.half_width, 0.5 * touching * grid.spacing[0]),
        SHAPE: norm(found.pressure, np.broadcast_to(field, grid.cells)),
    }


def _punch(cells: int, placement: float) -> Found:
    radius = 0.3e-3
    grid = square(0.8e-3, cells, placement)
    x, y = grid.mesh
    inside = x**2 + y**2 < radius**2
    # The staircase stands for a disc of its own area.
    drawn = math.sqrt(np.count_nonzero(inside) * grid.cell_area / math.pi)
    found = press(half_space(), np.where(inside, 0.0, 1e-3), grid, LOAD)
    middle = cells // 2
    return {
        APPROACH.name: (punch.approach(LOAD, drawn, MODULUS), found.approach),
        "pressure at the centre": (
            float(punch.pressure(0.0, LOAD, drawn)),
            float(found.pressure[middle, middle]),
        ),
    }


def _cone(cells: int, placement: float) -> Found:
    slope, radius = 0.02, 0.2e-3
    angle = math.atan(1 / slope)
    load = 0.5 * math.pi * MODULUS * radius**2 * slope
    grid = square(0.6e-3, cells, placement)
    x, y = grid.mesh
    r = np.hypot(x, y)
    found = press(half_space(), slope * r, grid, load)
    exact = cone.cone(load, angle, MODULUS)
    # Not at the apex, where the pressure is infinite.
    away = r > 0
    return {
        APPROACH.name: (exact.approach, found.approach),
        AREA.name: (math.pi * radius**2, contact_area(found.pressure, grid)),
        SHAPE: norm(found.pressure[away], cone.pressure(r[away], load, angle, MODULUS)),
    }


CHECKS = (
    Check(
        "Hertz, circular",
        "Johnson (1985), section 4.2",
        _circular,
        (PEAK, APPROACH, AREA, PRESSURE),
        levels=(31, 93, 279),
        placements=PLACEMENTS,
    ),
    Check(
        "Hertz, elliptical (radii 2 : 1), on oblong cells (5 : 3)",
        "Johnson (1985), section 4.2",
        _elliptical,
        (PEAK, APPROACH, AREA, PRESSURE),
        levels=(31, 93, 279),
        placements=PLACEMENTS,
    ),
    Check(
        "Hertz, ball and flat of two materials",
        "Johnson (1985), section 4.2",
        _unlike,
        (PEAK, APPROACH),
        levels=(31, 93, 279),
        placements=PLACEMENTS,
    ),
    Check(
        "Hertz, line (periodic in x and y, 32 half-widths apart)",
        "Johnson (1985), section 4.2; images to (b/L)^2",
        _line,
        (PEAK, Quantity("half-width, counted", "m", 1e-2, 1.0), PRESSURE),
        levels=(255, 1023, 4095),
        placements=8,
        cost=0.3,
    ),
    Check(
        "flat punch",
        "Sneddon (1965); Johnson (1985), section 3.4",
        _punch,
        (
            Quantity(APPROACH.name, "m", 2e-3, 1.0),
            Quantity("pressure at the centre", "Pa", 2e-3, 1.0),
        ),
        levels=(41, 123, 369),
        placements=3,
        cost=2.0,
    ),
    Check(
        "cone",
        "Sneddon (1965); Johnson (1985), section 5.2",
        _cone,
        (APPROACH, AREA, PRESSURE),
        levels=(31, 93, 279),
        placements=PLACEMENTS,
    ),
)
