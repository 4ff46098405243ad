"""Forward Euler with a fixed time step, equation 3 of the paper, and the limit of its stability."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np

from tribo.core.contact import ContactSolution
from tribo.core.errors import CaseError
from tribo.core.fields import WearRate
from tribo.core.state import State
from tribo.core.units import Quantity
from tribo.evolution.course import Course, course
from tribo.evolution.friction import with_friction_work
from tribo.evolution.interval import Moment, interval_from
from tribo.evolution.rates import wear_rates
from tribo.evolution.states import remembered
from tribo.stepping.contacts import counted, extrapolated, solve_cycle, undeformed
from tribo.stepping.linear_wear import wear_compliance
from tribo.stepping.scheme import Scheme
from tribo.stepping.step import (
    accepted,
    distance_until,
    worn_by,
    worn_depths,
)

if TYPE_CHECKING:
    from tribo.model.model import Model

MOST_STEPS = 1e8
"""At a millisecond a step, they take 28 hours."""
PLACE = "stepping.time_step"


class Explicit(Scheme):
    """Forward Euler with a fixed time step, limited by stability.

    Equation 3 of Andersson, Almqvist & Larsson (2010).

    Examples
    --------
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml")
    >>> case.with_values({"stepping": tribo.Explicit(time_step="20 s")}).run()
    Traceback (most recent call last):
    tribo.core.errors.CaseError: ...the largest stable step is 2.234 s...
    """

    type: Literal["explicit"] = "explicit"
    time_step: Annotated[float, Quantity("s", above=0)]
    """Length of a step."""

    def check(self, model: Model, state: State) -> None:
        """Check the first step; see `Scheme.check`.

        `CaseError` if steps are too short for the run to end, or the first step is unstable.
        """
        steps = model.end_time / self.time_step
        if steps > MOST_STEPS:
            raise CaseError(
                f"{self.time_step:g} s would take {steps:.2g} steps; {MOST_STEPS:.0e} are allowed: "
                "make it longer, or use stepping.type = 'implicit'",
                PLACE,
            )
        increment = distance_until(model, state, self.time_step)
        if increment is not None:
            end = interval_from(state, increment, self.time_step).end
            _check_stability(model, rated(model, state, end), end)

    def next_time(self, state: State, until: float) -> float:
        """Return the time a step on, or `until` (s) if that is sooner."""
        time = state.time + self.time_step
        return until if until - time < 1e-6 * self.time_step else time

    def slide(self, model: Model, state: State, target: float, until: float) -> State:
        """Return the state at `target` (m); see `Scheme.slide`.

        `CaseError` if the step exceeds the stability limit.
        """
        increment = target - state.distance
        moment = interval_from(state, increment, until).end
        state = rated(model, state, moment)
        _check_stability(model, state, moment)
        return self.step(model, state, increment, until)

    def step(self, model: Model, state: State, increment: float, time: float) -> State:
        """Return the state after one forward Euler step; see `Scheme.step`."""
        interval, memory = interval_from(state, increment, time), remembered(model, state)
        if memory.values:
            slid = course(model, memory, state.contacts, interval)
        else:
            slid = Course(state.contacts, rated(model, state, interval.end).rates, memory)
        depths = worn_depths(model, slid.rates, increment)
        model.listener.worn(state.contacts, interval, memory, slid.plan, ahead=True)
        after = worn_by(model, state, slid, depths, interval)
        load = model.loads(after).before(time)
        contacts = solve_cycle(
            model, undeformed(model, after), load, extrapolated(state), after.bodies
        )
        model.listener.solved(contacts)
        after = accepted(model, counted(after, contacts), contacts, load)
        return with_friction_work(model, state, after, slid)


def _check_stability(model: Model, state: State, moment: Moment) -> None:
    """Raise `CaseError` if the step up to a moment exceeds the stability limit."""
    limit = largest_stable_increment(model, state, moment)
    increment, dt = moment.distance - state.distance, moment.time - state.time
    if increment >= limit:
        raise CaseError(
            f"{dt:.4g} s slides {increment:.4g} m, beyond the stability limit of {limit:.4g} m; "
            f"the largest stable step is {dt * limit / increment:.4g} s (or use stepping.type = "
            "'implicit')",
            PLACE,
        )


def rated(model: Model, state: State, moment: Moment) -> State:
    """Return `state` with the rates of its contact, computed unless it has them."""
    if state.rates:
        return state
    return replace(state, rates=wear_rates(model, state.contacts, remembered(model, state), moment))


def largest_stable_increment(model: Model, state: State, moment: Moment) -> float:
    """Return the increment below which forward Euler is stable, in m.

    Δs λ < 2, with λ bounded from above by the largest derivative of the wear
    rate (local, plus the derivative of a swept body times the part of the track
    in contact) over the smallest compliance. Infinity where nothing wears.
    `CaseError` where the contact solver does not state its smallest compliance.
    """
    solver = model.contact.solver
    smallest = solver.smallest_compliance(model.contact.system)
    if smallest is None:
        raise CaseError(
            f"{solver} states no smallest compliance, so that no explicit step is known to be "
            "stable; use stepping.type = 'implicit'",
            "stepping.type",
        )
    rates = rated(model, state, moment).rates
    slope = max(map(partial(_steepest, model), rates, state.contacts))
    return 2 * smallest / slope if slope > 0 else np.inf


def _steepest(model: Model, rates: Mapping[str, WearRate], contact: ContactSolution) -> float:
    """Return the largest depth per metre that a pressure adds at a position, in 1/Pa."""
    near = contact.extent
    compliance = wear_compliance(model, rates, contact.pressure, 1.0)
    touching = contact.pressure[near] > 0
    # A point of a body that passes wears in steps of the positions.
    length = np.count_nonzero(touching, axis=0) * model.grid.spacing[0] + model.cycle.apart
    local = float(np.max(compliance.local[near], where=touching, initial=0.0))
    return local + float((compliance.swept[near[1]] * length).max())
