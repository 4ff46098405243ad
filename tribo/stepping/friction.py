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
    if not model.friction_varies:
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


def friction_work(model: Model, before: State, after: State) -> float:
    """Return the work of friction over a step, in J.

    What an effect provides is taken to go in a straight line, as a force, between both ends of the
    step: after a jump of the load that it begins with, and before one that it ends with.
    """
    if not model.friction_varies:
        friction = model.friction_coefficient or 0.0
        return friction * (after.load_distance - before.load_distance)
    loads = model.loads.after(before.time), model.loads.before(after.time)
    # Both at the speed of the step.
    ends = replace(before, speed=after.speed), after
    forces = [
        (mean_friction(model, state) or 0.0) * model.loads.over_cycle(load)
        for state, load in zip(ends, loads, strict=True)
    ]
    return 0.5 * sum(forces) * (after.distance - before.distance)
