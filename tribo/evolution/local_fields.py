"""Fields at the points of a contact: what effects and the case provide, and states."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.fields import (
    FRICTION_COEFFICIENT,
    LOAD_SHARE,
    OF_MOTION,
    ContactConditions,
)
from tribo.core.state import State
from tribo.evolution.interval import Moment
from tribo.evolution.states import Memory, fields_of, own_state, remembered, under

if TYPE_CHECKING:
    from tribo.guards.parts import GuardedEffect
    from tribo.model.model import Model


def effect_fields(model: Model, state: State) -> dict[str, dict[str, Array]]:
    """Return the fields of effects at `state`, by field and body, shape (nx, ny)."""
    middle, speed = model.cycle.middle, state.speed
    speeds = model.cycle[middle].speeds
    # None of an average's speeds belongs to the pressure shown.
    if speeds is not None and len(model.cycle) > 1 and speed > 0:
        speed = 1 / sum(share / v for v, share in speeds)
    moment = Moment(state.time, state.distance, speed)
    memory = under(model, remembered(model, state), middle)
    fields = local_fields(model, state.contact.pressure, moment, middle, memory)
    return {field.name: fields[field.name] for e in model.laws.effects for field in e.provides}


def local_fields(
    model: Model, pressure: Array, moment: Moment, position: int, memory: Memory
) -> dict[str, dict[str, Array]]:
    """Return the fields of effects and of the case at a position, by field and body, (nx, ny).

    `memory` has the states in the window at this position, which are among the fields.
    """
    fields = fields_of(model, memory)
    if model.laws.required & OF_MOTION.keys():
        fields |= model.cycle.fields[position]
    friction = model.laws.friction_coefficient
    if friction is not None:
        uniform = readonly(np.full(pressure.shape, friction))
        fields[FRICTION_COEFFICIENT.name] = dict.fromkeys(model.case.bodies, uniform)
    for effect in model.laws.effects:
        if effect.provides:
            given = conditions(model, pressure, moment, fields, effect, memory)
            found, before = effect.fields(given), fields.get(LOAD_SHARE.name)
            if before is not None and LOAD_SHARE.name in found:
                # It takes its part of what those before it leave.
                found[LOAD_SHARE.name] = {
                    name: readonly(1 - (1 - before[name]) * (1 - share))
                    for name, share in found[LOAD_SHARE.name].items()
                }
            fields |= found
    return fields


def conditions(
    model: Model,
    pressure: Array,
    moment: Moment,
    fields: Mapping[str, Mapping[str, Array]],
    effect: GuardedEffect,
    memory: Memory,
) -> ContactConditions:
    """Return the input of an effect in the window."""
    motion = model.case.kinematics
    return ContactConditions(
        system=model.contact.system,
        pressure=readonly(pressure),
        speed=moment.speed,
        time=moment.time,
        distance=moment.distance,
        swept=model.cycle.swept,
        track=motion.track_extent,
        turns_back=motion.turns_back,
        fields={name: copy(of_bodies) for name, of_bodies in fields.items()},
        state=own_state(model, effect, memory),
    )
