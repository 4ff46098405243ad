"""Ask effects and laws the same twice: their answers must not change."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import PluginError
from tribo.core.rounding import ROUND_OFF
from tribo.core.state import State
from tribo.evolution.interval import Moment
from tribo.evolution.local_fields import local_fields
from tribo.evolution.rates import rates_at_each
from tribo.evolution.states import remembered, under

if TYPE_CHECKING:
    from tribo.model.model import Model


def check_repeatable(model: Model, state: State) -> None:
    """Raise `PluginError` if an effect or a law does not repeat its answer at `state`."""
    time = model.end_time - state.time
    left = model.motion.distance_at(model.end_time) - state.distance
    moment = Moment(state.time, state.distance, left / time if time > 0 else 0.0)
    once, again = (list(_answers(model, state, moment)) for _ in range(2))
    for (who, first), (_, second) in zip(once, again, strict=True):
        if np.max(np.abs(second - first)) > ROUND_OFF * np.max(np.abs(first)):
            raise PluginError(
                f"{who} gave two answers to the same question, so that no step can settle: it must "
                "not be random, nor remember what it was asked (a law's memory is its "
                f"state_fields); 'tribo plugins check {who.component.type}' tests it"
            )


def _answers(model: Model, state: State, moment: Moment) -> Iterator[tuple[Any, Array]]:
    """Yield each array that the effects, and then the laws, answer at `state`, with who did."""
    middle, memory = len(model.cycle) // 2, remembered(model, state)
    here = under(model, memory, middle)
    fields = local_fields(model, state.contact.pressure, moment, middle, here)
    for effect in model.laws.effects:
        for field in effect.provides:
            yield from ((effect, values) for values in fields[field.name].values())
    for rates in rates_at_each(model, state.contacts, memory, moment):
        for name, rate in rates.wear.items():
            for values in (rate.depth_rate, rate.depth_slope, *rate.state_rates.values()):
                yield model.laws.wear[name], values
        for key, values in rates.between.items():
            yield model.laws.between[key][0], values
