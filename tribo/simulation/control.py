"""How long the next implicit step may be."""

from __future__ import annotations

import math

import numpy as np

from tribo.config.stepping import Implicit
from tribo.core.state import State
from tribo.simulation.model import Model
from tribo.simulation.rates import Moment, law_states, wear_rates
from tribo.simulation.step import ImplicitStep

FIRST = 0.05
VOLUME = 5.0
"""Error of the volume that a step wears, in depth tolerances: a body ends with 0.1 to 0.4 % too
little at the default."""
LATE = 0.003
"""Depth of a step, of the depth worn so far, below which its volume need not be as exact."""
SAFETY = 0.9
SHRINK, GROW = 0.2, 2.5


def first_increment(model: Model, state: State, remaining: float) -> float:
    """Return a first increment that wears a small part of the elastic approach, in m."""
    moment = Moment(state.time, state.distance, remaining / (model.end_time - state.time))
    rates = wear_rates(model, state.contact, law_states(state), moment)
    fastest = max((float(np.max(rate.depth_rate)) for rate in rates.values()), default=0.0)
    part = FIRST * state.reference_depth
    # Two flats that repeat have no approach, and wear evenly.
    return min(remaining, part / fastest) if fastest > 0 and part > 0 else remaining


def step_error(config: Implicit, before: State, step: ImplicitStep) -> tuple[float, float, float]:
    """Return the step's depth, pressure and volume errors as multiples of their tolerances.

    The local error of backward Euler in depth is half of what its wear
    differs from forward Euler's. It is weighted with the load, since the
    largest difference is always at newly touched edge cells, and compared
    with the depth worn so far (and a part of the first approach, below which
    wear does not alter the contact). The pressure lags by about a quarter of
    the relative increment of distance, so its load-weighted relative change
    Σ|Δp|/Σp is limited too.

    Where a body wore too little in depth, the load goes elsewhere and mends
    it: errors of depth do not add up. Those of volume do, for a law that is
    not linear in pressure or that remembers, and all have one sign. So the
    volume's is compared with what the step itself wears.
    """
    after = step.state
    p0, p1 = before.contact.pressure, after.contact.pressure
    load = float(np.sum(p1))
    pressure_error = float(np.sum(np.abs(p1 - p0))) / load
    depth_error = volume_error = 0.0
    for name, forward in step.forward.items():
        worn = after.bodies[name].wear - before.bodies[name].wear
        lag = np.abs(worn - forward)
        scale = float(np.max(after.bodies[name].wear)) + FIRST * after.reference_depth
        depth_error = max(depth_error, 0.5 * float(np.sum(p1 * lag)) / (load * scale))
        own = 0.5 * (worn + forward)
        if np.any(own > 0):
            share = min(1.0, float(np.max(own)) / (LATE * scale))
            missed = 0.5 * abs(float(np.sum(worn)) - float(np.sum(forward)))
            volume_error = max(volume_error, share * missed / float(np.sum(own)))
    return (
        depth_error / config.depth_tolerance,
        pressure_error / config.pressure_tolerance,
        volume_error / (VOLUME * config.depth_tolerance),
    )


def next_factor(depth_error: float, pressure_error: float, volume_error: float) -> float:
    """Return by how much the next increment may differ, from errors in tolerances."""
    # The depth error of a step grows as its square, the two others in proportion.
    wanted = SAFETY * min(
        1 / math.sqrt(depth_error) if depth_error > 0 else GROW,
        1 / pressure_error if pressure_error > 0 else GROW,
        1 / volume_error if volume_error > 0 else GROW,
    )
    return min(GROW, max(SHRINK, wanted))


def fitted(natural: float, remaining: float, target: float, settle: float) -> float:
    """Return the increment to take with `remaining` metres to a save at `target`.

    Before a save the increments are halved down to ``settle * target``, which
    lets the pressure catch up with the wear.
    """
    shortest = settle * target
    increment = min(natural, max(0.5 * remaining, shortest))
    if remaining <= increment * (1 + 1e-9):
        return remaining
    # Two equal steps rather than a full one and a sliver.
    return 0.5 * remaining if remaining < 2 * increment else increment
