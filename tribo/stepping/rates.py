"""From a solved contact to the wear rate of each body."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.box import around_region, whole
from tribo.core.contact import ContactSolution
from tribo.core.fields import (
    FRICTION_COEFFICIENT,
    ContactConditions,
    LocalConditions,
    WearRate,
)
from tribo.core.state import State
from tribo.motion.cycle import Speeds

if TYPE_CHECKING:
    from tribo.simulation.model import Model

# Cells around the contact where laws are asked too: what a step may newly touch.
MARGIN = 8
FINE = 0.1
"""Relative speed between two at which laws are asked, where rows have their own."""

LawStates = Mapping[str, Mapping[str, Array]]
CycleRates = Sequence[Mapping[str, WearRate]]
"""Rates in the contact frame, by position of a cycle and body."""


@dataclass(frozen=True)
class Moment:
    """When rates are asked for: end of the step (s, m) and its mean speed (m/s).

    The speed is told where the motion does not state those of its cycle.
    """

    time: float
    distance: float
    speed: float


def law_states(state: State) -> LawStates:
    """Return the state fields of each body's law."""
    return {name: body.law for name, body in state.bodies.items()}


def wear_rates(
    model: Model, contacts: Sequence[ContactSolution], law_states: LawStates, moment: Moment
) -> CycleRates:
    """Return the rate of every body that wears, in the contact frame, at each position.

    Parameters
    ----------
    model : Model
        The composed case.
    contacts : sequence of ContactSolution
        The contact at each position of a cycle.
    law_states : Mapping[str, Mapping[str, ndarray]]
        State fields of each body's law, on the body's surface.
    moment : Moment
        When.
    """
    return tuple(
        _rates_at(model, position, contact, law_states, moment)
        for position, contact in enumerate(contacts)
    )


def _rates_at(
    model: Model, position: int, contact: ContactSolution, law_states: LawStates, moment: Moment
) -> dict[str, WearRate]:
    """Return the rates at a position per metre of the motion: the mean over its speeds."""
    under = {
        name: {field: model.under(name, values, position) for field, values in of.items()}
        for name, of in law_states.items()
        if of
    }
    place = model.cycle[position]
    rates: dict[str, WearRate] = {}
    speeds = place.speeds or [(moment.speed, 1.0)]
    weighed = speeds if place.reach is None else _by_row(speeds, place.reach)
    for speed, share in weighed:
        at_speed = _rates_of(model, position, contact, under, replace(moment, speed=speed))
        for name, rate in at_speed.items():
            part = rate if np.ndim(share) == 0 and share == 1 else _times(share, rate)
            rates[name] = _sum(rates[name], part) if name in rates else part
    return rates


def _by_row(speeds: Speeds, reach: Array) -> list[tuple[float, Array]]:
    """Return speeds, each with what the rate there counts for in each row, shape (ny,).

    A row of which the points slide further is faster by as much; in between speeds rates are taken
    to go in straight lines.
    """
    least, most = float(np.min(reach)), float(np.max(reach))
    nodes = np.linspace(least, most, 2 + int((most - least) / FINE)) if most > least else [least]
    return [
        (speed * float(node), share * reach * np.interp(reach, nodes, np.eye(len(nodes))[at]))
        for speed, share in speeds
        for at, node in enumerate(nodes)
    ]


def _times(share: float | Array, rate: WearRate) -> WearRate:
    state = {name: share * values for name, values in rate.state_rates.items()}
    return WearRate(share * rate.depth_rate, share * rate.depth_slope, state)


def _sum(one: WearRate, other: WearRate) -> WearRate:
    state = {name: values + other.state_rates[name] for name, values in one.state_rates.items()}
    return WearRate(one.depth_rate + other.depth_rate, one.depth_slope + other.depth_slope, state)


def _rates_of(
    model: Model, position: int, contact: ContactSolution, law_states: LawStates, moment: Moment
) -> dict[str, WearRate]:
    """Return the rate of each law for what lies in the window, at the speed of `moment`."""
    pressure = readonly(contact.pressure)
    fields = local_fields(model, pressure, moment, position)
    near = around_region(contact.extent, model.grid.cells, MARGIN)
    rates = {}
    for name, law in model.laws.items():
        # A law is pointwise, so it need not be asked where nothing touches; its state
        # fields, though, may change there.
        box = whole(model.grid.cells) if law.state_fields else near
        part = box.slices
        rate = law.rate(
            LocalConditions(
                pressure=pressure[part],
                speed=moment.speed,
                material=law.material,
                fields={field: fields[field][name][part] for field in law.requires},
                state={
                    field: np.broadcast_to(values, pressure.shape)[part]
                    for field, values in law_states.get(name, {}).items()
                },
            )
        )
        if not box.is_window:
            rate = WearRate(box.embed(rate.depth_rate), box.embed(rate.depth_slope))
        rates[name] = rate
    return rates


def effect_fields(model: Model, state: State) -> dict[str, dict[str, Array]]:
    """Return what the effects make of `state`, by field and body, shape (nx, ny)."""
    speeds = model.cycle[len(model.cycle) // 2].speeds
    # Of an average's speeds none is that of the pressure shown.
    here = speeds if len(model.cycle) > 1 else None
    speed = state.speed if here is None else 1 / sum(share / v for v, share in here)
    middle = len(model.cycle) // 2
    moment = Moment(state.time, state.distance, speed)
    fields = local_fields(model, state.contact.pressure, moment, middle)
    return {field.name: fields[field.name] for e in model.effects for field in e.provides}


def local_fields(
    model: Model, pressure: Array, moment: Moment, position: int
) -> dict[str, dict[str, Array]]:
    """Return what the effects and the case provide at a position, by field and body, (nx, ny)."""
    fields = model.places(position)
    friction = model.friction_coefficient
    if friction is not None:
        uniform = readonly(np.full(pressure.shape, friction))
        fields[FRICTION_COEFFICIENT.name] = dict.fromkeys(model.bodies, uniform)
    for effect in model.effects:
        conditions = ContactConditions(
            grid=model.grid,
            pressure=readonly(pressure),
            speed=moment.speed,
            time=moment.time,
            distance=moment.distance,
            friction_coefficient=friction,
            materials=dict(model.system.materials),
            swept=model.swept,
            fields={name: dict(of_bodies) for name, of_bodies in fields.items()},
        )
        fields |= effect.fields(conditions)
    return fields
