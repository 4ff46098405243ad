"""One step of a run, as pure functions of model and state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from tribo.config.stepping import Implicit
from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution, WearCompliance
from tribo.core.errors import CaseError, NumericalError, PluginError
from tribo.core.fields import WearRate
from tribo.core.measures import reaches_border
from tribo.core.state import BodyState, State
from tribo.simulation.invariants import wear_balance
from tribo.simulation.model import Model
from tribo.simulation.rates import LawStates, Moment, law_states, wear_rates
from tribo.simulation.solving import smallest_compliance, solve

# Each pass is one warm solve; a groove in a much softer body takes over a thousand.
SETTLE_PASSES = 5000
SETTLED = 1e-6
NUDGE = 1e-4
"""Part of the pressure by which it is varied to find what a wear rate makes of it."""


class StepRejected(NumericalError):
    """A step was too long to be carried out; a shorter one may do."""


@dataclass(frozen=True)
class ImplicitStep:
    """The state after a backward Euler step, and what forward Euler would have worn.

    `forward` has the depth by body, on the body's surface, in m.
    """

    state: State
    forward: Mapping[str, Array]


def first_contact(model: Model) -> State:
    """Solve the contact before any sliding, plastic flow included.

    Raises
    ------
    CaseError
        If the contact does not fit the window.
    NumericalError
        If the solver fails.
    """
    solution = _solve(model, model.gap, None, None)
    if reaches_border(solution.pressure) and not model.may_reach_edge:
        raise CaseError(
            "the first contact reaches the edge of the window of "
            f"{1e3 * model.grid.size[0]:.4g} × {1e3 * model.grid.size[1]:.4g} mm; make it larger "
            "(or, for a body that ends there, set grid.ends_at_window = true)",
            "grid.size",
        )
    bodies = {}
    for name, body in model.bodies.items():
        unworn = np.zeros_like(model.exposures[name].average(model.gap))
        initial = body.wear.initial_state() if body.wear is not None else {}
        bodies[name] = BodyState(
            wear=unworn,
            plastic=model.plastic_share[name] * solution.overlap,
            law={field: np.full_like(unworn, value) for field, value in initial.items()},
        )
    return State(
        time=0.0,
        distance=0.0,
        bodies=bodies,
        contact=solution,
        increment=0.0,
        reference_depth=solution.approach,
        solver_iterations=solution.iterations,
    )


def geometry(model: Model, bodies: Mapping[str, BodyState]) -> Array:
    """Return the undeformed gap, worn and plastically deformed, shape (nx, ny), in m."""
    gap = model.gap.copy()
    for body in bodies.values():
        gap += body.wear
        gap += body.plastic
    return gap


def implicit_step(
    model: Model, state: State, increment: float, time: float, *, config: Implicit
) -> ImplicitStep:
    """Take one backward Euler step.

    The step's wear enters the contact problem as compliance; where that is
    not the law's exact wear (a law not linear in pressure, a field that
    depends on it), the remainder is put into the gap and the solve repeated
    until it is.

    Parameters
    ----------
    model : Model
        The composed case.
    state : State
        Where the step starts.
    increment : float
        Sliding increment, in m; positive.
    time : float
        Time at the end, in s.
    config : Implicit
        Tolerances.

    Raises
    ------
    StepRejected
        If the passes or a solve do not converge.
    """
    moment = _moment(state, increment, time)
    base = geometry(model, state.bodies)
    dx = model.grid.spacing[0]
    before = law_states(state)
    law, solution = before, state.contact
    solves = iterations = 0
    implied: Array | None = None
    forward: dict[str, Array] = {}
    asked_again = False
    mismatch = drift = np.inf
    rates: Mapping[str, WearRate] = state.rates
    while True:
        if implied is not None or not rates:
            rates = wear_rates(model, solution, law, moment)
        worn = _worn(model, rates, increment)
        settled = _advanced(model, before, rates, increment)
        depth = _total(model, worn)
        if implied is not None:
            mismatch = float(np.max(np.abs(depth - implied)))
            drift = _largest_change(law, settled)
            if mismatch <= config.nonlinear_tolerance * float(np.max(depth)):
                if drift <= config.nonlinear_tolerance:
                    break
                if not asked_again:
                    # The law may wear the same at the state it has now come to: no solve then.
                    law, asked_again = settled, True
                    continue
        else:
            forward = worn
        if solves == config.max_passes:
            raise StepRejected(
                f"the implicit step of {increment:.3g} m at {state.distance:.6g} m did not "
                f"converge in {solves} passes: wear depth still off by {mismatch:.2g} m, the state "
                f"of a law by {drift:.2g} of its largest; raise stepping.max_passes or lower "
                "stepping.pressure_tolerance"
            )
        asked_again = False
        compliance = _compliance(model, rates, solution.pressure, increment)
        remainder = depth - compliance.depth(solution.pressure, dx)
        try:
            solution = _solve(model, base + remainder, compliance, solution)
        except PluginError:
            raise
        except NumericalError as error:
            raise StepRejected(str(error)) from error
        implied = remainder + compliance.depth(solution.pressure, dx)
        law = settled
        solves += 1
        iterations += solution.iterations
    worn_state = _with_wear(state, worn, settled)
    # Set first: settling a groove leaves the pressure that these rates belong to.
    kept = replace(
        state,
        rates=rates,
        invariants=wear_balance(model, worn, rates, increment, state),
    )
    after = _accept(model, kept, worn_state, solution, moment, solves, iterations)
    return ImplicitStep(after, forward)


def explicit_step(model: Model, state: State, increment: float, time: float) -> State:
    """Return the state after one forward Euler step; parameters as `implicit_step`."""
    moment = _moment(state, increment, time)
    rates = rated(model, state, moment).rates
    worn = _worn(model, rates, increment)
    settled = _advanced(model, law_states(state), rates, increment)
    worn_state = _with_wear(state, worn, settled)
    solution = _solve(model, geometry(model, worn_state), None, _continued(state))
    kept = replace(
        state,
        rates={},
        invariants=wear_balance(model, worn, rates, increment, state),
    )
    return _accept(model, kept, worn_state, solution, moment, 1, solution.iterations)


def _continued(state: State) -> ContactSolution:
    """Return the contact as it would be if it went on to change by as much as in the last step."""
    if state.previous is None:
        return state.contact
    pressure = np.maximum(2 * state.contact.pressure - state.previous, 0.0)
    return replace(state.contact, pressure=pressure)


def rated(model: Model, state: State, moment: Moment) -> State:
    """Return `state` with the rates of its contact, asked for unless it has them."""
    if state.rates:
        return state
    rates = wear_rates(model, state.contact, law_states(state), moment)
    return replace(state, rates=rates)


def largest_stable_increment(model: Model, state: State, moment: Moment) -> float | None:
    """Return the increment below which forward Euler is stable, in m.

    Δs λ < 2, with λ bounded from above by the largest derivative of the wear
    rate (local, plus that of a swept body times the part of the track that is
    in contact) over the smallest compliance. The derivative is that of the
    law, or what is found by difference, if more: only so does it hold what
    comes through fields that follow the pressure. None where the contact solver
    does not state its smallest compliance; infinity where nothing wears.
    """
    smallest = smallest_compliance(model.contact, model.system)
    if smallest is None:
        return None
    pressure, near = state.contact.pressure, state.contact.extent
    rates = rated(model, state, moment).rates
    compliance = _compliance(model, _steepened(model, state, rates, moment), pressure, 1.0)
    touching = pressure[near] > 0
    length = np.count_nonzero(touching, axis=0) * model.grid.spacing[0]
    local = float(np.max(compliance.local[near], where=touching, initial=0.0))
    slope = local + float((compliance.swept[near[1]] * length).max())
    return 2 * smallest / slope if slope > 0 else np.inf


def _steepened(
    model: Model, state: State, rates: Mapping[str, WearRate], moment: Moment
) -> Mapping[str, WearRate]:
    """Return `rates` with the derivative in all, where laws follow the fields of effects.

    The pressure is varied in stripes, up and down from row to row: the mode
    that grows first, under the same load.
    """
    following = [
        name for name, body in model.bodies.items() if body.wear is not None and body.wear.requires
    ]
    if not model.effects or not following:
        return rates
    pressure = state.contact.pressure
    stripes = NUDGE * pressure
    stripes[:, ::2] *= -1
    nudged = replace(state.contact, pressure=pressure + stripes)
    others = wear_rates(model, nudged, law_states(state), moment)
    steeper = dict(rates)
    for name in following:
        change = others[name].depth_rate - rates[name].depth_rate
        slope = np.divide(change, stripes, out=np.zeros_like(change), where=stripes != 0)
        derivative = np.maximum(rates[name].depth_slope, slope)
        steeper[name] = replace(rates[name], depth_slope=derivative)
    return steeper


def start_sliding(model: Model, state: State) -> State:
    """Return `state` with the first indentation drawn out along the track.

    At s = 0 plastic displacement is local; once a body slides, its groove is
    the envelope along the track, and the contact in it is solved anew.
    """
    return _settle(model, state) if state.distance == 0 else state


def _moment(state: State, increment: float, time: float) -> Moment:
    return Moment(time, state.distance + increment, increment / (time - state.time))


def _solve(
    model: Model, gap: Array, wear: WearCompliance | None, start: ContactSolution | None
) -> ContactSolution:
    return solve(model.contact, ContactProblem(model.system, gap, model.load, wear), start)


def _worn(model: Model, rates: Mapping[str, WearRate], increment: float) -> dict[str, Array]:
    return {
        name: increment * model.exposures[name].average(rate.depth_rate)
        for name, rate in rates.items()
    }


def _total(model: Model, worn: Mapping[str, Array]) -> Array:
    total = np.zeros(model.grid.cells)
    for depth in worn.values():
        total += depth
    return total


def _advanced(
    model: Model, before: LawStates, rates: Mapping[str, WearRate], increment: float
) -> dict[str, dict[str, Array]]:
    after = {name: dict(fields) for name, fields in before.items()}
    for name, rate in rates.items():
        for field, values in rate.state_rates.items():
            change = increment * model.exposures[name].average(values)
            after[name][field] = before[name][field] + change
    return after


def _largest_change(old: LawStates, new: LawStates) -> float:
    """Return by how much state fields differ, relative to the largest of each."""
    changes = [0.0]
    for name, fields in new.items():
        for field, values in fields.items():
            size = float(np.max(np.abs(values)))
            if size > 0:
                changes.append(float(np.max(np.abs(values - old[name][field]))) / size)
    return max(changes)


def _compliance(
    model: Model, rates: Mapping[str, WearRate], pressure: Array, increment: float
) -> WearCompliance:
    local = np.zeros(model.grid.cells)
    swept = np.zeros(model.grid.cells[1])
    for name, rate in rates.items():
        part = model.exposures[name].compliance(rate.depth_slope, pressure)
        if part is not None:
            local += increment * part.local
            swept += increment * part.swept
    return WearCompliance(local, swept)


def _with_wear(state: State, worn: Mapping[str, Array], law: LawStates) -> dict[str, BodyState]:
    return {
        name: replace(body, wear=body.wear + worn[name], law=law[name]) if name in worn else body
        for name, body in state.bodies.items()
    }


def _accept(
    model: Model,
    before: State,
    bodies: Mapping[str, BodyState],
    solution: ContactSolution,
    moment: Moment,
    solves: int,
    iterations: int,
) -> State:
    state = replace(
        before,
        time=moment.time,
        distance=moment.distance,
        speed=moment.speed,
        bodies=_yielded(model, bodies, solution.overlap),
        contact=solution,
        steps=before.steps + 1,
        contact_solves=before.contact_solves + solves,
        solver_iterations=before.solver_iterations + iterations,
    )
    return _settle(model, state) if np.any(solution.overlap > 0) else state


def _yielded(model: Model, bodies: Mapping[str, BodyState], overlap: Array) -> dict[str, BodyState]:
    if not np.any(overlap > 0):
        return dict(bodies)
    return {
        name: replace(body, plastic=body.plastic + model.plastic_share[name] * overlap)
        for name, body in bodies.items()
    }


def _settle(model: Model, state: State) -> State:
    """Draw grooves out along the track and re-solve until nothing yields any more."""
    if not any(
        model.is_swept(name) and np.any(body.plastic > 0) for name, body in state.bodies.items()
    ):
        return state
    for _ in range(SETTLE_PASSES):
        drawn = {
            name: replace(
                body,
                plastic=np.broadcast_to(
                    model.exposures[name].envelope(body.plastic), model.grid.cells
                ).copy(),
            )
            for name, body in state.bodies.items()
        }
        solution = _solve(model, geometry(model, drawn), None, state.contact)
        deepest = max(float(np.max(body.plastic)) for body in drawn.values())
        settled = float(np.max(solution.overlap)) <= SETTLED * deepest
        state = replace(
            state,
            bodies=drawn if settled else _yielded(model, drawn, solution.overlap),
            contact=solution,
            rates={},
            contact_solves=state.contact_solves + 1,
            solver_iterations=state.solver_iterations + solution.iterations,
        )
        if settled:
            return state
    raise NumericalError(
        f"at {state.distance:.6g} m the groove still yields after {SETTLE_PASSES} passes of the "
        f"contact, by {float(np.max(state.contact.overlap)):.2g} m a pass: sliding under "
        f"{model.load:g} N does not come to rest at a hardness of "
        f"{1e-9 * (model.system.cap or 0):g} GPa; lower load.normal, or set contact.plasticity = "
        "false"
    )
