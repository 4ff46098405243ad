"""The friction of a contact: that of the case, or what an effect makes of it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.fields import FRICTION_COEFFICIENT
from tribo.core.state import State
from tribo.stepping.memory import remembered, under
from tribo.stepping.rates import Moment, local_fields

if TYPE_CHECKING:
    from tribo.simulation.model import Model


def mean_friction(model: Model, state: State) -> float | None:
    """Return the coefficient of friction at `state`, weighted with the load over a cycle.

    Where an effect provides it, it is asked at the speeds of the cycle. None where nothing does.
    """
    provided = (field.name for effect in model.effects for field in effect.provides)
    if FRICTION_COEFFICIENT.name not in provided:
        return model.friction_coefficient
    force = load = 0.0
    memory = remembered(state)
    for position, contact in enumerate(state.contacts):
        place, here = model.cycle[position], under(model, memory, position)
        carried = place.share * float(np.sum(contact.pressure))
        load += carried
        for speed, share in place.speeds or [(state.speed, 1.0)]:
            moment = Moment(state.time, state.distance, speed)
            fields = local_fields(model, contact.pressure, moment, position, here)
            # It acts on both bodies alike.
            (friction, *_) = fields[FRICTION_COEFFICIENT.name].values()
            force += share * place.share * float(np.sum(friction * contact.pressure))
    return force / load


def friction_energy(model: Model, before: State, after: State) -> float:
    """Return the work of friction up to `after`, in J, of a step that begins at `before`."""
    # Both at the speed of the step.
    ends = [mean_friction(model, state) for state in (replace(before, speed=after.speed), after)]
    mean = 0.5 * sum(end or 0.0 for end in ends)
    return before.friction_energy + mean * (after.load_distance - before.load_distance)
