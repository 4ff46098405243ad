"""The loop over steps: from one accepted state to the next."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import scipy

from tribo.core.errors import OutOfWindow, PluginError
from tribo.core.findings import ended
from tribo.core.measures import half_widths
from tribo.core.state import State
from tribo.model.model import Model
from tribo.simulation.beginning import first_state
from tribo.simulation.validity import (
    check_stroke,
    doubting,
    few_cells,
    hold_wear,
    limitation,
    tribo_findings,
)
from tribo.simulation.watch import Watch
from tribo.stepping.invariants import hold
from tribo.stepping.step import SMALLEST, distance_until, start_sliding

DEPTH_ACCURACY = 1e-6
"""Relative excess of the depth at which a run ends: tables print it to four digits."""


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
        state = hold(None, first_state(model))
        check_stroke(model, state)
        model.case.stepping.check(model, state)
    if _depth(model, state) >= _limit(model):
        state = _stopped(model, state)
    # The mean over a time in which no stage of the motion ends.
    soon = 0.5 * _stops(model)[0]
    speed = (distance_until(model, state, soon) or 0.0) / soon
    state = _averaged(model, replace(state, saves=1, speed=speed))
    return state.with_findings(*tribo_findings(model), *few_cells(state.contact))


def _stops(model: Model) -> list[float]:
    """Return the times (s) at which steps end: saves, and jumps of the load or the speed."""
    edges = (*model.contact.loads.edges, *model.motion.edges())
    return sorted(model.saves | {time for time in edges if 0 < time < model.end_time})


def march(model: Model, state: State, watch: Watch | None = None) -> Iterator[Accepted]:
    """Yield the accepted states after `state`, to the end of the run.

    A model of the case, or what is in `watch`, may end it sooner.

    `NumericalError` if the contact reaches the edge of the window, a body wears more than it can,
    or a step cannot be carried out.
    """
    limit, watch = _limit(model), watch or Watch(model)
    if _depth(model, state) >= limit:
        return
    with doubting(model.case):
        # Which stops are left follows from the time alone, so a resumed run sees the same.
        for until in _stops(model):
            while state.time < until:
                state = watch.told(_advanced(model, state, until, limit))
                worn_out = _depth(model, state) >= limit
                stopped = any(each.kind == "stop" for each in state.findings)
                last = worn_out or stopped or state.time >= model.end_time
                if last:
                    state = _stopped(model, _concluded(model, state))
                save = last or (state.time >= until and until in model.saves)
                if save:
                    state = replace(state, saves=state.saves + 1)
                yield Accepted(state, save, last)
                if last:
                    return


def _advanced(model: Model, state: State, until: float, limit: float) -> State:
    """Return the next state that holds, up to the limit of the depth."""
    try:
        after = model.case.stepping.advance(model, state, until)
        if _depth(model, after) > limit:
            after = _up_to_depth(model, state, after, limit)
    except PluginError as error:
        what, then, rule = str(error).partition("; ")
        error.args = (f"{what} at {state.distance:.6g} m ({state.time:.6g} s){then}{rule}",)
        raise
    after = hold(state, after)
    _check_window(model, after)
    return _averaged(model, hold_wear(model, after))


def _up_to_depth(model: Model, state: State, after: State, limit: float) -> State:
    """Return the state after the part of a step that just wears to the depth `limit`, in m."""
    length = after.distance - state.distance
    cuts = {0.0: start_sliding(model, state), length: after}

    def excess(increment: float) -> float:
        if increment not in cuts:
            cuts[increment] = _cut(model, cuts[0.0], after, increment)
        over = _depth(model, cuts[increment]) / limit - 1
        # Aim just above the limit, so that the end approaches it from the side that stops.
        return 0.0 if 0 <= over <= DEPTH_ACCURACY else over - 0.5 * DEPTH_ACCURACY

    scipy.optimize.brentq(excess, 0.0, length, xtol=SMALLEST * length)
    reached = (cut for cut in cuts.values() if _depth(model, cut) >= limit)
    return min(reached, key=lambda cut: cut.distance)


def _cut(model: Model, state: State, after: State, increment: float) -> State:
    """Return the state after the first part of a step, of a length in m, that led to `after`."""
    time = model.motion.time_at(state.distance + increment)
    cut = model.case.stepping.step(model, state, increment, time)
    kept = tuple(f for f in after.findings if (f.distance or 0.0) <= cut.distance)
    return replace(cut, findings=kept)


def _limit(model: Model) -> float:
    stop = model.case.stop.depth
    return np.inf if stop is None else stop


def _stopped(model: Model, state: State) -> State:
    """Add the finding on whether stop.depth has ended the run."""
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


def _averaged(model: Model, state: State) -> State:
    """Return the state with the finding on its average, if one is due and was not given before."""
    finding = limitation(model, half_widths(state.contact, model.grid)[0])
    return state.from_here(finding) if finding else state


def _concluded(model: Model, state: State) -> State:
    """Add findings on the end; the one on averaging replaces that at the beginning."""
    for few in few_cells(state.contact):
        state = state.from_here(few)
    return _averaged(model, state.without_findings("averaging"))
