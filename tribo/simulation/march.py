"""The loop over steps: from one accepted state to the next."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from tribo.component import Component, components
from tribo.core.errors import OutOfWindow, PluginError
from tribo.core.findings import Finding, chattering, ended
from tribo.core.measures import half_widths
from tribo.core.state import Snapshot, State
from tribo.evolution.local_fields import effect_fields
from tribo.guards.guard import Guard
from tribo.model.model import Model
from tribo.simulation.beginning import first_state
from tribo.simulation.doubt import doubting
from tribo.simulation.measure import measure
from tribo.simulation.validity import (
    check_stroke,
    coarse_cycle,
    few_cells,
    hold_wear,
    limitation,
    of_case,
    peak_at_the_edge,
)
from tribo.stepping.invariants import chatters, hold
from tribo.stepping.step import distance_until, start_sliding

DEPTH_ACCURACY = 1e-6
MOST_CUTS = 40


@dataclass(frozen=True)
class Accepted:
    """A state of the run, whether it is to be saved, and whether it is the last."""

    state: State
    save: bool
    last: bool


def begin(model: Model) -> State:
    """Return the state at t = 0.

    `CaseError` if the contact does not fit window and stroke, or a fixed time step is unstable.
    """
    with doubting(model.case):
        state = hold(model, None, first_state(model))
        check_stroke(model, state)
        model.case.stepping.check(model, state)
    if model.chosen is not None:
        state = state.with_findings(model.chosen)
    if _depth(model, state) >= _limit(model):
        state = _stopped(model, state)
    # The mean over a time in which no stage of the motion ends.
    soon = 0.5 * _stops(model)[0]
    speed = (distance_until(model, state, soon) or 0.0) / soon
    return _with_findings(model, replace(state, saves=1, speed=speed))


def _stops(model: Model) -> list[float]:
    """Return the times (s) that steps end at: saves, and where the load or the speed jumps."""
    edges = (*model.contact.loads.edges, *model.motion.edges())
    return sorted(model.saves | {time for time in edges if 0 < time < model.end_time})


def march(model: Model, state: State) -> Iterator[Accepted]:
    """Yield the accepted states after `state`, to the end of the run.

    `NumericalError` if the contact reaches the edge of the window, a body wears more than it can,
    or a step cannot be carried out.
    """
    limit = _limit(model)
    if _depth(model, state) >= limit:
        return
    with doubting(model.case):
        # Which stops are left follows from the time alone, so a resumed run sees the same.
        for until in _stops(model):
            while state.time < until:
                state = _advanced(model, state, until, limit)
                worn_out = _depth(model, state) >= limit
                last = worn_out or state.time >= model.end_time or state.has_finding("stop")
                if last:
                    state = _stopped(model, _concluded(model, state))
                save = last or (state.time >= until and until in model.saves)
                if save:
                    state = replace(state, saves=state.saves + 1)
                yield Accepted(state, save, last)
                if last:
                    return


def _advanced(model: Model, state: State, until: float, limit: float) -> State:
    """Return the next state that holds, the wear depth up to its limit."""
    try:
        after = model.case.stepping.advance(model, state, until)
        if _depth(model, after) > limit:
            after = _up_to_depth(model, state, after, limit)
    except PluginError as error:
        error.args = (f"{error}, at {state.distance:.6g} m ({state.time:.6g} s)",)
        raise
    after = hold(model, state, after)
    _check_window(model, after)
    return _told_by_models(model, _with_findings(model, hold_wear(model, after)))


def _up_to_depth(model: Model, state: State, after: State, limit: float) -> State:
    """Return the state after the part of a step that just wears to the depth `limit`, in m."""
    state = start_sliding(model, state)
    low, high = 0.0, after.distance - state.distance
    depth_low, depth_high = _depth(model, state), _depth(model, after)
    slow = False
    for _ in range(MOST_CUTS):
        if depth_high - limit <= DEPTH_ACCURACY * limit:
            break
        # Aim just above the limit, so that the end approaches it from the side that stops.
        part = (limit * (1 + 0.5 * DEPTH_ACCURACY) - depth_low) / (depth_high - depth_low)
        # Where the rate jumps, as between layers, a line may lead nowhere; halves do not.
        width = high - low
        trial = low + (0.5 if slow else part) * width
        time = model.motion.time_at(state.distance + trial)
        cut = model.case.stepping.step(model, state, trial, time)
        depth = _depth(model, cut)
        if depth >= limit:
            kept = tuple(f for f in after.findings if (f.distance or 0.0) <= cut.distance)
            high, depth_high, after = trial, depth, replace(cut, findings=kept)
        else:
            low, depth_low = trial, depth
        slow = high - low > 0.5 * width
    return after


def _limit(model: Model) -> float:
    stop = model.case.stop.depth
    return np.inf if stop is None else stop


def _stopped(model: Model, state: State) -> State:
    """Say whether the depth at which a run is to end has ended it."""
    limit, depth = _limit(model), _depth(model, state)
    if limit == np.inf or (depth >= limit and state.time >= model.end_time):
        return state
    return state.with_findings(ended(state.time, depth, limit))


def _depth(model: Model, state: State) -> float:
    names = model.case.stop.whose(state.bodies)
    return max(float(np.max(state.bodies[name].wear)) for name in names)


def _check_window(model: Model, state: State) -> None:
    reaching = [each for each in state.contacts if model.leaves_window(each)]
    if not reaching:
        return
    width, breadth = half_widths(reaching[0], model.grid)
    raise OutOfWindow(
        f"at {state.time:.6g} s ({state.distance:.6g} m) the contact, "
        f"{2e3 * width:.3g} × {2e3 * breadth:.3g} mm, reached the edge of the window of "
        f"{1e3 * model.grid.size[0]:.4g} × {1e3 * model.grid.size[1]:.4g} mm; make grid.size "
        "larger (and grid.cells with it)"
    )


def _with_findings(model: Model, state: State) -> State:
    """Return the state with the findings that are due and were not given before."""
    if not state.has_finding("averaging") and (finding := limitation(model, state)):
        state = state.from_here(finding)
    if state.steps == 0:
        few = few_cells(model, state.contact)
        state = state.with_findings(*of_case(model), *([few] if few else []))
    if chatters(state) and not state.has_finding("chattering"):
        state = state.from_here(chattering(state.invariants.chattering))
    return state


def _told_by_models(model: Model, state: State) -> State:
    """Return the state with what the components of the case have to say of it, each kind once."""
    snapshot = None
    for place, component in components(model.case):
        if type(component).findings is Component.findings:
            continue
        if snapshot is None:
            snapshot = Snapshot(state, measure(model, state), effect_fields(model, state))
        guard = Guard(component)
        for answer in tuple(guard.ask(component.findings, snapshot)):
            finding = guard.typed(answer, Finding, "a finding")
            finding = finding if finding.place else replace(finding, place=place)
            if (finding.kind, finding.place) not in {(f.kind, f.place) for f in state.findings}:
                state = state.from_here(finding)
    return state


def _concluded(model: Model, state: State) -> State:
    """Say what the averaging has come to by the end, in place of what it began with."""
    if finding := coarse_cycle(model, state):
        state = state.with_findings(finding)
    if not state.has_finding("chattering") and (finding := peak_at_the_edge(state)):
        state = state.from_here(finding)
    finding = limitation(model, state)
    return state.without_findings("averaging").from_here(finding) if finding else state
