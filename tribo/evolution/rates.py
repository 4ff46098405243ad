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
    here = [under(model, memory, position) for position in range(len(contacts))]
    if moment.speed > 0:
        return _sliding(model, contacts, here, moment, margin)
    still = readonly(np.zeros(model.grid.cells))
    wear = {
        name: WearRate(still, still, dict.fromkeys(law.initial_state, still))
        for name, law in model.laws.wear.items()
    }
    if any(place.rest > 0 for place in model.cycle):
        # The rests of a cycle are in its mean rates.
        return [Rates(wear, dict.fromkeys(memory.between, still))] * len(contacts)
    return [
        Rates(wear, _resting(model, position, contact, here[position], moment))
        for position, contact in enumerate(contacts)
    ]


def friction_of(model: Model, rates: Sequence[Rates]) -> float:
    """Return the mean energy that friction dissipates over a cycle per metre, in N."""
    force = sum(
        place.share * float(np.sum(each.friction))
        for place, each in zip(model.cycle, rates, strict=True)
        if each.friction is not None
    )
    return force * model.grid.cell_area


def _resting(
    model: Model, position: int, contact: ContactSolution, memory: Memory, moment: Moment
) -> dict[str, Array]:
    """Return the rates of effects per second at rest at a position, in the window."""
    still = dict.fromkeys(model.case.bodies, readonly(np.zeros(model.grid.cells)))
    fields = local_fields(model, contact.pressure, moment, position, memory)
    return _changes(model, position, contact, moment, memory, fields, still)


def _sliding(
    model: Model,
    contacts: Sequence[ContactSolution],
    memories: Sequence[Memory],
    moment: Moment,
    margin: int,
) -> list[Rates]:
    """Return the rates at each position per metre of the motion, with changes at rest there.

    They are the mean over the speeds of the position. Laws are evaluated at all positions at once.
    """
    speeds = [
        _by_reach(place.speeds or [(moment.speed, 1.0)], place.reach) for place in model.cycle
    ]
    each = []
    for of_positions in zip_longest(*speeds):
        # A position with fewer speeds than others is evaluated again, with weight 0.
        asked = [
            one or (last[0], 0.0, 0.0) for one, (*_, last) in zip(of_positions, speeds, strict=True)
        ]
        moments = [replace(moment, speed=speed) for speed, _, _ in asked]
        each.append((asked, _rates_of(model, contacts, memories, moments, margin)))
    found = []
    for position, contact in enumerate(contacts):
        parts = [(*asked[position][1:], rates[position]) for asked, rates in each]
        rates, rest = _mean_rates(parts), model.cycle[position].rest
        if rest > 0 and rates.between:
            still = replace(moment, speed=0.0)
            changes = _resting(model, position, contact, memories[position], still)
            between = {key: rate + rest * changes[key] for key, rate in rates.between.items()}
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


def _rates_of(
    model: Model,
    contacts: Sequence[ContactSolution],
    memories: Sequence[Memory],
    moments: Sequence[Moment],
    margin: int,
) -> list[Rates]:
    """Return the rates of laws and effects for the window, at each position at its own speed."""
    fields = [
        local_fields(model, contact.pressure, moment, position, memory)
        for position, (contact, moment, memory) in enumerate(
            zip(contacts, moments, memories, strict=True)
        )
    ]
    wear = _laws(model, contacts, memories, moments, fields, margin)
    found = []
    still = readonly(np.zeros(model.grid.cells))
    for position, (contact, memory, moment) in enumerate(
        zip(contacts, memories, moments, strict=True)
    ):
        rates, friction = {name: rate.at(position) for name, rate in wear.items()}, None
        if model.laws.friction_by_point and FRICTION_COEFFICIENT.name in fields[position]:
            names = {FRICTION_COEFFICIENT.name, LOCAL_SLIP.name} & fields[position].keys()
            alike = (next(iter(fields[position][name].values())) for name in sorted(names))
            friction = reduce(np.multiply, alike, contact.pressure)
        between: Mapping[str, Array] = {}
        if memory.between:
            depths = {
                name: readonly(rates[name].depth_rate) if name in rates else still
                for name in model.case.bodies
            }
            slid = moment.speed if moment.speed > 0 else np.inf
            changes = _changes(model, position, contact, moment, memory, fields[position], depths)
            between = {key: change / slid for key, change in changes.items()}
        found.append(Rates(rates, between, friction))
    return found


def _laws(
    model: Model,
    contacts: Sequence[ContactSolution],
    memories: Sequence[Memory],
    moments: Sequence[Moment],
    fields: Sequence[Mapping[str, Mapping[str, Array]]],
    margin: int,
) -> dict[str, WearRate]:
    """Return the rate of each law at all positions at once, arrays (positions, nx, ny)."""
    # A law is pointwise, and leaves everything as it is where nothing touches.
    touched = reduce(union, (contact.extent for contact in contacts))
    near = around_region(touched, model.grid.cells, margin)
    cells = (len(contacts), *near.shape)

    def stacked(arrays: Iterable[Array]) -> Array:
        whole = (np.broadcast_to(values, model.grid.cells)[near.slices] for values in arrays)
        return readonly(np.concatenate([*whole]).reshape(cells))

    pressure = stacked(contact.pressure for contact in contacts)
    speed = readonly(over(np.array([moment.speed for moment in moments])))
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
                    field: stacked(of.laws[name][field] for of in memories)
                    for field in memories[0].laws.get(name, {})
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
    position: int,
    contact: ContactSolution,
    moment: Moment,
    memory: Memory,
    fields: Mapping[str, Mapping[str, Array]],
    depths: Mapping[str, Array],
) -> dict[str, Array]:
    """Return the change of each state of an effect per second, in the window.

    On a moving body the rest of the track changes as points under no pressure.
    """
    changes: dict[str, Array] = {}

    def of_effect(
        effect: GuardedEffect, pressure: Array, depths: Mapping[str, Array]
    ) -> dict[str, Array]:
        around = fields
        if pressure is not contact.pressure:
            around = local_fields(model, pressure, moment, position, memory)
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
