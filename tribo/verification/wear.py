"""Bodies that alone wear: exact on springs, exact in full contact, limits on a half-space."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from tribo.closed_forms import ball_wear, sinusoid, winkler
from tribo.contact.winkler import Winkler
from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.measures import Measures, contact_area
from tribo.simulation.march import begin, march
from tribo.simulation.measure import measure
from tribo.simulation.model import Model
from tribo.verification.check import Check, Found, Quantity
from tribo.verification.problems import (
    LOAD,
    MODULUS,
    POISSON,
    RADIUS,
    WEAR_COEFFICIENT,
    YOUNG,
    Shape,
    ball,
    half_space,
    on_flat,
    periodic,
    slide,
)

K = WEAR_COEFFICIENT
WAVELENGTH, AMPLITUDE = 1e-4, 1e-8


def _foundation(steps: int, placement: float) -> Found:
    distance = 20.0
    hertz_radius = 148.837e-6
    stiffness = winkler.stiffness_for_half_width(MODULUS, hertz_radius)
    springs = Winkler(modulus=stiffness)
    model = on_flat(ball(), Grid((0.7e-3, 0.7e-3), (129, 129)), springs)
    _, state = slide(model, distance, steps)
    pressure = state.contact.pressure
    given = {"load": LOAD, "radius": RADIUS, "stiffness": stiffness, "wear_coefficient": K}
    exact = float(winkler.worn_sphere_pressure(0.0, distance, **given))
    radius = float(winkler.worn_sphere_half_width(distance, **given))
    return {
        "pressure at the centre": (exact, float(pressure[64, 64])),
        "approach": (radius**2 / (2 * RADIUS), state.contact.approach),
        "contact radius, counted": (
            radius,
            math.sqrt(contact_area(pressure, model.grid) / math.pi),
        ),
    }


def _end(model: Model) -> Measures:
    state = begin(model)
    for accepted in march(model, state):
        state = accepted.state
    return measure(model, state)


def _worn_ball(stiffer: int) -> tuple[Measures, float]:
    distance = 360.0
    hard = Material(young=YOUNG * stiffer, poisson=POISSON)
    model = on_flat(
        ball(), Grid((1.2e-3, 1.2e-3), (65, 65)), half_space(1e-8), distance=distance, material=hard
    )
    return _end(model), distance


def _elastic_ball(cells: int, placement: float) -> Found:
    end, distance = _worn_ball(1)
    radius = ball_wear.elastic_ball_half_width(
        distance,
        load=LOAD,
        radius=RADIUS,
        wear_coefficient=K,
        initial_half_width=(0.75 * LOAD * RADIUS / MODULUS) ** (1 / 3),
    )
    return {
        "contact radius, counted": (float(radius), math.sqrt(end.area / math.pi)),
        "worn volume": (K * LOAD * distance, end.bodies["ball"].wear_volume),
    }


def _rigid_ball(stiffer: int, placement: float) -> Found:
    end, distance = _worn_ball(stiffer)
    exact = ball_wear.ball(distance, load=LOAD, radius=RADIUS, wear_coefficient=K)
    return {"worn depth": (float(exact.depth), end.bodies["ball"].centre_wear_depth)}


def _wave(grid: Grid) -> Array:
    return np.broadcast_to(
        AMPLITUDE * np.cos(2 * np.pi * grid.mesh[0] / WAVELENGTH), grid.cells
    ).copy()


def _full_contact(steps: int, placement: float, *, explicit: bool) -> Found:
    compliance = float(sinusoid.compliance(2 * np.pi / WAVELENGTH, MODULUS))
    distance = compliance / K
    grid = Grid((WAVELENGTH, WAVELENGTH / 8), (16, 2))
    model = on_flat(Shape(heights=_wave), grid, periodic(1e-12), load=5.0)
    _, state = slide(model, distance, steps, explicit=explicit)
    left = float(np.ptp(_wave(grid) - state.bodies["ball"].wear)) / float(np.ptp(_wave(grid)))
    factor = sinusoid.explicit_euler_factor if explicit else sinusoid.implicit_euler_factor
    stepwise = float(factor(distance / steps, K, compliance)) ** steps
    return {
        "amplitude left": (float(sinusoid.worn_amplitude(distance, K, compliance)), left),
        "amplitude left, by Euler's factor": (stepwise, left),
    }


FULL_CONTACT = (
    Quantity("amplitude left", "1", 1e-2, 1.0),
    Quantity("amplitude left, by Euler's factor", "1", 1e-8, note="exact at any step"),
)
CHECKS = (
    Check(
        "ball on springs wears for 20 m, equal steps",
        "tribo.closed_forms.winkler; Johnson (1985), section 4.3",
        _foundation,
        (
            Quantity("pressure at the centre", "Pa", 5e-3, 1.0),
            Quantity("approach", "m", 1e-4, note="follows from the volume, exact in the steps"),
            Quantity(
                "contact radius, counted", "m", 2e-3, note="exact in the steps; cells at its edge"
            ),
        ),
        levels=(40, 80, 160),
    ),
    Check(
        "elastic ball wears for 360 m",
        "Argatov (2011)",
        _elastic_ball,
        (
            Quantity("contact radius, counted", "m", 1.5e-2, note="Argatov's law is good to 1 %"),
            Quantity("worn volume", "m^3", 1e-10, note="V = kFs, exact"),
        ),
        levels=(65,),
    ),
    Check(
        "ball wears for 360 m, 4, 16, 64 times as stiff: rigid limit",
        "Archard (1953); h = sqrt(kFs/(pi R))",
        _rigid_ball,
        (Quantity("worn depth", "m", 1e-3, 1.0, "order in the modulus, not the grid"),),
        levels=(4, 16, 64),
        cost=4.0,
    ),
    *(
        Check(
            f"wave in full contact, one decay length, {name} steps",
            "tribo.closed_forms.sinusoid",
            partial(_full_contact, explicit=name == "explicit"),
            FULL_CONTACT,
            levels=(20, 40, 80),
            cost=0.5,
        )
        for name in ("implicit", "explicit")
    ),
)
