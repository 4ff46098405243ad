"""Wear laws and their coefficients: depths under a known pressure, volumes under a known load."""

from __future__ import annotations

import numpy as np

from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.simulation.measure import measure
from tribo.verification.check import Check, Found, Quantity
from tribo.verification.problems import (
    HARDNESS,
    LOAD,
    POISSON,
    WEAR_COEFFICIENT,
    YOUNG,
    Shape,
    ball,
    half_space,
    on_flat,
    periodic,
    slide,
)
from tribo.wear.archard import Archard
from tribo.wear.law import WearLaw
from tribo.wear.power import Power

K, REFERENCE = WEAR_COEFFICIENT, 1e9
PRESSURE = 0.4e9
DISTANCE, STEPS = 5.0, 2
WIDTH = 1e-4


def _pin(law: WearLaw, hardness: float | None = None) -> float:
    """Return the depth worn off a flat pin that presses evenly."""
    pin = Shape(heights=lambda grid: np.zeros(grid.cells))
    model = on_flat(
        pin,
        Grid((WIDTH, WIDTH), (4, 4)),
        periodic(),
        load=PRESSURE * WIDTH**2,
        ball_law=law,
        material=Material(young=YOUNG, poisson=POISSON, hardness=hardness),
    )
    _, state = slide(model, DISTANCE, STEPS)
    return float(np.mean(state.bodies["ball"].wear))


def _power(exponent: float) -> tuple[float, float]:
    law = Power(k=K, p_exponent=exponent, reference_pressure=REFERENCE)
    return K * REFERENCE * (PRESSURE / REFERENCE) ** exponent * DISTANCE, _pin(law)


def _flat_pin(level: int, placement: float) -> Found:
    archard = K * PRESSURE * DISTANCE
    ratio = K * HARDNESS
    return {
        "depth, archard by k": (archard, _pin(Archard(k=K))),
        "depth, archard by K and its hardness": (
            archard,
            _pin(Archard(K=ratio, hardness=HARDNESS)),
        ),
        "depth, archard by K and the body's hardness": (
            archard,
            _pin(Archard(K=ratio), HARDNESS),
        ),
        "depth, power 1.5": _power(1.5),
        "depth, power 3": _power(3.0),
    }


def _both(level: int, placement: float) -> Found:
    model = on_flat(
        ball(),
        Grid((0.7e-3, 0.7e-3), (level, level)),
        half_space(1e-8),
        ball_k=K,
        flat_k=3 * K,
        distance=DISTANCE,
    )
    _, state = slide(model, DISTANCE, 5)
    bodies = measure(model, state).bodies
    return {
        "volume of the ball": (K * LOAD * DISTANCE, bodies["ball"].wear_volume),
        "volume of the flat": (3 * K * LOAD * DISTANCE, bodies["flat"].wear_volume),
    }


EXACT = "exact at any step"
CHECKS = (
    Check(
        "flat pin under even pressure wears",
        "h = k p s; k = K/H (Archard 1953); h = k p0 (p/p0)^m s (Rhee 1970)",
        _flat_pin,
        tuple(
            Quantity(f"depth, {law}", "m", 1e-8, note=EXACT)
            for law in (
                "archard by k",
                "archard by K and its hardness",
                "archard by K and the body's hardness",
                "power 1.5",
                "power 3",
            )
        ),
        levels=(4,),
        cost=0.1,
    ),
    Check(
        "ball and flat wear, the flat by three times the coefficient",
        "V = kFs (Archard 1953)",
        _both,
        (
            Quantity("volume of the ball", "m^3", 1e-10, note="V = kFs, exact"),
            Quantity("volume of the flat", "m^3", 1e-10, note="V = kFs, exact"),
        ),
        levels=(32,),
        cost=0.2,
    ),
)
