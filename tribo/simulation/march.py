"""The loop over steps: from one accepted state to the next."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from tribo.config.stepping import Explicit, Implicit
from tribo.core.errors import CaseError, NumericalError, PluginError
from tribo.core.measures import Invariants, half_widths, reaches_border
from tribo.core.state import State
from tribo.simulation.answers import BadValues
from tribo.simulation.averaging import check_stroke, limitation
from tribo.simulation.calling import named
from tribo.simulation.control import SHRINK, first_increment, fitted, next_factor, step_error
from tribo.simulation.doubt import doubting
from tribo.simulation.invariants import chattering_words, chatters, hold
from tribo.simulation.model import Model
from tribo.simulation.motion import path_at, time_at
from tribo.simulation.rates import Moment
from tribo.simulation.repeated import check_repeatable
from tribo.simulation.step import (
    StepRejected,
    explicit_step,
    first_contact,
    implicit_step,
    largest_stable_increment,
    rated,
    start_sliding,
)
from tribo.simulation.validity import short_of_a_lap

FEW_CELLS = 8
MAX_REJECTIONS = 40
# Of the path until the next stop: a shorter step would drown in rounding.
SMALLEST = 1e-12
MOST_STEPS = 1e8
DEPTH_ACCURACY = 1e-6
STABILITY = "stability"
AVERAGING = "averaging"


@dataclass(frozen=True)
class Accepted:
    """A state of the run, whether it is to be saved, and whether it is the last."""

    state: State
    save: bool
    last: bool


def begin(model: Model) -> State:
    """Return the state at t = 0.

    Raises
    ------
    CaseError
        If the contact does not fit the window or is too long for the stroke, or
        a fixed time step is not stable or would never come to an end.
    NumericalError
        If the contact cannot be solved.
    """
    with doubting(model.case):
        state = hold(model, None, first_contact(model))
        check_stroke(model, state)
        if isinstance(model.stepping, Explicit):
            _check_time_step(model, model.stepping, state)
    speed = path_at(model.kinematics, model.end_time) / model.end_time
    return _noticed(model, replace(state, saves=1, speed=speed))


def march(model: Model, state: State) -> Iterator[Accepted]:
    """Yield the accepted states after `state`, to the end of the run.

    Raises
    ------
    NumericalError
        If the contact reaches the edge of the window, or a step cannot be
        carried out; the last state yielded stands.
    CaseError
        If a time step exceeds the stability limit.
    """
    limit = np.inf if model.stop.depth is None else model.stop.depth
    if _depth(model, state) >= limit:
        return
    # Which stops are left follows from the time alone, so a resumed run sees the same.
    stops = [t for t in model.case.output.save_times if 0 < t < model.end_time]
    for stop in [*stops, model.end_time]:
        while state.time < stop:
            with doubting(model.case):
                state = hold(model, state, _step_towards(model, state, stop))
                _check_window(model, state)
            state = _noticed(model, state)
            worn_out = _depth(model, state) >= limit
            last = worn_out or state.time >= model.end_time
            if last:
                state = _concluded(model, state)
            if worn_out and state.time < model.end_time:
                text = (
                    f"stop: ended at {state.time:.6g} s, where the wear depth reached "
                    f"{1e6 * limit:.4g} µm"
                )
                state = replace(state, notices=(*state.notices, text))
            save = last or state.time >= stop
            if save:
                state = replace(state, saves=state.saves + 1)
            yield Accepted(state, save, last)
            if last:
                return


def _step_towards(model: Model, state: State, stop: float) -> State:
    config = model.stepping
    time = stop if isinstance(config, Implicit) else _next_time(config, state, stop)
    if _rests(model, state, time):
        return replace(state, time=time, steps=state.steps + 1, invariants=Invariants())
    state = start_sliding(model, state)
    if isinstance(config, Explicit):
        return _explicit(model, config, state, time)
    return _implicit(model, config, state, stop)


def _rests(model: Model, state: State, time: float) -> bool:
    """Whether the motion rests until a later time, but for rounding."""
    # A path that has turned back by then has gone on before.
    return all(
        abs(path_at(model.kinematics, t) - state.distance) <= SMALLEST * state.distance
        for t in (time, 0.5 * (state.time + time))
    )


def _next_time(config: Explicit, state: State, stop: float) -> float:
    time = state.time + config.time_step
    return stop if stop - time < 1e-6 * config.time_step else time


def _explicit(model: Model, config: Explicit, state: State, time: float) -> State:
    increment = _path_until(model, state, time) - state.distance
    moment = Moment(time, state.distance + increment, increment / (time - state.time))
    state = _held_stable(model, config, rated(model, state, moment), moment)
    return _stop_at_depth(model, state, explicit_step, increment, time)


def _implicit(model: Model, config: Implicit, state: State, stop: float) -> State:
    target = _path_until(model, state, stop)
    remaining = target - state.distance
    natural = state.increment or first_increment(model, state, remaining)
    rejected = 0
    while True:
        increment = fitted(natural, remaining, target, config.settle)
        landing = increment == remaining
        time = stop if landing else _time_at(model, state, state.distance + increment, stop)
        try:
            taken = implicit_step(model, state, increment, time, config=config)
            errors = step_error(config, state, taken)
            factor = next_factor(*errors)
            if max(errors) <= 1:
                break
        except (StepRejected, BadValues) as error:
            check_repeatable(model, state)
            factor = SHRINK
            if rejected == MAX_REJECTIONS or factor * increment < SMALLEST * target:
                if isinstance(error, BadValues):
                    raise
                raise NumericalError(str(error)) from error
        rejected += 1
        if rejected > MAX_REJECTIONS or factor * increment < SMALLEST * target:
            check_repeatable(model, state)
            raise NumericalError(
                f"steps down to {increment:.3g} m at {state.distance:.6g} m still miss their "
                f"tolerances (depth error {errors[0]:.3g}, pressure change {errors[1]:.3g}, volume "
                f"error {errors[2]:.3g} times what is allowed); raise stepping.depth_tolerance or "
                "pressure_tolerance"
            )
        natural = factor * increment
    # A step cut short to meet a save says little about the next: keep the longer of the two.
    proposal = max(factor * increment, natural if increment < natural else 0.0)
    after = replace(taken.state, increment=proposal, rejected_steps=state.rejected_steps + rejected)
    if model.stop.depth is not None and _depth(model, after) > model.stop.depth:

        def step(model: Model, state: State, increment: float, time: float) -> State:
            return implicit_step(model, state, increment, time, config=config).state

        return _stop_at_depth(model, state, step, increment, time)
    return after


def _path_until(model: Model, state: State, time: float) -> float:
    """Return the path at a later time, which must have grown."""
    distance = path_at(model.kinematics, time)
    if not state.distance < distance < np.inf:
        raise PluginError(
            f"{named(model.kinematics)} does not slide on: {state.distance:g} m "
            f"at {state.time:g} s, {distance:g} m at {time:g} s"
        )
    return distance


def _time_at(model: Model, state: State, distance: float, stop: float) -> float:
    """Return the time at which the path is reached, between now and the next stop."""
    time = time_at(model.kinematics, distance)
    if not state.time < time <= stop * (1 + 1e-9):
        raise PluginError(
            f"{named(model.kinematics)} puts {distance:g} m at {time:g} s, which "
            f"does not lie between {state.time:g} s and {stop:g} s"
        )
    return time


def _stop_at_depth(
    model: Model,
    state: State,
    step: Callable[[Model, State, float, float], State],
    increment: float,
    time: float,
) -> State:
    """Take a step, or the part of it that just wears to the depth where the run ends."""
    after = step(model, state, increment, time)
    if model.stop.depth is None:
        return after
    limit = model.stop.depth
    low, high = 0.0, increment
    depth_low, depth_high = _depth(model, state), _depth(model, after)
    if depth_high <= limit:
        return after
    for _ in range(MAX_REJECTIONS):
        if depth_high - limit <= DEPTH_ACCURACY * limit:
            break
        # Aim just above the limit, so that the end approaches it from the side that stops.
        part = (limit * (1 + 0.5 * DEPTH_ACCURACY) - depth_low) / (depth_high - depth_low)
        trial = low + part * (high - low)
        state_at = step(model, state, trial, time_at(model.kinematics, state.distance + trial))
        depth = _depth(model, state_at)
        if depth >= limit:
            high, depth_high, after = trial, depth, state_at
        else:
            low, depth_low = trial, depth
    return after


def _depth(model: Model, state: State) -> float:
    names = list(state.bodies) if model.stop.body is None else [model.stop.body]
    return max(float(np.max(state.bodies[name].wear)) for name in names)


def _check_time_step(model: Model, config: Explicit, state: State) -> None:
    steps = model.end_time / config.time_step
    if steps > MOST_STEPS:
        raise CaseError(
            f"{config.time_step:g} s would take {steps:.2g} steps; {MOST_STEPS:.0e} are allowed: "
            "make it longer, or use stepping.type = 'implicit'",
            "stepping.time_step",
        )
    if _rests(model, state, config.time_step):
        return
    increment = _path_until(model, state, config.time_step)
    moment = Moment(config.time_step, increment, increment / config.time_step)
    _held_stable(model, config, state, moment)


def _held_stable(model: Model, config: Explicit, state: State, moment: Moment) -> State:
    """Return `state`, told if the step from it to `moment` is beyond the stability limit.

    Raises
    ------
    CaseError
        If it is, and the case does not allow it.
    """
    if config.allow_unstable and _is_told(state, STABILITY):
        return state
    limit = largest_stable_increment(model, state, moment)
    if limit is None:
        if config.allow_unstable:
            return state
        raise CaseError(
            f"contact.type = {model.contact.type!r} does not state its smallest "
            "compliance, so the stability of explicit steps cannot be checked; set "
            "stepping.allow_unstable = true to go on without",
            "stepping.time_step",
        )
    increment = moment.distance - state.distance
    if increment < limit:
        return state
    dt = moment.time - state.time
    words = (
        f"{dt:.4g} s slides {increment:.4g} m, beyond the stability limit of {limit:.4g} m; "
        f"the largest stable step is {dt * limit / increment:.4g} s"
    )
    if not config.allow_unstable:
        raise CaseError(
            f"{words} (or use stepping.type = 'implicit', or set stepping.allow_unstable = true)",
            "stepping.time_step",
        )
    return _told(state, STABILITY, f"{words}. Sooner or later the pressure may chatter")


def _check_window(model: Model, state: State) -> None:
    if model.may_reach_edge or not reaches_border(state.contact.pressure):
        return
    width, breadth = half_widths(state.contact, model.grid)
    raise NumericalError(
        f"at {state.time:.6g} s ({state.distance:.6g} m) the contact, "
        f"{2e3 * width:.3g} × {2e3 * breadth:.3g} mm, reached the edge of the window of "
        f"{1e3 * model.grid.size[0]:.4g} × {1e3 * model.grid.size[1]:.4g} mm; make grid.size "
        "larger (and grid.cells with it)"
    )


def _noticed(model: Model, state: State) -> State:
    """Add to the state the warnings that are due and were not given before."""
    width, breadth = half_widths(state.contact, model.grid)
    if not _is_told(state, AVERAGING):
        words = limitation(model, state)
        if words is not None:
            state = _told(state, AVERAGING, words)
    dx, dy = model.grid.spacing
    cells = min(2 * width / dx, 2 * breadth / dy)
    lap = short_of_a_lap(model) if state.steps == 0 else None
    if lap is not None:
        state = replace(state, notices=(*state.notices, f"lap: {lap}"))
    if state.steps == 0 and cells < FEW_CELLS:
        text = (
            f"resolution: the first contact is only {cells:.0f} cells wide; its pressure is "
            f"inaccurate until it has grown: aim for {FEW_CELLS} or more (grid.cells)"
        )
        state = replace(state, notices=(*state.notices, text))
    if chatters(state):
        state = _told(state, "chattering", chattering_words(state))
    return state


def _concluded(model: Model, state: State) -> State:
    """Add what the averaging has come to by the end, unless that was just said."""
    words = limitation(model, state)
    if words is None or any(notice.endswith(words) for notice in state.notices):
        return state
    return replace(state, notices=(*state.notices, _sentence(state, AVERAGING, words)))


def _told(state: State, kind: str, words: str) -> State:
    """Return `state` with a warning of what begins here, unless it has one of that kind."""
    if _is_told(state, kind):
        return state
    return replace(state, notices=(*state.notices, _sentence(state, kind, words)))


def _sentence(state: State, kind: str, words: str) -> str:
    return f"{kind}: at {state.time:.6g} s ({state.distance:.6g} m) {words}"


def _is_told(state: State, kind: str) -> bool:
    return any(notice.startswith(f"{kind}:") for notice in state.notices)
