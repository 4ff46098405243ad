"""The limits of the pressure cap: none below it, A = F/H far above."""

from __future__ import annotations

import math

import numpy as np

from tribo.contact import hertz
from tribo.core.grid import Grid
from tribo.core.measures import contact_area
from tribo.verification.check import Check, Found, Quantity
from tribo.verification.problems import HARDNESS, MODULUS, RADIUS, half_space, norm, press

ONSET = hertz.load_at_peak(MODULUS, HARDNESS, 1 / RADIUS)
SOURCE = "Tian & Bhushan (1996); Almqvist et al. (2007)"


def _ball(load: float, cells: int) -> tuple[Grid, np.ndarray]:
    width = 3 * math.sqrt(max(load, 2 * ONSET) / HARDNESS / math.pi)
    grid = Grid((width, width), (cells, cells))
    x, y = grid.mesh
    return grid, (x**2 + y**2) / (2 * RADIUS)


def _below(cells: int, placement: float) -> Found:
    load = 0.98 * ONSET
    grid, gap = _ball(load, cells)
    capped = press(half_space(), gap, grid, load, HARDNESS)
    elastic = press(half_space(), gap, grid, load)
    return {
        "sum |p - p_elastic| / sum p": norm(capped.pressure, elastic.pressure),
        "plastic depth": (0.0, float(np.max(capped.overlap))),
    }


def _above(factor: int, placement: float) -> Found:
    load = factor * ONSET
    grid, gap = _ball(load, 128)
    found = press(half_space(), gap, grid, load, HARDNESS)
    return {
        "peak pressure": (HARDNESS, float(np.max(found.pressure))),
        "mean pressure": (HARDNESS, load / contact_area(found.pressure, grid)),
    }


def _again(cells: int, placement: float) -> Found:
    load = 5 * ONSET
    grid, gap = _ball(load, cells)
    first = press(half_space(), gap, grid, load, HARDNESS)
    deepest = float(np.max(first.overlap))
    second = press(half_space(), gap + first.overlap, grid, load, HARDNESS)
    third = press(half_space(), gap + first.overlap, grid, 0.5 * load, HARDNESS)
    return {
        "further depth / depth, same load": (0.0, float(np.max(second.overlap)) / deepest),
        "further depth / depth, half the load": (0.0, float(np.max(third.overlap)) / deepest),
    }


CHECKS = (
    Check(
        "hardness, ball at 0.98 of the load of first yield",
        SOURCE,
        _below,
        (
            Quantity("sum |p - p_elastic| / sum p", "1", 1e-8, note="no effect below the cap"),
            Quantity("plastic depth", "m", 0.0, note="no effect below the cap"),
        ),
        levels=(95,),
        cost=0.2,
    ),
    Check(
        "hardness, ball at 5, 10, 20 times that load",
        SOURCE,
        _above,
        (
            Quantity("peak pressure", "Pa", 1e-12, note="the cap itself"),
            Quantity("mean pressure", "Pa", 1e-2, note="tends to H with the load, not the grid"),
        ),
        levels=(5, 10, 20),
        cost=1.0,
    ),
    Check(
        "hardness, ball pressed again into its indentation",
        SOURCE,
        _again,
        (
            Quantity("further depth / depth, same load", "1", 1e-6, note="at rest to tolerance"),
            Quantity("further depth / depth, half the load", "1", 0.0, note="unloads elastically"),
        ),
        levels=(95,),
        cost=1.0,
    ),
)
