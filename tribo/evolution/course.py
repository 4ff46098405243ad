"""The wear of bodies and the states of laws and effects over an interval of constant contacts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.contact import ContactSolution
from tribo.core.fields import WORN_DEPTH, Field, WearRate
from tribo.evolution.interval import Interval
from tribo.evolution.rates import CycleRates, friction_of, rates_at_each, wear_rates
from tribo.evolution.states import Memory, laid, place
from tribo.integration.division import WHOLE, integrated
from tribo.integration.integrator import Share
from tribo.integration.kept import Kept, Sum, Values

if TYPE_CHECKING:
    from tribo.model.model import Model


NUDGE = 1e-4
"""Part of the pressure by which it is varied to determine the slope of a wear rate."""


@dataclass(frozen=True)
class Course:
    """An interval under constant contacts.

    Parameters
    ----------
    contacts : sequence of ContactSolution
        Its contacts, by position.
    rates : sequence of Mapping[str, WearRate]
        Mean rates over it, by position and body; without slopes where there are states.
    memory : Memory
        The states at its end.
    plan : sequence of Share
        The parts it was divided into for accurate states.
    friction_work : float or None
        Work of friction, in J, where it differs from point to point and there are states.
    passed : Mapping[str, Mapping[int, float]]
        The first share of it at which a point reaches a break of a body's depth, by body and break.
    """

    contacts: Sequence[ContactSolution]
    rates: CycleRates
    memory: Memory
    plan: Sequence[Share] = WHOLE
    friction_work: float | None = None
    passed: Mapping[str, Mapping[int, float]] = field(default_factory=dict)


def course(
    model: Model,
    before: Memory,
    contacts: Sequence[ContactSolution],
    interval: Interval,
    plan: Sequence[Share] = WHOLE,
    *,
    adapts: bool = True,
    asked: float = 1.0,
) -> Course:
    """Return the mean rates over an interval and the states at its end, from the states before it.

    It is divided as in `plan`, or finer if it `adapts`. Without states the rates are constant: the
    rates at the part `asked` of the interval.
    """
    if not before.values:
        return Course(contacts, wear_rates(model, contacts, before, interval.at(asked)), before)
    rates = partial(_rates, model, before, contacts, interval)
    sums = [
        Sum(place(model, name), partial(model.cycle.maps[name].see, position=position))
        for position in range(len(contacts))
        for name in model.laws.wear
    ]
    if model.laws.friction_by_point:
        sums.append(Sum())
    kept = kept_in(model, before)
    found = integrated(rates, before.values, interval.length, kept, sums, plan, adapts=adapts)
    each = iter(found.sums)
    mean = [
        {name: WearRate(np.maximum(next(each), 0.0) / interval.length) for name in model.laws.wear}
        for _ in contacts
    ]
    passed: dict[str, dict[int, float]] = {}
    for (state, layer), share in found.passed.items():
        body = before.bodies[state]
        if body and kept[state].name == WORN_DEPTH.name:
            passed.setdefault(body, {})[layer] = share
    work = float(next(each)) if model.laws.friction_by_point else None
    after = before.with_values(iter(found.values))
    return Course(contacts, mean, after, found.plan, work, passed)


def varying_work(
    model: Model, before: Memory, contacts: Sequence[ContactSolution], interval: Interval
) -> float:
    """Return the work of friction over an interval without states, in J."""

    def rates(_: Sequence[Array], passed: float) -> Values:
        return _rates(model, before, contacts, interval, [], passed)[-1:]

    return float(integrated(rates, [], interval.length, [], [Sum()]).sums[0])


def sloped(model: Model, before: Memory, interval: Interval, known: Course) -> CycleRates:
    """Return the mean rates of a course with their total slopes in pressure.

    Where the pressure is 0 the slope is the law's.
    """
    if not before.values:
        return known.rates
    # The pressure varies up and down from row to row: the mode that grows first, at the same load.
    stripes = [NUDGE * contact.pressure for contact in known.contacts]
    for stripe in stripes:
        stripe[:, ::2] *= -1
    nudged = [
        replace(contact, pressure=readonly(contact.pressure + stripe))
        for contact, stripe in zip(known.contacts, stripes, strict=True)
    ]
    other = course(model, before, nudged, interval, known.plan, adapts=False)
    laws = wear_rates(model, known.contacts, known.memory, interval.end)
    sloped = [dict(rates) for rates in known.rates]
    for at, rates, higher, law, stripe in zip(
        known.rates, sloped, other.rates, laws, stripes, strict=True
    ):
        for name, rate in rates.items():
            change = higher[name].depth_rate - at[name].depth_rate
            slope = law[name].depth_slope.copy()
            np.divide(change, stripe, out=slope, where=stripe != 0)
            rates[name] = replace(rate, depth_slope=np.maximum(slope, 0.0))
    return sloped


def _rates(
    model: Model,
    before: Memory,
    contacts: Sequence[ContactSolution],
    interval: Interval,
    values: Sequence[Array],
    passed: float,
) -> Values:
    """Return the rates of the states, where they lie, and the depth rates in the contact."""
    # A load that jumps at the beginning is recognised by the middle.
    middle = interval.at(0.5).time
    if model.contact.loads.before(middle) != model.contact.loads.before(interval.end_time):
        contacts = with_loads(model, contacts, interval, passed)
    now = before.with_values(iter(values))
    found = rates_at_each(model, contacts, now, interval.at(passed))
    total: Values = [np.zeros_like(value) for value in values]
    for position, rates in enumerate(found):
        share = model.cycle[position].share
        laws = (
            model.cycle.maps[name].gather(rates.wear[name].state_rates[key], position)
            for name, of_law in before.laws.items()
            for key in of_law
        )
        effects = (laid(model, key, rates.between[key], position) for key in before.between)
        pairs = zip(total, (*laws, *effects), strict=True)
        total = [value + share * rate for value, rate in pairs]
    total += [rate.depth_rate for rates in found for rate in rates.wear.values()]
    if model.laws.friction_by_point:
        total.append(np.array(friction_of(model, found)))
    return total


def with_loads(
    model: Model, contacts: Sequence[ContactSolution], interval: Interval, passed: float
) -> list[ContactSolution]:
    """Return contacts whose pressures carry the load after a part of the interval."""
    half, whole = map(model.contact.loads.before, (interval.at(0.5).time, interval.end_time))
    load = interval.load_factor * (whole + 2 * (1 - passed) * (half - whole))
    found = []
    for contact in contacts:
        share = load / (float(np.sum(contact.pressure)) * model.grid.cell_area)
        found.append(replace(contact, pressure=readonly(share * contact.pressure)))
    return found


def kept_in(model: Model, memory: Memory) -> list[Kept]:
    """Return the properties of `Memory.values` for the integrator."""
    kept = []
    for name, of_law in memory.laws.items():
        if of_law:
            law = model.laws.wear[name]
            fields = {each.name: each for each in law.state_fields}
            kept += [_kept(fields[key], law, place(model, name)) for key in of_law]
    for effect, state in (model.laws.between[key] for key in memory.between):
        where = f"all of {state.name}" if state.uniform else place(model, effect.carrier)
        kept.append(_kept(state, effect, where))
    return kept


def _kept(field: Field, owner: object, place: str) -> Kept:
    least = -np.inf if field.at_least is None else field.at_least
    most = np.inf if field.at_most is None else field.at_most
    return Kept(field.name, f"{owner}", least, most, field.breaks, place)
