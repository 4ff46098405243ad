"""The limits of the pressure cap: none below it, A = F/H far above."""

from __future__ import annotations

import math

import numpy as np

from tribo.closed_forms import hertz
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.measures import contact_area
from tribo.simulation.model import Model
from tribo.stepping.step import first_contact, start_sliding
from tribo.verification.check import Check, Found, Quantity
from tribo.verification.problems import (
    HARDNESS,
    MODULUS,
    POISSON,
    RADIUS,
    YOUNG,
    ball,
    half_space,
    norm,
    on_flat,
    press,
)

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


def _soft(load: float, cells: int) -> Model:
    soft = Material(young=YOUNG, poisson=POISSON, hardness=HARDNESS)
    return on_flat(ball(), _ball(load, cells)[0], half_space(), load=load, material=soft)


def _above(factor: int, placement: float) -> Found:
    load = factor * ONSET
    state = first_contact(_soft(load, 127))
    pressure = state.contact.pressure
    # A disc under H throughout: its edge is where the bodies just touch. What the ball reaches
    # into the flat there, less what the flat's surface is dished elastically, is permanent.
    radius = math.sqrt(load / HARDNESS / math.pi)
    dished = (2 - 4 / math.pi) * HARDNESS * radius / MODULUS
    return {
        "peak pressure": (HARDNESS, float(np.max(pressure))),
        "mean pressure": (HARDNESS, load / contact_area(pressure, _ball(load, 127)[0])),
        "plastic depth of both bodies": (
            radius**2 / (2 * RADIUS) - dished,
            sum(float(np.max(body.plastic)) for body in state.bodies.values()),
        ),
    }


def _groove(cells: int, placement: float) -> Found:
    model = _soft(3 * ONSET, cells)
    state = start_sliding(model, first_contact(model))
    depth = state.bodies["flat"].plastic
    deepest = float(np.max(depth))
    return {
        "variation along the groove / depth": (0.0, float(np.max(np.ptp(depth, axis=0))) / deepest),
        "further depth / depth": (0.0, float(np.max(state.contact.overlap)) / deepest),
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
            Quantity("plastic depth of both bodies", "m", 1e-2, note="limit of uniform pressure"),
        ),
        levels=(5, 10, 20),
        cost=1.0,
    ),
    Check(
        "hardness, ball draws a groove as it begins to slide",
        "the envelope of the indentation along the track",
        _groove,
        (
            Quantity("variation along the groove / depth", "1", 0.0, note="exact"),
            Quantity("further depth / depth", "1", 1e-6, note="at rest to tolerance"),
        ),
        levels=(33,),
        cost=0.1,
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
