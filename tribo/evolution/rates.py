"""From a solved contact to the wear rate of each body."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial, reduce
from itertools import zip_longest
from typing import TYPE_CHECKING

import numpy as np

from tribo.contact.projection import over
from tribo.core.arrays import Array, readonly, union
from tribo.core.box import around_region
from tribo.core.contact import ContactSolution
from tribo.core.errors import CaseError
from tribo.core.fields import (
    FRICTION_COEFFICIENT,
    LOAD_SHARE,
    LOCAL_SLIP,
    LocalConditions,
    WearRate,
)
from tribo.evolution.interval import Moment
from tribo.evolution.local_fields import conditions, local_fields
from tribo.evolution.states import Memory, under
from tribo.motion.cycle import Speeds

if TYPE_CHECKING:
    from tribo.guards.parts import GuardedEffect
    from tribo.model.model import Model

# Cells around the contact where laws are asked too: what a step may newly touch.
MARGIN = 8
ENDS = [0, -1]
"""The rows of the window that lie furthest from the contact."""
SLIGHT = 1e-6
"""Part of the largest rate of a state below which a rate is taken as 0."""
FINE = 0.1
"""Relative spacing of the speeds at which laws are evaluated, where points have their own."""

CycleRates = Sequence[Mapping[str, WearRate]]
"""Rates in the contact frame, by position of a cycle and body."""


@dataclass(frozen=True)
class Rates:
    """Rates per metre in the contact frame, at a position: of wear by body, of effects by key.

    At rest they are per second. Where friction differs from point to point, `friction` is the
    energy dissipated per area and metre of the motion, in Pa.
    """

    wear: Mapping[str, WearRate]
    between: Mapping[str, Array]
    friction: Array | None = None


@dataclass(frozen=True)
class Asked:
    """A contact at a position of the cycle, the states in the window there, and the moment."""

    position: int
    contact: ContactSolution
    memory: Memory
    moment: Moment


def wear_rates(
    model: Model, contacts: Sequence[ContactSolution], memory: Memory, moment: Moment
) -> CycleRates:
    """Return the rate of every body that wears, in the contact frame, at each position."""
    return tuple(rates.wear for rates in rates_at_each(model, contacts, memory, moment, MARGIN))


def rates_at_each(
    model: Model,
    contacts: Sequence[ContactSolution],
    memory: Memory,
    moment: Moment,
    margin: int = 0,
) -> list[Rates]:
    """Return the rates of bodies and effects at each position, as `wear_rates`.

    At rest they are per second; the position of a rest is unknown, so each position has its share.
    Slopes of laws hold in the contact and up to `margin` cells around it.
    """
    return rates_of_cycles(model, [(contacts, memory, moment)], margin)[0]


def rates_of_cycles(
    model: Model,
    cycles: Sequence[tuple[Sequence[ContactSolution], Memory, Moment]],
    margin: int = 0,
) -> list[list[Rates]]:
    """Return the rates of several cycles, all sliding or at rest; laws are evaluated once."""
    asked = [
        Asked(position, contact, under(model, memory, position), moment)
        for contacts, memory, moment in cycles
        for position, contact in enumerate(contacts)
    ]
    slides = asked[0].moment.speed > 0
    found = _sliding(model, asked, margin) if slides else _at_rest(model, asked)
    count = len(model.cycle)
    return [found[at : at + count] for at in range(0, len(found), count)]


def _at_rest(model: Model, asked: Sequence[Asked]) -> list[Rates]:
    still = readonly(np.zeros(model.grid.cells))
    wear = {
        name: WearRate(still, still, dict.fromkeys(law.initial_state, still))
        for name, law in model.laws.wear.items()
    }
    if any(place.rest > 0 for place in model.cycle):
        # The rests of a cycle are in its mean rates.
        return [Rates(wear, dict.fromkeys(asked[0].memory.between, still))] * len(asked)
    return [Rates(wear, _resting(model, each)) for each in asked]


def friction_of(model: Model, rates: Sequence[Rates]) -> float:
    """Return the mean energy that friction dissipates over a cycle per metre, in N."""
    force = sum(
        place.share * float(np.sum(each.friction))
        for place, each in zip(model.cycle, rates, strict=True)
        if each.friction is not None
    )
    return force * model.grid.cell_area


def _resting(model: Model, asked: Asked) -> dict[str, Array]:
    """Return the rates of effects per second at rest at a position, in the window."""
    still = dict.fromkeys(model.case.bodies, readonly(np.zeros(model.grid.cells)))
    return _changes(model, asked, _fields(model, asked), still)


def _fields(model: Model, asked: Asked) -> dict[str, dict[str, Array]]:
    pressure, memory = asked.contact.pressure, asked.memory
    return local_fields(model, pressure, asked.moment, asked.position, memory)


def _sliding(model: Model, asked: Sequence[Asked], margin: int) -> list[Rates]:
    """Return the rates at each position per metre of the motion, with changes at rest there.

    They are the mean over the speeds of the position. Laws are evaluated at all positions at once.
    """
    places = [model.cycle[each.position] for each in asked]
    speeds = [
        _by_reach(place.speeds or [(each.moment.speed, 1.0)], place.reach)
        for each, place in zip(asked, places, strict=True)
    ]
    parts = []
    for of_positions in zip_longest(*speeds):
        # A position with fewer speeds than others is evaluated again, with weight 0.
        now = [
            one or (last[0], 0.0, 0.0) for one, (*_, last) in zip(of_positions, speeds, strict=True)
        ]
        at_speeds = [
            replace(each, moment=replace(each.moment, speed=speed))
            for each, (speed, _, _) in zip(asked, now, strict=True)
        ]
        of_laws = _rates_of(model, at_speeds, margin)
        parts.append([(*of[1:], rates) for of, rates in zip(now, of_laws, strict=True)])
    found = []
    for at, (each, place) in enumerate(zip(asked, places, strict=True)):
        rates = _mean_rates([of[at] for of in parts])
        if place.rest > 0 and rates.between:
            changes = _resting(model, replace(each, moment=replace(each.moment, speed=0.0)))
            between = {key: rate + place.rest * changes[key] for key, rate in rates.between.items()}
            rates = replace(rates, between=between)
        found.append(rates)
    return found


def _mean_rates(parts: Sequence[tuple[float | Array, float | Array, Rates]]) -> Rates:
    """Return the mean of rates, each with weights of rates per metre and of changes in time."""
    (part, _, first), *others = parts
    if not others and np.ndim(part) == 0 and part == 1:
        return first
    weights = [of for of, _, _ in parts]

    def mean(*values: Array) -> Array:
        return _sum(zip(weights, values, strict=True))

    wear = {name: _mapped(mean, *(each.wear[name] for _, _, each in parts)) for name in first.wear}
    between = {
        key: _sum((time, each.between[key]) for _, time, each in parts) for key in first.between
    }
    if first.friction is None:
        return Rates(wear, between)
    friction = _sum((of, each.friction) for of, _, each in parts if each.friction is not None)
    return Rates(wear, between, friction)


def _by_reach(
    speeds: Speeds, reach: Array | None
) -> list[tuple[float, float | Array, float | Array]]:
    """Return speeds, each with the weights of rates per metre and of changes in time there.

    A point that slides further, by its part of `reach`, (nx, ny), is faster by as much, and takes
    the same time. Rates between speeds are interpolated linearly.
    """
    if reach is None:
        return [(speed, share, share) for speed, share in speeds]
    least, most = float(np.min(reach)), float(np.max(reach))
    nodes = np.linspace(least, most, 2 + int((most - least) / FINE)) if most > least else [least]
    hats = [np.interp(reach, nodes, hat) for hat in np.eye(len(nodes))]
    return [
        (speed * float(node), share * reach * hat, share * float(node) * hat)
        for speed, share in speeds
        for node, hat in zip(nodes, hats, strict=True)
    ]


def _mapped(function: Callable[..., Array], *rates: WearRate) -> WearRate:
    """Return a function of the depths, slopes and changes of states of some rates."""
    return WearRate(
        function(*[rate.depth_rate for rate in rates]),
        function(*[rate.depth_slope for rate in rates]),
        {key: function(*[rate.state_rates[key] for rate in rates]) for key in rates[0].state_rates},
    )


def _sum(parts: Iterable[tuple[float | Array, Array]]) -> Array:
    return reduce(np.add, (share * values for share, values in parts))


def _rates_of(model: Model, asked: Sequence[Asked], margin: int) -> list[Rates]:
    """Return the rates of laws and effects for the window, at each position at its own speed."""
    fields = [_fields(model, each) for each in asked]
    wear = _laws(model, asked, fields, margin)
    found = []
    still = readonly(np.zeros(model.grid.cells))
    for at, (each, around) in enumerate(zip(asked, fields, strict=True)):
        rates, friction = {name: rate.at(at) for name, rate in wear.items()}, None
        if model.laws.friction_by_point and FRICTION_COEFFICIENT.name in around:
            names = {FRICTION_COEFFICIENT.name, LOCAL_SLIP.name} & around.keys()
            alike = (next(iter(around[name].values())) for name in sorted(names))
            friction = reduce(np.multiply, alike, each.contact.pressure)
        between: Mapping[str, Array] = {}
        if each.memory.between:
            depths = {
                name: readonly(rates[name].depth_rate) if name in rates else still
                for name in model.case.bodies
            }
            slid = each.moment.speed if each.moment.speed > 0 else np.inf
            changes = _changes(model, each, around, depths)
            between = {key: change / slid for key, change in changes.items()}
        found.append(Rates(rates, between, friction))
    return found


def _laws(
    model: Model,
    asked: Sequence[Asked],
    fields: Sequence[Mapping[str, Mapping[str, Array]]],
    margin: int,
) -> dict[str, WearRate]:
    """Return the rate of each law at all positions at once, arrays (positions, nx, ny)."""
    # A law is pointwise, and leaves everything as it is where nothing touches.
    touched = reduce(union, (each.contact.extent for each in asked))
    near = around_region(touched, model.grid.cells, margin)
    cells = (len(asked), *near.shape)

    def stacked(arrays: Iterable[Array]) -> Array:
        window = model.grid.cells
        whole = (
            (values if values.shape == window else np.broadcast_to(values, window))[near.slices]
            for values in arrays
        )
        return readonly(np.concatenate([*whole]).reshape(cells))

    pressure = stacked(each.contact.pressure for each in asked)
    speed = readonly(over(np.array([each.moment.speed for each in asked])))
    rates = {}
    for name, law in model.laws.wear.items():
        solid = slip = None
        if LOCAL_SLIP.name in fields[0]:
            slip = stacked(of[LOCAL_SLIP.name][name] for of in fields)
        if LOAD_SHARE.name in fields[0]:
            solid = readonly(1.0 - stacked(of[LOAD_SHARE.name][name] for of in fields))
        rate = law.rate(
            LocalConditions(
                pressure=pressure if solid is None else readonly(solid * pressure),
                speed=speed,
                material=law.material,
                fields={field: stacked(of[field][name] for of in fields) for field in law.requires},
                state={
                    field: stacked(each.memory.laws[name][field] for each in asked)
                    for field in asked[0].memory.laws.get(name, {})
                },
            )
        )
        if solid is not None:
            rate = replace(rate, depth_slope=solid * rate.depth_slope)
        if slip is not None:
            rate = _mapped(partial(np.multiply, slip), rate)
        rates[name] = rate if near.is_window else _mapped(near.embed, rate)
    return rates


def _changes(
    model: Model,
    asked: Asked,
    fields: Mapping[str, Mapping[str, Array]],
    depths: Mapping[str, Array],
) -> dict[str, Array]:
    """Return the change of each state of an effect per second, in the window.

    On a moving body the rest of the track changes as points under no pressure.
    """
    changes: dict[str, Array] = {}
    contact, memory, moment = asked.contact, asked.memory, asked.moment

    def of_effect(
        effect: GuardedEffect, pressure: Array, depths: Mapping[str, Array]
    ) -> dict[str, Array]:
        around = fields
        if pressure is not contact.pressure:
            around = local_fields(model, pressure, moment, asked.position, memory)
        given = conditions(model, pressure, moment, around, effect, memory)
        return effect.state_rates(replace(given, wear_rates=depths))

    for effect in model.laws.effects:
        if not effect.initial_state:
            continue
        rates = of_effect(effect, contact.pressure, depths)
        if effect.carrier is not None and effect.carrier in model.cycle.swept:
            bare = rates
            if np.any(contact.pressure[ENDS]):
                free = {name: _without_ends(depth) for name, depth in depths.items()}
                bare = of_effect(effect, _without_ends(contact.pressure), free)
            rates = _with_rest_of_track(model, effect, rates, bare)
        changes |= {effect.key_of(field): rates[field.name] for field in effect.state_fields}
    return changes


def _without_ends(values: Array) -> Array:
    """Return values in the window that are 0 in its first and its last row."""
    inner = values.copy()
    inner[ENDS] = 0.0
    return readonly(inner)


def _with_rest_of_track(
    model: Model, effect: GuardedEffect, rates: dict[str, Array], bare: dict[str, Array]
) -> dict[str, Array]:
    """Return rates of an effect in the window, with the share of the track beyond it.

    The ends of the window in `bare`, under no pressure, stand for the rest of the track. Where the
    body has rows of its own each has its state, so that the rates beyond are not known.
    """
    assert effect.carrier is not None
    exposure, cells = model.cycle.maps[effect.carrier], model.grid.cells
    completed = dict(rates)
    for field in effect.state_fields:
        if field.uniform:
            continue
        rate, untouched = rates[field.name], np.mean(bare[field.name][ENDS], axis=0)
        if exposure.averaged:
            covered = exposure.average(np.ones(cells))
            completed[field.name] = rate + (1 / covered - 1) * untouched
        elif exposure.rows > cells[0] and np.any(np.abs(untouched) > SLIGHT * np.max(np.abs(rate))):
            raise CaseError(
                f"{field.name!r} of {effect} changes on {effect.carrier!r} under no pressure, and "
                "its change beyond the window is unknown at positions of a cycle; set "
                'kinematics.positions = "average" if the motion has it, or let the state lie in '
                "the contact",
                "effects",
            )
    return completed
