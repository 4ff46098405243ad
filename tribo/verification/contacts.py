"""Smooth bodies on a half-space in free space, and the line contact on a periodic one."""

from __future__ import annotations

import math

import numpy as np

from tribo.closed_forms import cone, hertz, punch
from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.measures import contact_area
from tribo.stepping.step import first_contact
from tribo.verification.problems import (
    BALL,
    HALF_SPACE,
    LOAD,
    MODULUS,
    PERIODIC,
    POISSON,
    RADIUS,
    YOUNG,
    drawn_radius,
    on_flat,
    paraboloid,
    press,
    square,
)
from tribo.verification.reference import Row, norm, reference

PLACEMENTS = 5
HERTZ = "Johnson (1985), section 4.2"
SNEDDON = "Sneddon (1965); Johnson (1985), section"


def peak(expected: float, pressure: Array) -> Row:
    """Return the row of the peak pressure."""
    return Row("peak pressure", "Pa", expected, float(np.max(pressure)), 1e-4, 2.0)


def approach(expected: float, found: ContactSolution) -> Row:
    """Return the row of the approach."""
    return Row("approach", "m", expected, found.approach, 1e-4, 2.0)


def area(expected: float, found: ContactSolution, grid: Grid) -> Row:
    """Return the row of the area; counted cells are wrong in a rim of one cell."""
    counted = contact_area(found.pressure, grid)
    return Row("contact area, counted", "m^2", expected, counted, 1e-2, 1.0)


def pressure(got: Array, expected: Array) -> Row:
    """Return the row of Σ|Δp|, which misses √(distance) in a rim of one cell."""
    name, note = "sum |p - p_exact| / sum p", "the root at the edge bounds the order"
    return norm(name, got, expected, 2e-3, 1.5, note)


def _ellipse(radius_x: float, grid: Grid) -> list[Row]:
    x, y = grid.mesh
    exact = hertz.point(MODULUS, LOAD, 1 / radius_x, 1 / RADIUS)
    a, b = exact.semi_axes
    found = press(HALF_SPACE, paraboloid(grid, radius_x), grid, LOAD)
    field = exact.peak_pressure * np.sqrt(np.maximum(1 - (x / a) ** 2 - (y / b) ** 2, 0.0))
    return [
        peak(exact.peak_pressure, found.pressure),
        approach(exact.approach, found),
        area(math.pi * a * b, found, grid),
        pressure(found.pressure, field),
    ]


@reference("Hertz, circular", HERTZ, 31, 93, 279, placements=PLACEMENTS)
def _circular(cells: int, placement: float) -> list[Row]:
    return _ellipse(RADIUS, square(0.5e-3, cells, placement))


# Cells as oblong as this show which of their sides is which.
@reference(
    "Hertz, elliptical (radii 2 : 1), on oblong cells (5 : 3)",
    HERTZ,
    *(31, 93, 279),
    placements=PLACEMENTS,
)
def _elliptical(cells: int, placement: float) -> list[Row]:
    return _ellipse(2 * RADIUS, square(0.5e-3, cells, placement, breadth=0.3e-3))


@reference("Hertz, ball and flat of two materials", HERTZ, 31, 93, 279, placements=PLACEMENTS)
def _two_materials(cells: int, placement: float) -> list[Row]:
    other = Material(young=70e9, poisson=0.2)
    modulus = 1 / ((1 - POISSON**2) / YOUNG + (1 - 0.2**2) / 70e9)
    exact = hertz.point(modulus, LOAD, 1 / RADIUS, 1 / RADIUS)
    model = on_flat(BALL, square(0.6e-3, cells, placement), HALF_SPACE, flat_material=other)
    found = first_contact(model).contact
    return [peak(exact.peak_pressure, found.pressure), approach(exact.approach, found)]


@reference(
    "Hertz, line (periodic in x and y, 32 half-widths apart)",
    f"{HERTZ}; images to (b/L)^2",
    *(255, 1023, 4095),
    placements=8,
)
def _line(cells: int, placement: float) -> list[Row]:
    line_load = 1e5
    alone = hertz.line(MODULUS, line_load, 1 / RADIUS)
    period = 32 * alone.half_width * (1 + 48 * placement / cells)
    # The images, at multiples of the period, add this to the gap's curvature.
    images = math.pi**2 / 6 * (alone.half_width / period) ** 2
    exact = hertz.line(MODULUS, line_load, (1 + images) / RADIUS)
    grid = Grid((period, 2 * period / cells), (cells, 2))
    x, y = grid.mesh
    found = press(PERIODIC, x**2 / (2 * RADIUS) + 0 * y, grid, line_load * grid.size[1])
    field = exact.peak_pressure * np.sqrt(np.maximum(1 - (x / exact.half_width) ** 2, 0.0))
    counted = 0.5 * int(np.count_nonzero(found.pressure[:, 0])) * grid.spacing[0]
    return [
        peak(exact.peak_pressure, found.pressure),
        Row("half-width, counted", "m", exact.half_width, counted, 1e-2, 1.0),
        pressure(found.pressure, np.broadcast_to(field, grid.cells)),
    ]


@reference("flat punch", f"{SNEDDON} 3.4", 41, 123, 369, placements=3)
def _punch(cells: int, placement: float) -> list[Row]:
    grid = square(0.8e-3, cells, placement)
    x, y = grid.mesh
    inside = x**2 + y**2 < 0.3e-3**2
    # The staircase stands for a disc of its own area.
    radius = drawn_radius(inside, grid)
    found = press(HALF_SPACE, np.where(inside, 0.0, 1e-3), grid, LOAD)
    centre = float(found.pressure[cells // 2, cells // 2])
    exact = float(punch.pressure(0.0, LOAD, radius))
    return [
        Row("approach", "m", punch.approach(LOAD, radius, MODULUS), found.approach, 2e-3, 1.0),
        Row("pressure at the centre", "Pa", exact, centre, 2e-3, 1.0),
    ]


@reference("cone", f"{SNEDDON} 5.2", 31, 93, 279, placements=PLACEMENTS)
def _cone(cells: int, placement: float) -> list[Row]:
    slope, radius = 0.02, 0.2e-3
    angle = math.atan(1 / slope)
    load = 0.5 * math.pi * MODULUS * radius**2 * slope
    grid = square(0.6e-3, cells, placement)
    x, y = grid.mesh
    r = np.hypot(x, y)
    found = press(HALF_SPACE, slope * r, grid, load)
    # Not at the apex, where the pressure is infinite.
    away = r > 0
    return [
        approach(cone.cone(load, angle, MODULUS).approach, found),
        area(math.pi * radius**2, found, grid),
        pressure(found.pressure[away], cone.pressure(r[away], load, angle, MODULUS)),
    ]
