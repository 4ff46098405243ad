"""The parts of a step, as pure functions of model and state."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.errors import PluginError
from tribo.core.findings import Finding, layer_worn_through
from tribo.core.measures import Invariants
from tribo.core.rounding import ROUND_OFF
from tribo.core.state import BodyState, State
from tribo.evolution.course import Course, course
from tribo.evolution.interval import Interval, interval_from
from tribo.evolution.measure import load_factor
from tribo.evolution.rates import CycleRates
from tribo.evolution.states import own, remembered
from tribo.evolution.yielding import caps
from tribo.stepping.contacts import solved_anew
from tribo.stepping.invariants import wear_balance
from tribo.stepping.plastic_groove import settled, yielded, yields

if TYPE_CHECKING:
    from tribo.model.model import Model

SMALLEST = 1e-12
"""Shortest step over the distance until the next stop: rounding dominates shorter steps."""


def distance_until(model: Model, state: State, time: float) -> float | None:
    """Return the sliding distance at a later time (s), in m; None if the motion rests until then.

    The distance must have grown, but for rounding.
    """
    distance = model.motion.distance_at(time)
    # A distance that has turned back by then has grown before.
    if abs(distance - state.distance) <= SMALLEST * state.distance:
        halfway = model.motion.distance_at(0.5 * (state.time + time))
        if abs(halfway - state.distance) <= SMALLEST * state.distance:
            return None
    if not state.distance < distance < np.inf:
        raise PluginError(
            f"{model.motion} has a distance that does not grow: {state.distance:g} m "
            f"at {state.time:g} s, {distance:g} m at {time:g} s"
        )
    return distance


def time_at(model: Model, state: State, distance: float, until: float) -> float:
    """Return the time at which the run has slid `distance` (m), between now and `until` (s)."""
    time = model.motion.time_at(distance)
    if not state.time < time <= until * (1 + ROUND_OFF):
        raise PluginError(
            f"{model.motion} puts {distance:g} m at {time:g} s, which "
            f"does not lie between {state.time:g} s and {until:g} s"
        )
    return time


def rested(model: Model, state: State, time: float) -> State:
    """Return `state` after a rest until a later time (s), under the load at that time."""
    memory = remembered(model, state)
    if memory.between:
        rest = interval_from(state, 0.0, time)
        after = course(model, memory, state.contacts, rest)
        model.listener.worn(state.contacts, rest, memory, after.plan, ahead=True)
        state = replace(state, between=after.memory.between)
    load = model.loads(state).before(time)
    anew = load != model.loads(state).before(state.time) or any(
        body is None for body, _ in model.laws.filling
    )
    state = replace(state, speed=0.0)
    if anew:
        state = _under(model, state, load)
    state = replace(state, time=time, steps=state.steps + 1, invariants=Invariants())
    return reloaded(model, state)


def start_sliding(model: Model, state: State) -> State:
    """Return `state` as a step begins: under the load after a jump, its indentation drawn out.

    At s = 0 plastic displacement is local; once a body slides, its groove is
    the envelope along the track, and the contact in it is solved again. A contact with points worn
    down to a softer layer is solved again as well.
    """
    known = model.loads(state)
    load = known.after(state.time)
    if load != known.before(state.time):
        # How far a step may go under the load before says little.
        state = replace(_under(model, state, load), increment=0.0)
    elif _too_soft(model, state):
        state = _under(model, state, load)
    return settled(model, state, load) if state.distance == 0 else state


def _too_soft(model: Model, state: State) -> bool:
    """Whether the pressure at a point exceeds the hardness of the layer it is worn down to."""
    return any(
        cap is not None and np.any(contact.pressure > cap * (1 + ROUND_OFF))
        for contact, cap in zip(state.contacts, caps(model, state.bodies), strict=True)
    )


def worn_depths(model: Model, rates: CycleRates, increment: float) -> dict[str, Array]:
    """Return the depth that each body loses over `increment` (m), on its own surface, in m."""
    worn: dict[str, Array] = {}
    for position, of_bodies in enumerate(rates):
        slid = increment * model.cycle[position].share
        for name, rate in of_bodies.items():
            exposure = model.cycle.maps[name]
            worn[name] = exposure.gather(rate.depth_rate, position, slid, worn.get(name))
    return worn


def worn_by(
    model: Model,
    before: State,
    slid: Course,
    depths: Mapping[str, Array],
    interval: Interval,
) -> State:
    """Return the state after an interval, its contacts yet to be solved.

    `depths` has the depth that each body loses over it, on its own surface, in m.
    """
    bodies = dict(before.bodies)
    for name, depth in depths.items():
        bodies[name] = replace(
            bodies[name], wear=bodies[name].wear + depth, law=own(slid.memory.laws[name])
        )
    mean = model.loads(before).mean(before.time, interval.end_time)
    end = interval.end
    return replace(
        before,
        time=end.time,
        distance=end.distance,
        load_distance=before.load_distance + mean * (end.distance - before.distance),
        speed=end.speed,
        bodies=bodies,
        between=slid.memory.between,
        rates=(),
        steps=before.steps + 1,
        findings=(*before.findings, *_worn_through(model, before, bodies, interval, slid)),
        invariants=wear_balance(model, depths, slid.rates, interval.slides, before),
    )


def _worn_through(
    model: Model,
    before: State,
    after: Mapping[str, BodyState],
    interval: Interval,
    slid: Course,
) -> Iterator[Finding]:
    """Yield a finding for each layer that a body's deepest point passes in a step, when it does."""
    for name, law in model.laws.wear.items():
        was, worn = float(np.max(before.bodies[name].wear)), float(np.max(after[name].wear))
        for layer, bottom in enumerate(law.bottoms, start=1):
            reached = bottom * (1 - ROUND_OFF)
            if was < reached <= worn:
                share = slid.passed.get(name, {}).get(law.breaks.index(bottom), 1.0)
                distance = interval.at(share).distance
                passed = layer_worn_through(name, layer, bottom)
                yield passed.at(model.motion.time_at(distance), distance)


def accepted(
    model: Model,
    after: State,
    contacts: Sequence[ContactSolution],
    load: float,
    *,
    exact: bool = True,
) -> State:
    """Return `after`, the worn bodies, in contact, with yielding done and the load of effects.

    The contacts carry `load`, in N; they are solved again where the load at the end differs, or
    where they do not belong to the bodies `exact`ly.
    """
    after = replace(after, contacts=tuple(contacts))
    at_end = model.loads(after).before(after.time)
    kept = exact and load == at_end
    state = _at_rest(model, after, load) if kept else _under(model, after, at_end)
    return reloaded(model, state)


def reloaded(model: Model, state: State) -> State:
    """Return `state` under its load with effects, which is held over the next step."""
    factor = load_factor(model, state)
    if factor == state.load_factor:
        return state
    state = replace(state, load_factor=factor)
    return _under(model, state, model.loads(state).before(state.time))


def _under(model: Model, state: State, load: float) -> State:
    """Return `state` with its contacts solved under another load (N), without wear."""
    return _at_rest(model, solved_anew(model, state, load), load)


def _at_rest(model: Model, state: State, load: float) -> State:
    """Return `state` after its contacts have yielded under `load`."""
    if not yields(state.contacts):
        return state
    # Before it slides the load stands in the middle alone.
    places = range(len(state.contacts)) if state.distance > 0 else [len(state.contacts) // 2]
    state = replace(state, bodies=yielded(model, state.bodies, state.contacts, places))
    return settled(model, state, load) if state.distance > 0 else state
