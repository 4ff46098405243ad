"""Ask effects and laws the same twice: their answers must not change."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.errors import PluginError
from tribo.core.state import State
from tribo.simulation.calling import Called, named
from tribo.simulation.model import Model
from tribo.simulation.motion import path_at
from tribo.simulation.rates import Moment, law_states, local_fields, wear_rates

SAME = 1e-9
"""Relative difference that may be rounding; a tenth of what an implicit step settles to."""


def check_repeatable(model: Model, state: State) -> None:
    """Raise `PluginError` if an effect or a law does not repeat its answer at `state`."""
    time = model.end_time - state.time
    left = path_at(model.kinematics, model.end_time) - state.distance
    moment = Moment(state.time, state.distance, left / time if time > 0 else 0.0)
    for component, body, first, second in _twice(model, state, moment):
        if np.max(np.abs(second - first)) > SAME * np.max(np.abs(first)):
            raise PluginError(
                f"{named(component, body)} gave two answers to the same question{moment.words}, so "
                "that no step can settle: it must not be random, nor remember what it was asked "
                f"(a law's memory is its state_fields); 'tribo plugins check "
                f"{component.type}' tests it"
            )


def _twice(
    model: Model, state: State, moment: Moment
) -> Iterator[tuple[Called, str | None, Array, Array]]:
    """Yield each component, the body it belongs to, and its two answers, effects first."""
    pressure = readonly(state.contact.pressure)
    one, other = (local_fields(model, pressure, moment) for _ in range(2))
    for effect in model.effects:
        for provided in effect.provides:
            for who in model.bodies:
                first, second = (fields[provided.name][who] for fields in (one, other))
                yield effect, None, first, second
    known = law_states(state)
    once, again = (wear_rates(model, state.contact, known, moment) for _ in range(2))
    for name, body in model.bodies.items():
        if body.wear is not None:
            rate, repeated = once[name], again[name]
            yield body.wear, name, rate.depth_rate, repeated.depth_rate
            yield body.wear, name, rate.depth_slope, repeated.depth_slope
            for field, values in rate.state_rates.items():
                yield body.wear, name, values, repeated.state_rates[field]
