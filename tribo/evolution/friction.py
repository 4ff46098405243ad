"""The friction of a contact, by the case or by an effect."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.contact import ContactSolution
from tribo.core.fields import FRICTION_COEFFICIENT, LOCAL_SLIP
from tribo.core.state import State
from tribo.evolution.course import Course
from tribo.evolution.interval import Moment, interval_from
from tribo.evolution.local_fields import local_fields, weighed
from tribo.evolution.states import Memory, remembered, under
from tribo.integration.division import integrated
from tribo.integration.kept import Sum

if TYPE_CHECKING:
    from tribo.model.model import Model


def friction_force(model: Model, state: State) -> float:
    """Return the force of friction at `state`, the mean over a cycle, in N; 0 at rest.

    NaN where neither the case nor an effect gives a coefficient of friction.
    """
    if not model.laws.friction_varies and model.laws.friction_coefficient is None:
        return np.nan
    if state.speed == 0:
        return 0.0
    moment = Moment(state.time, state.distance, state.speed)
    load = model.contact.loads.over_cycle(model.loads(state).before(state.time))
    return load * _mean(
        model, [each.pressure for each in state.contacts], remembered(model, state), moment
    )


def _mean(model: Model, pressures: Sequence[Array], memory: Memory, moment: Moment) -> float:
    """Return the coefficient of friction at a moment, weighted with the load over a cycle.

    Where points slip less than the motion it is the energy dissipated per newton and metre.
    """
    laws = model.laws
    # What is the same at all points is no part of the mean.
    even = 1.0 if laws.friction_varies else laws.friction_coefficient or 0.0
    weights = [FRICTION_COEFFICIENT.name] if laws.friction_varies else []
    weights += [LOCAL_SLIP.name] if laws.slips_locally else []
    if not weights:
        return even
    force = load = 0.0
    for position, pressure in enumerate(pressures):
        place, here = model.cycle[position], under(model, memory, position)
        for speed, share in place.speeds or [(moment.speed, 1.0)]:
            at_speed = replace(moment, speed=speed)
            fields = local_fields(model, pressure, at_speed, position, here)
            force += share * place.share * float(np.sum(weighed(pressure, fields, weights)))
            load += share * place.share * float(np.sum(pressure))
    return even * (force / load)


def with_friction_work(
    model: Model,
    before: State,
    after: State,
    contacts: Sequence[ContactSolution],
    course: Course,
) -> State:
    """Return `after`, the end of a step, with the work of friction over it.

    With states it is integrated with the wear, under the same pressures: V = (k/μ) W. Else load and
    pressure change linearly from one end of the step to the other: from after a jump of the load at
    its beginning to before a jump at its end.
    """
    carried = after.load_distance - before.load_distance
    if course.friction_work is not None:
        work = course.friction_work
    elif model.laws.slips_locally:
        interval = interval_from(before, after.distance - before.distance, after.time)
        pressures = [contact.pressure for contact in contacts]
        work = carried * _mean(model, pressures, remembered(model, before), interval.end)
    elif model.laws.friction_varies:
        work = _varying_work(model, before, after)
    else:
        work = (model.laws.friction_coefficient or 0.0) * carried
    return replace(after, friction_energy=before.friction_energy + work)


def _varying_work(model: Model, before: State, after: State) -> float:
    """Return the integral of the friction coefficient of effects times the load, in J."""
    interval = interval_from(before, after.distance - before.distance, after.time)
    memory, over_cycle = remembered(model, before), model.contact.loads.over_cycle
    first = over_cycle(model.loads(before).after(before.time))
    last = over_cycle(model.loads(before).before(after.time))

    def rates(_: Sequence[Array], passed: float) -> list[Array]:
        between = [
            readonly((1 - passed) * one.pressure + passed * other.pressure)
            for one, other in zip(before.contacts, after.contacts, strict=True)
        ]
        now = replace(interval.at(passed), speed=after.speed)
        load = (1 - passed) * first + passed * last
        return [np.array(_mean(model, between, memory, now) * load)]

    return float(integrated(rates, [], interval.slides, [], [Sum()]).sums[0])
