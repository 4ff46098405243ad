"""Wavy surfaces on the periodic half-space."""

from __future__ import annotations

import math

import numpy as np

from tribo.closed_forms import hertz, sinusoid
from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.verification.check import Check, Found, Quantity
from tribo.verification.contacts import PRESSURE, SHAPE
from tribo.verification.problems import MODULUS, norm, periodic, press

WAVELENGTH, AMPLITUDE = 1e-4, 1e-6


def _westergaard(cells: int, placement: float) -> Found:
    contact = sinusoid.westergaard(
        0.4 * math.pi * MODULUS * AMPLITUDE / WAVELENGTH, AMPLITUDE, WAVELENGTH, MODULUS
    )
    grid = Grid((WAVELENGTH, 2 * WAVELENGTH / cells), (cells, 2))
    x, y = grid.mesh
    x = x + placement * grid.spacing[0]
    gap = -AMPLITUDE * np.cos(2 * np.pi * x / WAVELENGTH) + 0 * y
    found = press(periodic(), gap, grid, contact.mean_pressure * grid.size[0] * grid.size[1])
    line = found.pressure[:, 0]
    exact = sinusoid.westergaard_pressure(x[:, 0], contact, WAVELENGTH)
    touching = np.count_nonzero(line) / cells
    return {
        "peak pressure": (contact.peak_pressure, float(np.max(line))),
        "share in contact, counted": (contact.contact_fraction, touching),
        SHAPE: norm(line, exact),
    }


def _egg_box(ratio: float, cells: tuple[int, int]) -> tuple[Array, sinusoid.WavyLimits]:
    mean = ratio * math.sqrt(2) * math.pi * MODULUS * AMPLITUDE / WAVELENGTH
    limits = sinusoid.johnson_greenwood_higginson(mean, AMPLITUDE, WAVELENGTH, MODULUS)
    grid = Grid((WAVELENGTH, WAVELENGTH), cells)
    # A cell on each crest.
    along, across = (np.cos(2 * np.pi * np.arange(n) / n) for n in cells)
    gap = -AMPLITUDE * along[:, None] * across[None, :]
    return press(periodic(), gap, grid, mean * WAVELENGTH**2).pressure, limits


def _light(cells: int, placement: float) -> Found:
    ratio = 1e-3
    pressure, limits = _egg_box(ratio, (cells, cells))
    crest = 0.5 * ratio * limits.complete * WAVELENGTH**2
    curvature = AMPLITUDE * (2 * math.pi / WAVELENGTH) ** 2
    exact = hertz.point(MODULUS, crest, curvature, curvature)
    return {
        "peak pressure": (exact.peak_pressure, float(np.max(pressure))),
        "share in contact, counted": (limits.light_area, float(np.mean(pressure > 0))),
    }


def _heavy(cells: int, placement: float) -> Found:
    pressure, limits = _egg_box(0.99, (cells, cells))
    return {"share left open, counted": (1 - limits.heavy_area, float(np.mean(pressure == 0)))}


def _closed(cells: int, placement: float) -> Found:
    pressure, limits = _egg_box(1.2, (cells, cells // 2))
    return {"pressure that closes the gap": (limits.complete, 0.5 * float(np.ptp(pressure)))}


JOHNSON = "Johnson, Greenwood & Higginson (1985)"
CHECKS = (
    Check(
        "Westergaard's wave, p/p* = 0.4",
        "Westergaard (1939); Johnson (1985), section 13.2",
        _westergaard,
        (
            Quantity("peak pressure", "Pa", 1e-4, 2.0),
            Quantity("share in contact, counted", "1", 5e-3, 1.0),
            PRESSURE,
        ),
        levels=(63, 255, 1023),
        placements=8,
        cost=0.3,
    ),
    Check(
        "wavy both ways, p/p* = 0.001: Hertz on each crest",
        JOHNSON,
        _light,
        (
            Quantity("peak pressure", "Pa", 1e-2, note="limit; error is also the neighbours'"),
            Quantity("share in contact, counted", "1", 5e-2, note="limit; 18 cells a radius"),
        ),
        levels=(512,),
        cost=0.5,
    ),
    Check(
        "wavy both ways, p/p* = 0.99: pockets at the troughs",
        JOHNSON,
        _heavy,
        (Quantity("share left open, counted", "1", 5e-2, note="limit of p/p* -> 1"),),
        levels=(512,),
        cost=0.3,
    ),
    Check(
        "wavy both ways, p/p* = 1.2: full contact",
        JOHNSON,
        _closed,
        (Quantity("pressure that closes the gap", "Pa", 1e-8, note="exact on any grid"),),
        levels=(64,),
        cost=0.1,
    ),
)
