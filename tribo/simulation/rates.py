"""From a solved contact to the wear rate of each body."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.box import around_region, whole
from tribo.core.contact import ContactSolution
from tribo.core.errors import PluginError
from tribo.core.fields import FRICTION_COEFFICIENT, ContactConditions, LocalConditions, WearRate
from tribo.core.state import State
from tribo.simulation.answers import BadValues, spread
from tribo.simulation.calling import calling, named
from tribo.simulation.model import Model
from tribo.simulation.motion import cycle_speeds
from tribo.wear.law import WearLaw

Law = WearLaw


@dataclass(frozen=True)
class Moment:
    """When rates are asked for: end of the step (s, m) and its mean speed (m/s).

    The speed is told where the motion does not state those of its cycle.
    """

    time: float
    distance: float
    speed: float

    @property
    def words(self) -> str:
        """The moment as the end of a message."""
        return f", at {self.distance:.6g} m ({self.time:.6g} s)"


# Cells around the contact where laws are asked too: what a step may newly touch.
MARGIN = 8

LawStates = Mapping[str, Mapping[str, Array]]


def law_states(state: State) -> LawStates:
    """Return the state fields of each body's law."""
    return {name: body.law for name, body in state.bodies.items()}


def wear_rates(
    model: Model, contact: ContactSolution, law_states: LawStates, moment: Moment
) -> dict[str, WearRate]:
    """Return the rate of every body that wears, in the contact frame: the mean over a cycle.

    Parameters
    ----------
    model : Model
        The composed case.
    contact : ContactSolution
        The pressure.
    law_states : Mapping[str, Mapping[str, ndarray]]
        State fields of each body's law, on the body's surface.
    moment : Moment
        When.

    Raises
    ------
    BadValues
        If an effect or a law answers with values that are not finite, or a law
        with a depth that is negative.
    PluginError
        If one answers with anything else but arrays of the right shape, or a
        law with a depth that is not 0 where the pressure is.
    """
    speeds = cycle_speeds(model.kinematics)
    if speeds is None:
        return _rates_at(model, contact, law_states, moment)
    rates: dict[str, WearRate] = {}
    for speed, share in speeds:
        at_speed = _rates_at(model, contact, law_states, replace(moment, speed=speed))
        for name, rate in at_speed.items():
            part = _times(share, rate)
            rates[name] = _sum(rates[name], part) if name in rates else part
    return rates


def _times(share: float, rate: WearRate) -> WearRate:
    state = {name: share * values for name, values in rate.state_rates.items()}
    return WearRate(share * rate.depth_rate, share * rate.depth_slope, state)


def _sum(one: WearRate, other: WearRate) -> WearRate:
    state = {name: values + other.state_rates[name] for name, values in one.state_rates.items()}
    return WearRate(one.depth_rate + other.depth_rate, one.depth_slope + other.depth_slope, state)


def _rates_at(
    model: Model, contact: ContactSolution, law_states: LawStates, moment: Moment
) -> dict[str, WearRate]:
    """Return what `wear_rates` does, at the speed of `moment`."""
    pressure = readonly(contact.pressure)
    fields = local_fields(model, pressure, moment)
    everywhere = whole(model.grid.cells)
    near = around_region(contact.extent, model.grid.cells, MARGIN)
    rates = {}
    for who, body in model.bodies.items():
        if body.wear is None:
            continue
        # A law is pointwise, so it need not be asked where nothing touches; its state
        # fields, though, may change there.
        box = everywhere if body.wear.state_fields else near
        local = LocalConditions(
            pressure=pressure[box.slices],
            speed=moment.speed,
            material=body.material,
            fields={name: fields[name][who][box.slices] for name in body.wear.requires},
            state={
                name: readonly(np.broadcast_to(values, pressure.shape)[box.slices])
                for name, values in law_states[who].items()
            },
        )
        with calling(body.wear, who):
            answer = body.wear.rate(local)
        rate = _checked(named(body.wear, who), body.wear, answer, local.pressure, moment)
        if not box.is_window:
            rate = WearRate(box.embed(rate.depth_rate), box.embed(rate.depth_slope))
        rates[who] = rate
    return rates


def effect_fields(model: Model, state: State) -> dict[str, dict[str, Array]]:
    """Return what the effects make of `state`, by field and body, shape (nx, ny).

    Raises
    ------
    PluginError
        As `wear_rates` does.
    """
    moment = Moment(state.time, state.distance, state.speed)
    fields = local_fields(model, readonly(state.contact.pressure), moment)
    return {field.name: fields[field.name] for e in model.effects for field in e.provides}


def local_fields(model: Model, pressure: Array, moment: Moment) -> dict[str, dict[str, Array]]:
    """Return what the effects and the case provide, by field and body; as `wear_rates` raises."""
    shape = pressure.shape
    fields: dict[str, dict[str, Array]] = {}
    if model.friction_coefficient is not None:
        uniform = readonly(np.full(shape, model.friction_coefficient))
        fields[FRICTION_COEFFICIENT.name] = dict.fromkeys(model.bodies, uniform)
    for effect in model.effects:
        conditions = ContactConditions(
            grid=model.grid,
            pressure=pressure,
            speed=moment.speed,
            time=moment.time,
            distance=moment.distance,
            friction_coefficient=model.friction_coefficient,
            materials={name: body.material for name, body in model.bodies.items()},
            swept=frozenset(name for name in model.bodies if model.is_swept(name)),
            fields={name: dict(of_bodies) for name, of_bodies in fields.items()},
        )
        with calling(effect):
            answer = effect.fields(conditions)
        who = named(effect)
        if not isinstance(answer, Mapping):
            raise PluginError(f"{who} gave a {type(answer).__name__}, not its fields")
        for field in effect.provides:
            fields[field.name] = {}
            for body in model.bodies:
                of_bodies = answer.get(field.name, {})
                values = of_bodies.get(body) if isinstance(of_bodies, Mapping) else None
                what = f"{field.name!r} for body {body!r}"
                if values is None:
                    raise PluginError(f"{who} gave no {what}")
                array, _, _ = spread(who, what, values, shape, moment.words)
                fields[field.name][body] = readonly(array)
    return fields


def _checked(who: object, law: Law, rate: object, pressure: Array, moment: Moment) -> WearRate:
    if not isinstance(rate, WearRate):
        raise PluginError(f"{who} gave a {type(rate).__name__} instead of a WearRate")
    when, shape = moment.words, pressure.shape
    depth, least, _ = spread(who, "a depth per metre", rate.depth_rate, shape, when)
    slope, flattest, _ = spread(who, "a derivative", rate.depth_slope, shape, when)
    if least < 0:
        raise BadValues(
            f"{who} gave a negative depth per metre ({least:.3g}){when}; wear only removes"
        )
    bare = np.count_nonzero((depth != 0) & (pressure == 0))
    if bare:
        raise PluginError(
            f"{who} gave a depth per metre that is not 0 in {bare} cells where the pressure is 0"
            f"{when}; what is not touched does not wear"
        )
    if not isinstance(rate.state_rates, Mapping):
        raise PluginError(f"{who} gave a {type(rate.state_rates).__name__} as rates of its state")
    state = {}
    for field in law.state_fields:
        if field.name not in rate.state_rates:
            raise PluginError(f"{who} gave no rate for its state field {field.name!r}")
        what = f"a rate of {field.name!r}"
        state[field.name], _, _ = spread(who, what, rate.state_rates[field.name], shape, when)
    return WearRate(depth, np.maximum(slope, 0.0) if flattest < 0 else slope, state)
