"""Wear so deep that a slip of units is more likely than the wear."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tribo.core.contact import ContactSystem
from tribo.core.errors import TriboError
from tribo.core.state import State
from tribo.simulation.model import Model
from tribo.simulation.motion import path_at
from tribo.simulation.rates import Moment, law_states, wear_rates

DEEP = 0.1
"""Wear depth, relative to the radius of curvature, from which on it is doubted."""


def too_deep(system: ContactSystem, depths: Mapping[str, float]) -> list[str]:
    """Ask about each body whose wear depth, in m, is implausible for the contact's curvature."""
    curvature = max(system.curvature or (0.0, 0.0))
    return [
        f"{name} would wear about {1e3 * depth:.3g} mm deep, which is {depth * curvature:.3g} "
        f"times the radius of curvature of {1e3 / curvature:.3g} mm: is its wear coefficient in "
        "the unit that was meant? A bare k is in 1/Pa; write '1e-6 mm^3/(N m)' for that unit"
        for name, depth in depths.items()
        if depth * curvature > DEEP
    ]


def asked_of(model: Model, state: State) -> str:
    """Return what to ask, if anything, where a run fails that would wear on at its present rate."""
    time = model.end_time - state.time
    if not time > 0:
        return ""
    try:
        depths = _depths_to_come(model, state, time)
    except TriboError:
        # What fails here must not hide what the question is added to.
        return ""
    asked = too_deep(model.system, depths)
    return f". At this rate {'; '.join(asked)}" if asked else ""


def _depths_to_come(model: Model, state: State, time: float) -> dict[str, float]:
    left = path_at(model.kinematics, model.end_time) - state.distance
    moment = Moment(state.time, state.distance, left / time)
    rates = wear_rates(model, state.contact, law_states(state), moment)
    return {
        name: left * float(np.max(model.exposures[name].average(rate.depth)))
        for name, rate in rates.items()
    }
