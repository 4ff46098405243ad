"""The friction of a contact, by the case or by an effect."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.contact import ContactSolution
from tribo.core.fields import FRICTION_COEFFICIENT, LOCAL_SLIP
from tribo.core.state import State
from tribo.evolution.course import Course, varying_work
from tribo.evolution.interval import Moment, interval_from
from tribo.evolution.rates import friction_of, rates_at_each
from tribo.evolution.states import Memory, remembered

if TYPE_CHECKING:
    from tribo.model.model import Model


def friction_force(model: Model, state: State) -> float:
    """Return the force of friction at `state`, the mean over a cycle, in N; 0 at rest.

    NaN where neither the case nor an effect gives a coefficient of friction.
    """
    laws = model.laws
    if FRICTION_COEFFICIENT.name not in laws.provided and laws.friction_coefficient is None:
        return np.nan
    if state.speed == 0:
        return 0.0
    moment = Moment(state.time, state.distance, state.speed)
    load = model.loads(state).before(state.time)
    return load * _mean(model, state.contacts, remembered(model, state), moment)


def _mean(
    model: Model, contacts: Sequence[ContactSolution], memory: Memory, moment: Moment
) -> float:
    """Return the energy that friction dissipates at a moment, per newton and metre of a cycle."""
    if not model.laws.friction_by_point:
        return model.laws.friction_coefficient or 0.0
    load = sum(
        place.share * float(np.sum(contact.pressure))
        for place, contact in zip(model.cycle, contacts, strict=True)
    )
    work = friction_of(model, rates_at_each(model, contacts, memory, moment))
    return work / (load * model.grid.cell_area)


def with_friction_work(model: Model, before: State, after: State, course: Course) -> State:
    """Return `after`, the end of a step, with the work of friction over it.

    It is done by the pressures that wear, under the load along the step: V = (k/μ) W.
    """
    carried, laws = after.load_distance - before.load_distance, model.laws
    if course.friction_work is not None:
        work = course.friction_work
    elif not laws.friction_by_point:
        work = (laws.friction_coefficient or 0.0) * carried
    else:
        interval = interval_from(before, after.distance - before.distance, after.time)
        memory = remembered(model, before)
        if LOCAL_SLIP.name in laws.provided:
            work = carried * _mean(model, course.contacts, memory, interval.end)
        else:
            work = varying_work(model, memory, course.contacts, interval)
    return replace(after, friction_energy=before.friction_energy + work)
