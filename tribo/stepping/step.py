"""The parts of a step, as pure functions of model and state."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution
from tribo.core.errors import CaseError, NumericalError, PluginError
from tribo.core.loads import ByPosition
from tribo.core.measures import Invariants, reaches_border
from tribo.core.notices import Notice
from tribo.core.state import BodyState, State
from tribo.stepping.contacts import solve_cycle
from tribo.stepping.events import Drawn, Solved, Worn, Yielded
from tribo.stepping.evolution import Course, course
from tribo.stepping.invariants import ONE_LOAD, wear_balance
from tribo.stepping.layers import caps, plastic_share, worn_through
from tribo.stepping.memory import filling, first_memory, remembered
from tribo.stepping.rates import CycleRates, Moment

if TYPE_CHECKING:
    from tribo.stepping.model import Model

# Each pass is one warm solve; a groove in a much softer body takes over a thousand.
SETTLE_PASSES = 5000
SETTLED = 1e-6
ROUNDING = 1e-9
SMALLEST = 1e-12
"""Of the distance until the next stop: a shorter step would drown in rounding."""


def first_contact(
    model: Model,
    worn: Mapping[str, BodyState] | None = None,
    between: Mapping[str, Array] | None = None,
) -> State:
    """Solve the contact before any sliding, plastic flow included.

    Parameters
    ----------
    model : Model
        The composed case.
    worn : Mapping[str, BodyState], optional
        The bodies, by name, if they are worn already.
    between : Mapping[str, ndarray], optional
        State fields of effects, by name, that do not start at their initial values.

    Raises
    ------
    CaseError
        If the contact does not fit the window.
    NumericalError
        If the solver fails.
    """
    state = State(
        time=0.0,
        distance=0.0,
        bodies=_unworn(model) if worn is None else worn,
        contacts=(),
        increment=0.0,
        reference_depth=0.0,
        load_distance=0.0,
        between={**first_memory(model), **(between or {})},
    )
    # Kept in a list, so that each gap has an identity of its own.
    gaps = list(
        undeformed(model, state) if worn is not None or model.laws.filling else model.contact.gaps
    )
    solutions: dict[tuple[int, float], ContactSolution] = {}
    asked = [
        (id(gap), load) for gap, load in zip(gaps, model.contact.loads.after(0.0), strict=True)
    ]
    for gap, key, cap in zip(gaps, asked, caps(model, state.bodies), strict=True):
        # Where nothing varies along the path, one solve serves all positions.
        if key not in solutions:
            problem = ContactProblem(model.contact.system, gap, key[1], cap=cap)
            start = next(reversed(solutions.values()), None)
            solutions[key] = model.contact.solver.solve(problem, start)
    contacts = tuple(solutions[key] for key in asked)
    if any(reaches_border(each.pressure) for each in contacts) and not model.contact.may_reach_edge:
        size = f"{1e3 * model.grid.size[0]:.4g} × {1e3 * model.grid.size[1]:.4g} mm"
        remedy = "make it larger (or, for a body that ends there, set grid.ends_at_window = true)"
        forms = [surface.ask(surface.component.smoothed) for surface in model.surfaces.values()]
        if all(form.curvature == (0, 0) for form in forms):
            remedy = (
                "two flat bodies touch all over it, however large it is: give one an edge "
                '(surface.type = "pin"), let the contact repeat with the window (contact.type = '
                '"periodic"), or let a body end there (grid.ends_at_window = true)'
            )
        raise CaseError(
            f"the first contact reaches the edge of the window of {size}; {remedy}", "grid.size"
        )
    model.tell(Solved(contacts))
    middle = len(contacts) // 2
    return replace(
        state,
        contacts=contacts,
        contact_solves=len(solutions),
        solver_iterations=sum(contact.iterations for contact in solutions.values()),
        bodies=_yielded(model, state.bodies, contacts, [middle]),
        # The approach counts from the lowest point of unworn bodies.
        reference_depth=contacts[middle].approach - float(np.min(gaps[middle])),
    )


def _unworn(model: Model) -> dict[str, BodyState]:
    bodies = {}
    for name in model.case.bodies:
        wear = np.zeros((model.cycle.maps[name].rows, model.grid.cells[1]))
        initial = model.laws.wear[name].initial_state if name in model.laws.wear else {}
        bodies[name] = BodyState(
            wear=wear,
            plastic=model.cycle.maps[name].lay(np.zeros(model.grid.cells), len(model.cycle) // 2),
            law={field: np.full_like(wear, value) for field, value in initial.items()},
        )
    return bodies


def undeformed(model: Model, state: State) -> Array:
    """Return the gap at each position, worn, plastically deformed and filled, in m.

    Shape (positions, nx, ny).
    """
    gaps = np.stack(model.contact.gaps) - filling(model, remembered(state))
    for position, gap in enumerate(gaps):
        for name, body in state.bodies.items():
            gap += model.cycle.maps[name].see(body.wear, position)
            gap += model.cycle.maps[name].see(body.plastic, position)
    return gaps


def counted(state: State, contacts: Sequence[ContactSolution]) -> State:
    """Return `state` with the solves of the contacts of a cycle counted."""
    # Those that mirror others took no iterations.
    iterations = [contact.iterations for contact in contacts if contact.iterations > 0]
    return replace(
        state,
        contact_solves=state.contact_solves + len(iterations),
        solver_iterations=state.solver_iterations + sum(iterations),
    )


def moment_after(state: State, increment: float, time: float) -> Moment:
    """Return the end of a step from `state`."""
    return Moment(time, state.distance + increment, increment / (time - state.time))


def distance_until(model: Model, state: State, time: float) -> float | None:
    """Return the sliding distance at a later time (s), in m; None if the motion rests until then.

    It must have grown, but for rounding.
    """
    distance = model.motion.distance_at(time)
    # A distance that has turned back by then has grown before.
    if abs(distance - state.distance) <= SMALLEST * state.distance:
        halfway = model.motion.distance_at(0.5 * (state.time + time))
        if abs(halfway - state.distance) <= SMALLEST * state.distance:
            return None
    if not state.distance < distance < np.inf:
        raise PluginError(
            f"{model.motion} does not slide on: {state.distance:g} m "
            f"at {state.time:g} s, {distance:g} m at {time:g} s"
        )
    return distance


def time_at(model: Model, state: State, distance: float, until: float) -> float:
    """Return the time at which it has slid `distance` (m), between now and `until` (s)."""
    time = model.motion.time_at(distance)
    if not state.time < time <= until * (1 + 1e-9):
        raise PluginError(
            f"{model.motion} puts {distance:g} m at {time:g} s, which "
            f"does not lie between {state.time:g} s and {until:g} s"
        )
    return time


def load_changes(model: Model, begin: float, end: float) -> bool:
    """Whether the load changes between two times (s), so that the pressure does."""
    pairs = zip(model.contact.loads.after(begin), model.contact.loads.before(end), strict=True)
    return any(abs(last - first) > ONE_LOAD * first for first, last in pairs)


def rested(model: Model, state: State, time: float) -> State:
    """Return `state` at a later time (s), under the load of then."""
    memory = remembered(state)
    if memory.between:
        rest, moment = time - state.time, Moment(time, state.distance, 0.0)
        after = course(model, memory, state.contacts, rest, moment)
        model.tell(Worn(state.contacts, state.time, rest, moment, memory, after.plan, ahead=True))
        state = replace(state, between=after.memory.between)
    loads = model.contact.loads.before(time)
    anew = loads != model.contact.loads.before(state.time) or any(
        body is None for body, _ in model.laws.filling
    )
    state = replace(state, speed=0.0)
    if anew:
        state = _under(model, state, loads)
    return replace(state, time=time, steps=state.steps + 1, invariants=Invariants())


def start_sliding(model: Model, state: State) -> State:
    """Return `state` as a step begins: under the load after a jump, its indentation drawn out.

    At s = 0 plastic displacement is local; once a body slides, its groove is
    the envelope along the track, and the contact in it is solved anew. So is one in which points
    have been worn down to a softer layer.
    """
    loads = model.contact.loads.after(state.time)
    if loads != model.contact.loads.before(state.time):
        # How far a step may go under the load before says little.
        state = replace(_under(model, state, loads), increment=0.0)
    elif _too_soft(model, state):
        state = _under(model, state, loads)
    return _settle(model, state, loads) if state.distance == 0 else state


def _too_soft(model: Model, state: State) -> bool:
    """Whether points bear more than the layer that they have been worn down to does."""
    return any(
        cap is not None and np.any(contact.pressure > cap * (1 + ROUNDING))
        for contact, cap in zip(state.contacts, caps(model, state.bodies), strict=True)
    )


def worn_depths(
    model: Model, rates: CycleRates, increment: float, shares: Array | None = None
) -> dict[str, Array]:
    """Return the depth that each body loses over `increment` (m), on its own surface, in m.

    `shares` are taken in place of the positions' own shares of the path.
    """
    worn: dict[str, Array] = {}
    for position, of_bodies in enumerate(rates):
        share = model.cycle[position].share if shares is None else float(shares[position])
        slid = increment * share
        for name, rate in of_bodies.items():
            exposure = model.cycle.maps[name]
            worn[name] = exposure.gather(rate.depth_rate, position, slid, worn.get(name))
    return worn


def worn_by(
    model: Model,
    before: State,
    slid: Course,
    depths: Mapping[str, Array],
    increment: float,
    moment: Moment,
) -> State:
    """Return the state after an increment (m) up to `moment`, its contacts yet to be solved.

    `depths` has what each body loses on it, on its own surface, in m.
    """
    shares = model.cycle.missed_shares
    between = {} if shares is None else worn_depths(model, slid.rates, increment, shares)
    bodies = dict(before.bodies)
    for name, depth in depths.items():
        body = bodies[name] = replace(
            bodies[name], wear=bodies[name].wear + depth, law=slid.memory.laws[name]
        )
        if name in between:
            missed = between[name] if body.missed is None else body.missed + between[name]
            bodies[name] = replace(body, missed=missed)
    mean = model.contact.loads.over_cycle(model.contact.loads.mean(before.time, moment.time))
    passed: Iterable[Notice] = ()
    if (begun := slid.begun) is not None:
        passed = worn_through(
            model, before, bodies, increment, lambda m: worn_depths(model, begun(m).rates, m)
        )
    return replace(
        before,
        time=moment.time,
        distance=moment.distance,
        load_distance=before.load_distance + mean * (moment.distance - before.distance),
        speed=moment.speed,
        bodies=bodies,
        between=slid.memory.between,
        rates=(),
        steps=before.steps + 1,
        notices=(*before.notices, *passed),
        invariants=wear_balance(model, depths, slid.rates, increment, before),
    )


def accepted(
    model: Model,
    after: State,
    contacts: Sequence[ContactSolution],
    loads: ByPosition,
    *,
    exact: bool = True,
) -> State:
    """Return `after`, the worn bodies, in contact, with what yields at rest.

    The contacts carry `loads`, in N; they are solved anew where those at the end are others, or
    where they do not belong to the bodies `exact`ly.
    """
    after = replace(after, contacts=tuple(contacts))
    at_end = model.contact.loads.before(after.time)
    kept = exact and loads == at_end
    return _at_rest(model, after, loads) if kept else _under(model, after, at_end)


def _under(model: Model, state: State, loads: ByPosition) -> State:
    """Return `state` with its contacts solved anew under other loads (N), and nothing worn."""
    return _at_rest(model, _solved_anew(model, state, loads), loads)


def _solved_anew(model: Model, state: State, loads: ByPosition) -> State:
    gaps = undeformed(model, state)
    contacts = solve_cycle(model, gaps, loads, state.contacts, state.bodies)
    model.tell(Solved(contacts))
    return replace(counted(state, contacts), contacts=tuple(contacts), rates=())


def _at_rest(model: Model, state: State, loads: ByPosition) -> State:
    """Return `state` after what yields in its contacts, under `loads`, has come to rest."""
    if not yields(state.contacts):
        return state
    # Before it slides the load stands in the middle alone.
    places = range(len(state.contacts)) if state.distance > 0 else [len(state.contacts) // 2]
    state = replace(state, bodies=_yielded(model, state.bodies, state.contacts, places))
    return _settle(model, state, loads) if state.distance > 0 else state


def yields(contacts: Sequence[ContactSolution]) -> bool:
    """Whether the bodies yield at any position."""
    return any(np.any(contact.overlap > 0) for contact in contacts)


def _yielded(
    model: Model,
    bodies: Mapping[str, BodyState],
    contacts: Sequence[ContactSolution],
    places: Sequence[int],
) -> dict[str, BodyState]:
    """Return the bodies with what yields at some positions, once where these overlap."""
    if not yields(contacts):
        return dict(bodies)
    model.tell(Yielded(places))
    yielded = {}
    for name, body in bodies.items():
        overlaps = (
            plastic_share(model, bodies, name, position) * contacts[position].overlap
            for position in places
        )
        own = (model.cycle.maps[name].lay(*each) for each in zip(overlaps, places, strict=True))
        yielded[name] = replace(body, plastic=body.plastic + reduce(np.maximum, own))
    return yielded


def _settle(model: Model, state: State, loads: ByPosition) -> State:
    """Draw grooves out along the track and re-solve until nothing yields any more."""
    drawn_out = any(
        name in model.cycle.swept and np.any(body.plastic > 0)
        for name, body in state.bodies.items()
    )
    # What yields at one position alters the others, whichever body it is.
    if not drawn_out and not (len(model.cycle) > 1 and yields(state.contacts)):
        return state
    for _ in range(SETTLE_PASSES):
        model.tell(Drawn({name: body.plastic for name, body in state.bodies.items()}))
        drawn = {}
        for name, body in state.bodies.items():
            envelope = model.cycle.maps[name].envelope(body.plastic)
            plastic = np.array(np.broadcast_to(envelope, body.plastic.shape))
            drawn[name] = replace(body, plastic=plastic)
        state = _solved_anew(model, replace(state, bodies=drawn), loads)
        deepest = max(float(np.max(body.plastic)) for body in drawn.values())
        still = max(float(np.max(contact.overlap)) for contact in state.contacts)
        if still <= SETTLED * deepest:
            return state
        everywhere = range(len(state.contacts))
        state = replace(state, bodies=_yielded(model, drawn, state.contacts, everywhere))
    raise NumericalError(
        f"at {state.distance:.6g} m the groove still yields after {SETTLE_PASSES} passes of the "
        f"contact, by {still:.2g} m a pass: sliding under {max(loads):g} N does not come to rest "
        f"at a hardness of {1e-9 * (model.contact.system.cap or 0):g} GPa; lower load.normal, or "
        "set contact.plasticity = false"
    )
