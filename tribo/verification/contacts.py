"""Smooth and wavy bodies in contact: in free space, along a line and on a periodic half-space."""

from __future__ import annotations

import math

import numpy as np

from tribo.closed_forms import cone, hertz, punch, sinusoid
from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.measures import contact_area
from tribo.stepping.first_contact import first_contact
from tribo.verification import paper_bodies as paper
from tribo.verification.reference import Row, norm, reference

PLACEMENTS = 5
WAVELENGTH, AMPLITUDE = 1e-4, 1e-6
HERTZ = "Johnson (1985), section 4.2"
SNEDDON = "Sneddon (1965); Johnson (1985), section"
JOHNSON = "Johnson, Greenwood & Higginson (1985)"


def _peak(expected: float, pressure: Array) -> Row:
    return Row("peak pressure", "Pa", expected, float(np.max(pressure)), 1e-4, 2.0)


def _approach(expected: float, found: ContactSolution) -> Row:
    return Row("approach", "m", expected, found.approach, 1e-4, 2.0)


def _area(expected: float, found: ContactSolution, grid: Grid) -> Row:
    """Return the row of the area; counted cells are wrong in a rim of one cell."""
    counted = contact_area(found.pressure, grid)
    return Row("contact area, counted", "m^2", expected, counted, 1e-2, 1.0)


def _pressure(got: Array, expected: Array) -> Row:
    """Return the row of Σ|Δp|, which misses √(distance) in a rim of one cell."""
    name, note = "sum |p - p_exact| / sum p", "the root at the edge bounds the order"
    return norm(name, got, expected, 2e-3, 1.5, note)


def _ellipse(radius_x: float, grid: Grid) -> list[Row]:
    x, y = grid.mesh
    exact = hertz.point(paper.MODULUS, paper.LOAD, 1 / radius_x, 1 / paper.RADIUS)
    a, b = exact.semi_axes
    found = paper.press(paper.HALF_SPACE, paper.paraboloid(grid, radius_x), grid, paper.LOAD)
    field = exact.peak_pressure * np.sqrt(np.maximum(1 - (x / a) ** 2 - (y / b) ** 2, 0.0))
    return [
        _peak(exact.peak_pressure, found.pressure),
        _approach(exact.approach, found),
        _area(math.pi * a * b, found, grid),
        _pressure(found.pressure, field),
    ]


@reference("Hertz, circular", HERTZ, 31, 93, 279, placements=PLACEMENTS)
def _circular(cells: int, placement: float) -> list[Row]:
    return _ellipse(paper.RADIUS, paper.square(0.5e-3, cells, placement))


# Cells as oblong as this show which of their sides is which.
OBLONG = "Hertz, elliptical (radii 2 : 1), on oblong cells (5 : 3)"


@reference(OBLONG, HERTZ, 31, 93, 279, placements=PLACEMENTS)
def _elliptical(cells: int, placement: float) -> list[Row]:
    return _ellipse(2 * paper.RADIUS, paper.square(0.5e-3, cells, placement, breadth=0.3e-3))


@reference("Hertz, ball and flat of two materials", HERTZ, 31, 93, 279, placements=PLACEMENTS)
def _two_materials(cells: int, placement: float) -> list[Row]:
    other = Material(young=70e9, poisson=0.2)
    modulus = 1 / ((1 - paper.POISSON**2) / paper.YOUNG + (1 - 0.2**2) / 70e9)
    exact = hertz.point(modulus, paper.LOAD, 1 / paper.RADIUS, 1 / paper.RADIUS)
    grid = paper.square(0.6e-3, cells, placement)
    model = paper.on_flat(paper.BALL, grid, paper.HALF_SPACE, flat_material=other)
    found = first_contact(model).contact
    return [_peak(exact.peak_pressure, found.pressure), _approach(exact.approach, found)]


LINE = "Hertz, line (periodic in x and y, 32 half-widths apart)"


@reference(LINE, f"{HERTZ}; images to (b/L)^2", 255, 1023, 4095, placements=8)
def _line(cells: int, placement: float) -> list[Row]:
    line_load, curvature = 1e5, 1 / paper.RADIUS
    alone = hertz.line(paper.MODULUS, line_load, curvature)
    period = 32 * alone.half_width * (1 + 48 * placement / cells)
    # The images, at multiples of the period, add this to the gap's curvature.
    images = math.pi**2 / 6 * (alone.half_width / period) ** 2
    exact = hertz.line(paper.MODULUS, line_load, (1 + images) * curvature)
    grid = Grid((period, 2 * period / cells), (cells, 2))
    x, y = grid.mesh
    gap = x**2 / (2 * paper.RADIUS) + 0 * y
    found = paper.press(paper.PERIODIC, gap, grid, line_load * grid.size[1])
    field = exact.peak_pressure * np.sqrt(np.maximum(1 - (x / exact.half_width) ** 2, 0.0))
    counted = 0.5 * int(np.count_nonzero(found.pressure[:, 0])) * grid.spacing[0]
    return [
        _peak(exact.peak_pressure, found.pressure),
        Row("half-width, counted", "m", exact.half_width, counted, 1e-2, 1.0),
        _pressure(found.pressure, np.broadcast_to(field, grid.cells)),
    ]


@reference("flat punch", f"{SNEDDON} 3.4", 41, 123, 369, placements=3)
def _punch(cells: int, placement: float) -> list[Row]:
    grid = paper.square(0.8e-3, cells, placement)
    x, y = grid.mesh
    inside = x**2 + y**2 < 0.3e-3**2
    # The staircase stands for a disc of its own area.
    radius = paper.drawn_radius(inside, grid)
    found = paper.press(paper.HALF_SPACE, np.where(inside, 0.0, 1e-3), grid, paper.LOAD)
    approach = punch.approach(paper.LOAD, radius, paper.MODULUS)
    centre = float(punch.pressure(0.0, paper.LOAD, radius))
    middle = float(found.pressure[cells // 2, cells // 2])
    return [
        Row("approach", "m", approach, found.approach, 2e-3, 1.0),
        Row("pressure at the centre", "Pa", centre, middle, 2e-3, 1.0),
    ]


@reference("cone", f"{SNEDDON} 5.2", 31, 93, 279, placements=PLACEMENTS)
def _cone(cells: int, placement: float) -> list[Row]:
    slope, radius = 0.02, 0.2e-3
    angle = math.atan(1 / slope)
    load = 0.5 * math.pi * paper.MODULUS * radius**2 * slope
    grid = paper.square(0.6e-3, cells, placement)
    x, y = grid.mesh
    r = np.hypot(x, y)
    found = paper.press(paper.HALF_SPACE, slope * r, grid, load)
    # Not at the apex, where the pressure is infinite.
    away = r > 0
    return [
        _approach(cone.cone(load, angle, paper.MODULUS).approach, found),
        _area(math.pi * radius**2, found, grid),
        _pressure(found.pressure[away], cone.pressure(r[away], load, angle, paper.MODULUS)),
    ]


WAVE = "Westergaard (1939); Johnson (1985), section 13.2"


@reference("Westergaard's wave, p/p* = 0.4", WAVE, 63, 255, 1023, placements=8)
def _westergaard(cells: int, placement: float) -> list[Row]:
    mean = 0.4 * math.pi * paper.MODULUS * AMPLITUDE / WAVELENGTH
    exact = sinusoid.westergaard(mean, AMPLITUDE, WAVELENGTH, paper.MODULUS)
    grid = Grid((WAVELENGTH, 2 * WAVELENGTH / cells), (cells, 2))
    x, y = grid.mesh
    x = x + placement * grid.spacing[0]
    gap = -AMPLITUDE * np.cos(2 * np.pi * x / WAVELENGTH) + 0 * y
    load = exact.mean_pressure * grid.size[0] * grid.size[1]
    line = paper.press(paper.PERIODIC, gap, grid, load).pressure[:, 0]
    share = np.count_nonzero(line) / cells
    return [
        _peak(exact.peak_pressure, line),
        Row("share in contact, counted", "1", exact.contact_fraction, share, 5e-3, 1.0),
        _pressure(line, sinusoid.westergaard_pressure(x[:, 0], exact, WAVELENGTH)),
    ]


def _egg_box(ratio: float, cells: tuple[int, int]) -> tuple[ContactSolution, sinusoid.WavyLimits]:
    mean = ratio * math.sqrt(2) * math.pi * paper.MODULUS * AMPLITUDE / WAVELENGTH
    limits = sinusoid.johnson_greenwood_higginson(mean, AMPLITUDE, WAVELENGTH, paper.MODULUS)
    grid = Grid((WAVELENGTH, WAVELENGTH), cells)
    # A cell on each crest.
    along, across = (np.cos(2 * np.pi * np.arange(n) / n) for n in cells)
    gap = AMPLITUDE * (1 - along[:, None] * across[None, :])
    return paper.press(paper.PERIODIC, gap, grid, mean * WAVELENGTH**2), limits


@reference("wavy both ways, p/p* = 0.001: Hertz on each crest", JOHNSON, 512)
def _light(cells: int, placement: float) -> list[Row]:
    found, limits = _egg_box(1e-3, (cells, cells))
    crest = 0.5 * 1e-3 * limits.complete * WAVELENGTH**2
    curvature = AMPLITUDE * (2 * math.pi / WAVELENGTH) ** 2
    exact = hertz.point(paper.MODULUS, crest, curvature, curvature).peak_pressure
    highest, share = float(np.max(found.pressure)), float(np.mean(found.pressure > 0))
    neighbours, coarse = "limit; error is also the neighbours'", "limit; 18 cells a radius"
    return [
        Row("peak pressure", "Pa", exact, highest, 1e-2, note=neighbours),
        Row("share in contact, counted", "1", limits.light_area, share, 5e-2, note=coarse),
    ]


@reference("wavy both ways, p/p* = 0.99: pockets at the troughs", JOHNSON, 512)
def _heavy(cells: int, placement: float) -> list[Row]:
    found, limits = _egg_box(0.99, (cells, cells))
    exact, left = 1 - limits.heavy_area, float(np.mean(found.pressure == 0))
    return [Row("share left open, counted", "1", exact, left, 5e-2, note="limit of p/p* -> 1")]


@reference("wavy both ways, p/p* = 1.2: full contact", JOHNSON, 64)
def _closed(cells: int, placement: float) -> list[Row]:
    found, limits = _egg_box(1.2, (cells, cells // 2))
    name, closing = "pressure that closes the gap", 0.5 * float(np.ptp(found.pressure))
    mean = "a mean pressure displaces nothing; the gap's mean"
    return [
        Row(name, "Pa", limits.complete, closing, 1e-8, note="exact on any grid"),
        Row("approach", "m", AMPLITUDE, found.approach, 1e-8, note=mean),
    ]
