"""Wavy surfaces on the periodic half-space."""

from __future__ import annotations

import math

import numpy as np

from tribo.closed_forms import hertz, sinusoid
from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.verification.contacts import peak, pressure
from tribo.verification.problems import MODULUS, PERIODIC, press
from tribo.verification.reference import Row, reference

WAVELENGTH, AMPLITUDE = 1e-4, 1e-6
JOHNSON = "Johnson, Greenwood & Higginson (1985)"


@reference(
    "Westergaard's wave, p/p* = 0.4",
    "Westergaard (1939); Johnson (1985), section 13.2",
    *(63, 255, 1023),
    placements=8,
)
def _westergaard(cells: int, placement: float) -> list[Row]:
    exact = sinusoid.westergaard(
        0.4 * math.pi * MODULUS * AMPLITUDE / WAVELENGTH, AMPLITUDE, WAVELENGTH, MODULUS
    )
    grid = Grid((WAVELENGTH, 2 * WAVELENGTH / cells), (cells, 2))
    x, y = grid.mesh
    x = x + placement * grid.spacing[0]
    gap = -AMPLITUDE * np.cos(2 * np.pi * x / WAVELENGTH) + 0 * y
    found = press(PERIODIC, gap, grid, exact.mean_pressure * grid.size[0] * grid.size[1])
    line = found.pressure[:, 0]
    share = np.count_nonzero(line) / cells
    return [
        peak(exact.peak_pressure, line),
        Row("share in contact, counted", "1", exact.contact_fraction, share, 5e-3, 1.0),
        pressure(line, sinusoid.westergaard_pressure(x[:, 0], exact, WAVELENGTH)),
    ]


def _egg_box(ratio: float, cells: tuple[int, int]) -> tuple[Array, sinusoid.WavyLimits]:
    mean = ratio * math.sqrt(2) * math.pi * MODULUS * AMPLITUDE / WAVELENGTH
    limits = sinusoid.johnson_greenwood_higginson(mean, AMPLITUDE, WAVELENGTH, MODULUS)
    grid = Grid((WAVELENGTH, WAVELENGTH), cells)
    # A cell on each crest.
    along, across = (np.cos(2 * np.pi * np.arange(n) / n) for n in cells)
    gap = -AMPLITUDE * along[:, None] * across[None, :]
    return press(PERIODIC, gap, grid, mean * WAVELENGTH**2).pressure, limits


@reference("wavy both ways, p/p* = 0.001: Hertz on each crest", JOHNSON, 512)
def _light(cells: int, placement: float) -> list[Row]:
    found, limits = _egg_box(1e-3, (cells, cells))
    crest = 0.5 * 1e-3 * limits.complete * WAVELENGTH**2
    curvature = AMPLITUDE * (2 * math.pi / WAVELENGTH) ** 2
    exact = hertz.point(MODULUS, crest, curvature, curvature).peak_pressure
    highest, share = float(np.max(found)), float(np.mean(found > 0))
    neighbours, coarse = "limit; error is also the neighbours'", "limit; 18 cells a radius"
    return [
        Row("peak pressure", "Pa", exact, highest, 1e-2, note=neighbours),
        Row("share in contact, counted", "1", limits.light_area, share, 5e-2, note=coarse),
    ]


@reference("wavy both ways, p/p* = 0.99: pockets at the troughs", JOHNSON, 512)
def _heavy(cells: int, placement: float) -> list[Row]:
    found, limits = _egg_box(0.99, (cells, cells))
    exact, left = 1 - limits.heavy_area, float(np.mean(found == 0))
    return [Row("share left open, counted", "1", exact, left, 5e-2, note="limit of p/p* -> 1")]


@reference("wavy both ways, p/p* = 1.2: full contact", JOHNSON, 64)
def _closed(cells: int, placement: float) -> list[Row]:
    found, limits = _egg_box(1.2, (cells, cells // 2))
    name, closing = "pressure that closes the gap", 0.5 * float(np.ptp(found))
    return [Row(name, "Pa", limits.complete, closing, 1e-8, note="exact on any grid")]
