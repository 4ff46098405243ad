"""What bodies wear, and what laws and effects come to remember, under contacts that stay."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.contact import ContactSolution
from tribo.core.fields import WearRate
from tribo.stepping.contacts import in_stripes
from tribo.stepping.division import Division, integrated
from tribo.stepping.integrator import Limits, Rates, Values
from tribo.stepping.layers import in_layers
from tribo.stepping.memory import Memory, laid
from tribo.stepping.rates import CycleRates, Moment, wear_rates

if TYPE_CHECKING:
    from tribo.stepping.model import Model


COARSE = Division(((0.25, True), (0.75, True)), np.inf)
"""Where an increment has more parts than these, they do to find slopes."""


@dataclass(frozen=True)
class Course:
    """An increment under contacts that stay as they are.

    Parameters
    ----------
    rates : sequence of Mapping[str, WearRate]
        Mean rates over it, by position and body; no slopes where something is remembered.
    memory : Memory
        What is remembered at its end.
    plan : Division
        How the increment is divided for that to be accurate.
    begun : callable or None
        The course over the first metres of it; None where no body has layers.
    """

    rates: CycleRates
    memory: Memory
    plan: Division = field(default_factory=Division)
    begun: Callable[[float], Course] | None = None


def course(
    model: Model,
    before: Memory,
    contacts: Sequence[ContactSolution],
    increment: float,
    moment: Moment,
    plan: Division | None = None,
) -> Course:
    """Return what an increment (m; s of a rest) comes to, from what is remembered before it.

    `moment` is its end. It is divided as in `plan`, or finer. Without anything to remember, rates
    are those of `moment` throughout, but where a body wears through a layer. With it, the depths
    worn of bodies in layers are integrated as well.
    """
    layered = layered_bodies(model)
    taken = None

    def begun(first: float) -> Course:
        end = moment.back(increment - first) if before.values else moment
        parts = None if taken is None else taken.until(first / increment)
        return course(model, before, contacts, first, end, parts)

    if not before.values:
        shared, found = in_layers(model, before, contacts, increment, moment)
        wear = tuple(each.wear for each in found)
        return Course(wear, shared, begun=begun if layered else None)
    of_model = partial(_rates, model, before, layered, contacts, increment, moment)
    values, depths, taken = _followed(model, before, layered, of_model, increment, plan)
    each = iter(depths)
    mean = [
        {name: WearRate(np.maximum(next(each), 0.0) / increment) for name in model.laws.wear}
        for _ in contacts
    ]
    return Course(mean, before.with_values(iter(values)), taken, begun if layered else None)


def accumulated(
    model: Model,
    before: Memory,
    contacts: Sequence[ContactSolution],
    increment: float,
    moment: Moment,
    plan: Division,
    rate: Callable[[Memory, float], float],
) -> float:
    """Return what a rate per metre comes to over a course, as it follows what is remembered.

    The increment (m), and the `moment` at its end, are those of `course`, and `plan` is how it was
    divided. The rate is asked with what is remembered and how much of the increment has passed.
    """
    layered = layered_bodies(model)
    states = len(before.values) + len(layered)

    def rates(values: Sequence[Array], passed: float, step: float) -> Values:
        found = _rates(model, before, layered, contacts, increment, moment, values, passed, step)
        now = memory_with(before, layered, values)
        return [*found[:states], np.array(rate(now, passed))]

    _, (total,), _ = _followed(model, before, layered, rates, increment, Division(plan.parts))
    return float(total)


def sloped(
    model: Model,
    before: Memory,
    contacts: Sequence[ContactSolution],
    increment: float,
    moment: Moment,
    known: Course,
) -> CycleRates:
    """Return the mean rates of a course with their slopes in pressure, through all that follows it.

    Where nothing presses the slope is that of the law.
    """
    if not before.values:
        return known.rates
    nudged, stripes = in_stripes(contacts)
    layered = any(law.bottoms for law in model.laws.wear.values())
    # Slopes jump where points pass to the next layer: those over other parts mislead.
    if len(known.plan.parts) > len(COARSE.parts) and not layered:
        same, plan = course(model, before, contacts, increment, moment, COARSE), COARSE
    else:
        same, plan = known, replace(known.plan, accuracy=np.inf)
    other = course(model, before, nudged, increment, moment, plan)
    laws = wear_rates(model, contacts, known.memory, moment)
    sloped = [dict(rates) for rates in known.rates]
    for at, rates, higher, law, stripe in zip(
        same.rates, sloped, other.rates, laws, stripes, strict=True
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
    layered: Sequence[str],
    contacts: Sequence[ContactSolution],
    increment: float,
    end: Moment,
    values: Sequence[Array],
    passed: float,
    step: float,
) -> Values:
    """Return the rates of what is remembered, where it lies, and the depths in the contact.

    Those of the depths of bodies in layers, which follow what is remembered, are means over a step,
    and so are those of models that know them.
    """
    moment = end.back((1 - passed) * increment)
    if model.laws.tells_length:
        moment = replace(moment, over=step * increment)
    contacts = loaded(model, contacts, end.back(0.5 * increment).time, end.time, passed)
    now = memory_with(before, layered, values)
    _, found = in_layers(model, now, contacts, step * increment, moment)
    total: Values = [np.zeros_like(value) for value in values]
    for position, rates in enumerate(found):
        share = model.cycle[position].share
        laws = (
            model.cycle.maps[name].gather(rates.wear[name].state_rates[key], position)
            for name, of_law in before.laws.items()
            for key in of_law
        )
        effects = (laid(model, key, rates.between[key], position) for key in before.between)
        depths = (
            model.cycle.maps[name].gather(rates.wear[name].depth_rate, position) for name in layered
        )
        pairs = zip(total, (*laws, *effects, *depths), strict=True)
        total = [value + share * rate for value, rate in pairs]
    return total + [rate.depth_rate for rates in found for rate in rates.wear.values()]


def memory_with(before: Memory, layered: Sequence[str], values: Sequence[Array]) -> Memory:
    """Return what is remembered with other values, the depths of bodies in layers at the end."""
    each = iter(values)
    now = before.with_values(each)
    return replace(now, worn={**now.worn, **dict(zip(layered, each, strict=True))})


def layered_bodies(model: Model) -> list[str]:
    """Return the bodies in layers, whose depths go along with what is remembered."""
    return [name for name, law in model.laws.wear.items() if law.bottoms]


def _followed(
    model: Model,
    before: Memory,
    layered: Sequence[str],
    rates: Rates,
    increment: float,
    plan: Division | None,
) -> tuple[Values, Values, Division]:
    """Integrate, as `integrated`, rates of what is remembered and of the depths in layers."""
    return integrated(
        rates,
        [*before.values, *(before.worn[name] for name in layered)],
        increment,
        limits_of(model, before),
        plan,
        knows_means=model.laws.advances,
        layered=[
            model.laws.tells_length
            and model.laws.knows_mean(name)
            and model.laws.wear[name].steady_above
            for name in layered
        ],
    )


def loaded(
    model: Model,
    contacts: Sequence[ContactSolution],
    middle: float,
    end: float,
    passed: float,
) -> Sequence[ContactSolution]:
    """Return contacts with pressures in proportion to the load where a part has passed.

    Of an increment or a rest that has its `middle` and its `end` at these times, in s.
    """
    # A load that jumps as it begins is told apart in its middle.
    if model.contact.loads.before(middle) == model.contact.loads.before(end):
        return contacts
    return with_loads(model, contacts, middle, end, passed)


def with_loads(
    model: Model,
    contacts: Sequence[ContactSolution],
    middle: float,
    end: float,
    passed: float,
) -> list[ContactSolution]:
    """Return contacts with pressures that carry the load where a part has passed, as `loaded`."""
    halfway, last = model.contact.loads.before(middle), model.contact.loads.before(end)
    cell, found = model.grid.cell_area, []
    for contact, half, whole in zip(contacts, halfway, last, strict=True):
        load = whole + 2 * (1 - passed) * (half - whole)
        share = load / (float(np.sum(contact.pressure)) * cell)
        found.append(replace(contact, pressure=readonly(share * contact.pressure)))
    return found


def limits_of(model: Model, memory: Memory) -> list[Limits]:
    """Return the limits of `Memory.values`, and those of the depths of bodies in layers."""
    of_laws = [
        (field, f"{model.laws.wear[name]}")
        for name, of_law in memory.laws.items()
        for key in of_law
        for field in model.laws.wear[name].state_fields
        if field.name == key
    ]
    between = [
        (model.laws.between[key][1], f"{model.laws.between[key][0]}") for key in memory.between
    ]
    remembered = [
        Limits(
            -np.inf if field.at_least is None else field.at_least,
            np.inf if field.at_most is None else field.at_most,
            f"{field.name!r} of {who}",
        )
        for field, who in (*of_laws, *between)
    ]
    depths = [
        Limits(-np.inf, np.inf, f"the depth of {name!r}", relaxes=False)
        for name in layered_bodies(model)
    ]
    return [*remembered, *depths]
