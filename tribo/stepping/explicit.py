"""Forward Euler with a fixed time step, equation 3 of the paper, and the limit of its stability."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np

from tribo.core.contact import ContactSolution
from tribo.core.errors import CaseError
from tribo.core.fields import WearRate
from tribo.core.findings import Finding, unstable
from tribo.core.state import State
from tribo.core.units import Quantity
from tribo.evolution.course import Course, course, in_stripes
from tribo.evolution.friction import with_friction_work
from tribo.evolution.interval import Moment, interval_from
from tribo.evolution.rates import CycleRates, wear_rates
from tribo.evolution.states import remembered
from tribo.model.events import Solved, Worn
from tribo.stepping.contacts import counted, solve_cycle, undeformed
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
    allow_unstable: bool = False
    """Whether steps may exceed the stability limit, at your own risk."""

    @property
    def may_oscillate(self) -> bool:
        """Whether the case allows steps beyond the stability limit."""
        return self.allow_unstable

    def check(self, model: Model, state: State) -> Finding | None:
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
        if increment is None:
            return None
        return self._instability(model, state, interval_from(state, increment, self.time_step).end)

    def next_time(self, state: State, until: float) -> float:
        """Return the time a step on, or `until` (s) if that is sooner."""
        time = state.time + self.time_step
        return until if until - time < 1e-6 * self.time_step else time

    def slide(self, model: Model, state: State, target: float, until: float) -> State:
        """Return the state at `target` (m); see `Scheme.slide`.

        `CaseError` if the step exceeds the stability limit and the case does not allow it.
        """
        increment = target - state.distance
        moment = interval_from(state, increment, until).end
        state = rated(model, state, moment)
        if not (self.allow_unstable and state.has_finding("stability")):
            finding = self._instability(model, state, moment)
            if finding is not None:
                state = state.from_here(finding)
        return self.step(model, state, increment, until)

    def step(self, model: Model, state: State, increment: float, time: float) -> State:
        """Return the state after one forward Euler step; see `Scheme.step`."""
        interval, memory = interval_from(state, increment, time), remembered(model, state)
        if memory.values:
            slid = course(model, memory, state.contacts, interval)
        else:
            slid = Course(rated(model, state, interval.end).rates, memory)
        depths = worn_depths(model, slid.rates, increment)
        model.tell(Worn(state.contacts, interval, memory, slid.plan, ahead=True))
        after = worn_by(model, state, slid, depths, interval)
        loads = model.loads(after).before(time)
        contacts = solve_cycle(
            model, undeformed(model, after), loads, _extrapolated(state), after.bodies
        )
        model.tell(Solved(contacts))
        after = accepted(model, counted(after, contacts), contacts, loads)
        return with_friction_work(model, state, after, state.contacts, slid)

    def _instability(self, model: Model, state: State, moment: Moment) -> Finding | None:
        """Return a warning of a step beyond the limit; `CaseError` where the case allows none."""
        limit = largest_stable_increment(model, state, moment)
        if limit is None:
            if self.allow_unstable:
                return None
            raise CaseError(
                f"contact.type = {model.case.contact.type!r} does not state its smallest "
                "compliance, so the stability of explicit steps cannot be checked; set "
                "stepping.allow_unstable = true to run without the check",
                PLACE,
            )
        increment, dt = moment.distance - state.distance, moment.time - state.time
        if increment < limit:
            return None
        finding = unstable(dt, increment, limit)
        if self.allow_unstable:
            return finding
        raise CaseError(
            f"{finding.words} (or use stepping.type = 'implicit', or set "
            "stepping.allow_unstable = true)",
            PLACE,
        )


def rated(model: Model, state: State, moment: Moment) -> State:
    """Return `state` with the rates of its contact, computed unless it has them."""
    if state.rates:
        return state
    return replace(state, rates=wear_rates(model, state.contacts, remembered(model, state), moment))


def largest_stable_increment(model: Model, state: State, moment: Moment) -> float | None:
    """Return the increment below which forward Euler is stable, in m.

    Δs λ < 2, with λ bounded from above by the largest derivative of the wear
    rate (local, plus the derivative of a swept body times the part of the track
    in contact) over the smallest compliance. The derivative is the larger of the
    law's and a difference, which includes fields that follow the pressure.
    None where the contact solver does not state its smallest compliance;
    infinity where nothing wears.
    """
    smallest = model.contact.solver.smallest_compliance(model.contact.system)
    if smallest is None:
        return None
    rates = _steepened(model, state, rated(model, state, moment).rates, moment)
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


def _steepened(model: Model, state: State, rates: CycleRates, moment: Moment) -> CycleRates:
    """Return `rates` with the total derivative where laws follow the fields of effects."""
    shared = model.laws.slips_locally or model.laws.shares_load
    following = [name for name, law in model.laws.wear.items() if shared or law.requires]
    if not model.laws.effects or not following:
        return rates
    nudged, stripes = in_stripes(state.contacts)
    others = wear_rates(model, nudged, remembered(model, state), moment)
    steeper = [dict(at) for at in rates]
    for at, other, stripe in zip(steeper, others, stripes, strict=True):
        for name in following:
            change = other[name].depth_rate - at[name].depth_rate
            slope = np.divide(change, stripe, out=np.zeros_like(change), where=stripe != 0)
            at[name] = replace(at[name], depth_slope=np.maximum(at[name].depth_slope, slope))
    return steeper


def _extrapolated(state: State) -> Sequence[ContactSolution]:
    """Return the contacts after another change as large as in the last step."""
    if not state.previous:
        return state.contacts
    return [
        replace(contact, pressure=np.maximum(2 * contact.pressure - before, 0.0))
        for contact, before in zip(state.contacts, state.previous, strict=True)
    ]
