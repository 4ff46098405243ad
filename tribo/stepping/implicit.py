"""Backward Euler, with increments chosen by error."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.errors import BadValues, NumericalError, PluginError
from tribo.core.state import State
from tribo.core.units import Quantity
from tribo.evolution.course import Course, course, sloped
from tribo.evolution.friction import with_friction_work
from tribo.evolution.interval import interval_from
from tribo.evolution.measure import loaded_mean
from tribo.evolution.rates import wear_rates
from tribo.evolution.states import filling, remembered
from tribo.stepping.contacts import counted, extrapolated, seen, solve_cycle, undeformed
from tribo.stepping.error_control import (
    FIRST,
    SHRINK,
    increment_factor,
    next_increment,
    step_errors,
)
from tribo.stepping.linear_wear import add_depths, linear_wear
from tribo.stepping.scheme import Scheme
from tribo.stepping.step import (
    SMALLEST,
    accepted,
    time_at,
    worn_by,
    worn_depths,
)

if TYPE_CHECKING:
    from tribo.model.model import Model

MAX_REJECTIONS = 40
"""In a row: shortened by a tenth each time, a hundredth of the step is left."""
LEFT_OVER = 0.02
"""Change of the gap that passes may leave, in pressure tolerances times the deformation."""


class StepRejected(NumericalError):
    """A step was too long; a shorter step may succeed."""


class Implicit(Scheme):
    """Backward Euler, with increments chosen by error; stable at any length.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> for tolerance in (0.01, 0.001):
    ...     run = case.with_values({"stepping": tribo.Implicit(depth_tolerance=tolerance)}).run()
    ...     print(f"{run.distances[-1]:.2f} m")  # until a depth of 1 µm
    1.33 m
    1.32 m
    """

    type: Literal["implicit"] = "implicit"
    depth_tolerance: Annotated[float, Quantity("1", above=0, at_most=0.1)] = 1e-3
    """Largest local error of the wear depth in one step, relative to the depth worn so far; five
    times as much is allowed of the volume, relative to what the step wears."""
    pressure_tolerance: Annotated[float, Quantity("1", above=0, at_most=1)] = 0.05
    """Load-weighted relative change of pressure at which one step leaves the next its length: a
    larger change shortens it."""
    settle: Annotated[float, Quantity("1", above=0, at_most=1)] = 0.01
    """Length of the last step before a save, relative to the distance slid by then."""
    nonlinear_tolerance: Annotated[float, Quantity("1", above=0, at_most=1e-3)] = 1e-8
    """How exactly a step fulfils backward Euler for a law that is not linear in pressure."""
    cycle_tolerance: Annotated[float, Quantity("1", above=0, at_most=0.1)] = 1e-3
    """How exactly it does over the positions of a resolved cycle: the mean error of the depth,
    weighted with the load, relative to the largest depth that it wears."""
    max_passes: Annotated[int, Field(ge=1, le=1000)] = 60
    """Largest number of solves in a step; a step that needs more is rejected."""

    needs_wear_compliance: ClassVar[bool] = True

    def slide(self, model: Model, state: State, target: float, until: float) -> State:
        """Return the state after the longest step that meets the tolerances; see `Scheme.slide`.

        `NumericalError` if steps are rejected down to a length that drowns in rounding.
        """
        settle = self.settle if until in model.saves else 0.0
        remaining = target - state.distance
        natural = state.increment or _first_increment(model, state, remaining, until)
        rejected = 0
        while True:
            increment = next_increment(natural, remaining, settle * target)
            last = increment == remaining
            time = until if last else time_at(model, state, state.distance + increment, until)
            try:
                after, slid, forward = self._attempt(model, state, increment, time)
                depth, volume, pressure = step_errors(
                    model, state, after, forward, self.depth_tolerance, self.pressure_tolerance
                )
                if max(depth, volume) <= 1:
                    ended = with_friction_work(model, state, after, slid)
                    break
                factor = increment_factor(depth, volume, pressure)
                failure: NumericalError | None = None
            except (StepRejected, BadValues) as error:
                factor, failure = SHRINK, error
            rejected += 1
            if rejected > MAX_REJECTIONS or factor * increment < SMALLEST * target:
                if failure is not None:
                    raise failure
                raise NumericalError(
                    f"steps down to {increment:.3g} m at {state.distance:.6g} m still miss their "
                    f"tolerances (depth error {depth:.3g}, volume error {volume:.3g} times what is "
                    "allowed); raise stepping.depth_tolerance"
                )
            natural = factor * increment
        # A step cut short to meet a save says little about the next: keep the longer of the two.
        proposal = max(
            increment_factor(depth, volume, pressure) * increment,
            natural if increment < natural else 0.0,
        )
        return replace(
            ended,
            increment=proposal,
            rejected_steps=state.rejected_steps + rejected,
        )

    def step(self, model: Model, state: State, increment: float, time: float) -> State:
        """Return the state after one backward Euler step; see `Scheme.step`."""
        after, slid, _ = self._attempt(model, state, increment, time)
        return with_friction_work(model, state, after, slid)

    def _attempt(
        self, model: Model, state: State, increment: float, time: float
    ) -> tuple[State, Course, dict[str, Array]]:
        """Return the state after a backward Euler step, its course, and forward Euler's wear.

        The last is the depth by body, on the body's surface, in m.

        The step's wear enters the contact problem as compliance; where that is
        not the law's exact wear (a law not linear in pressure, a field that
        depends on it), the remainder is put into the gap and the solve repeated
        until they agree. The step wears under its mean load, so that the volume is
        right for a load that changes along it; the contact at its end is solved
        again under the load there. `StepRejected` if the passes or a solve do not
        converge.
        """
        interval = interval_from(state, increment, time)
        resolved = len(model.cycle) > 1
        tolerance = self.cycle_tolerance if resolved else self.nonlinear_tolerance
        base = undeformed(model, state)
        dx = model.grid.spacing[0]
        before = remembered(model, state)
        slide = partial(course, model, before, interval=interval)
        slid = Course(state.contacts, state.rates, before)
        if not state.rates:
            # States are integrated along it; other rates are those where it begins.
            slid = slide(contacts=state.contacts, asked=0.0)
        height = filling(model, before)
        worn = worn_depths(model, slid.rates, increment)
        opened, deepest = _opened(model, height, slid, worn)
        load = model.loads(state).mean(state.time, time)
        # States are integrated under the load of the step already.
        heavier = 1.0 if before.values else load / model.loads(state).after(state.time)
        forward = {name: heavier * depth for name, depth in worn.items()}
        contacts = extrapolated(state)
        solved, passes = state, 0
        while True:
            rates = sloped(model, before, interval, slid)
            wear = linear_wear(model, rates, slid.contacts, increment)
            # Of what changes the gap, the part that is not linear in the pressures.
            beyond = add_depths(opened, -1.0, wear, slid.contacts, dx)
            gaps = base + beyond
            try:
                contacts = solve_cycle(model, gaps, load, contacts, state.bodies, wear)
            except PluginError:
                raise
            except NumericalError as error:
                raise StepRejected(str(error)) from error
            implied = add_depths(beyond, 1.0, wear, contacts, dx)
            solved, passes = counted(solved, contacts), passes + 1
            # Later passes change the contacts little.
            slid = slide(contacts=contacts, plan=slid.plan, adapts=passes == 1)
            worn = worn_depths(model, slid.rates, increment)
            opened, deepest = _opened(model, height, slid, worn)
            off = opened - implied
            mismatch = loaded_mean(model, contacts, off) if resolved else _largest([off])
            if mismatch <= tolerance * deepest:
                break
            if passes == self.max_passes:
                raise StepRejected(
                    f"the implicit step of {increment:.3g} m at {state.distance:.6g} m did not "
                    f"converge in {passes} passes: wear depth still off by {mismatch:.2g} m; "
                    "raise stepping.max_passes or lower stepping.pressure_tolerance"
                )
        after = worn_by(model, solved, slid, worn, interval)
        if not before.values:
            # Set first: settling a groove leaves the pressure that these rates belong to. What is
            # remembered changes them along a step.
            after = replace(after, rates=slid.rates)
        model.listener.worn(contacts, interval, before, slid.plan)
        # What the passes leave over is pressure that does not belong to the worn gap. Stiff bodies
        # would keep so much of it that no later step, however short, could change it little.
        little, linear = LEFT_OVER * self.pressure_tolerance, self.nonlinear_tolerance * deepest
        exact = mismatch <= linear or mismatch <= little * _deformed(contacts, base + implied)
        return accepted(model, after, contacts, load, exact=exact), slid, forward


def _deformed(contacts: Sequence[ContactSolution], gaps: Array) -> float:
    """Return the largest deformation of the bodies, in m."""
    return _largest(
        np.where(contact.pressure > 0, contact.approach - gap, 0.0)
        for contact, gap in zip(contacts, gaps, strict=True)
    )


def _opened(
    model: Model, height: Array, slid: Course, worn: Mapping[str, Array]
) -> tuple[Array, float]:
    """Return the depth by which a step opens the gap, (positions, nx, ny), and its largest part.

    `worn` has the depth by body, on the body's surface; `height` filled the gap before it; in m.
    """
    opened, filled = seen(model, worn), filling(model, slid.memory) - height
    deepest = _largest([opened, filled])
    opened -= filled
    return opened, deepest


def _first_increment(model: Model, state: State, remaining: float, until: float) -> float:
    """Return a first increment, in m, that wears a small part of the elastic approach."""
    moment = interval_from(state, remaining, until).at(0.0)
    rates = wear_rates(model, state.contacts, remembered(model, state), moment)
    fastest = _largest(rate.depth_rate for of_bodies in rates for rate in of_bodies.values())
    first = FIRST * state.reference_depth / fastest if fastest > 0 else 0.0
    # Two flats that repeat have no approach but rounding, and wear evenly.
    return min(remaining, first) if first > SMALLEST * remaining else remaining


def _largest(arrays: Iterable[Array]) -> float:
    """Return the largest absolute value in any of some arrays; 0 if there are none."""
    return max((float(max(np.max(array), -np.min(array))) for array in arrays), default=0.0)
