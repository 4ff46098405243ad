"""The parts of a step, as pure functions of model and state."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution, CycleCompliance, WearCompliance
from tribo.core.errors import CaseError, NumericalError, PluginError
from tribo.core.fields import WearRate
from tribo.core.loads import ByPosition
from tribo.core.measures import Invariants, reaches_border
from tribo.core.state import BodyState, State
from tribo.stepping.rates import CycleRates, LawStates, Moment

if TYPE_CHECKING:
    from tribo.simulation.model import Model

# Each pass is one warm solve; a groove in a much softer body takes over a thousand.
SETTLE_PASSES = 5000
SETTLED = 1e-6
MIRRORED = 1e-12
"""Relative difference below which two positions mirror each other: rounding."""
SMALLEST = 1e-12
"""Of the distance until the next stop: a shorter step would drown in rounding."""


def first_contact(model: Model, worn: Mapping[str, BodyState] | None = None) -> State:
    """Solve the contact before any sliding, plastic flow included.

    Parameters
    ----------
    model : Model
        The composed case.
    worn : Mapping[str, BodyState], optional
        The bodies, by name, if they are worn already.

    Raises
    ------
    CaseError
        If the contact does not fit the window.
    NumericalError
        If the solver fails.
    """
    solved: dict[tuple[int, float], ContactSolution] = {}
    bodies = _unworn(model) if worn is None else worn
    gaps: Sequence[Array] = model.gaps
    if worn is not None:
        gaps = [geometry(model, worn, position) for position in range(len(gaps))]
    loads = model.loads.after(0.0)
    asked = [(id(gap), load) for gap, load in zip(gaps, loads, strict=True)]
    for gap, load, key in zip(gaps, loads, asked, strict=True):
        # Where nothing varies along the path, one solve serves all positions.
        if key not in solved:
            solved[key] = solve(model, gap, load, None, *list(solved.values())[-1:])
    contacts = tuple(solved[key] for key in asked)
    if any(reaches_border(each.pressure) for each in contacts) and not model.may_reach_edge:
        raise CaseError(
            "the first contact reaches the edge of the window of "
            f"{1e3 * model.grid.size[0]:.4g} × {1e3 * model.grid.size[1]:.4g} mm; make it larger "
            "(or, for a body that ends there, set grid.ends_at_window = true)",
            "grid.size",
        )
    middle = len(contacts) // 2
    overlap = contacts[middle].overlap
    if np.any(overlap > 0):
        bodies = {
            name: replace(
                body,
                plastic=body.plastic
                + model.plastic_share[name] * model.spread(name, overlap, middle),
            )
            for name, body in bodies.items()
        }
    return State(
        time=0.0,
        distance=0.0,
        bodies=dict(bodies),
        contacts=contacts,
        increment=0.0,
        # The approach counts from the lowest point of unworn bodies.
        reference_depth=contacts[middle].approach - float(np.min(gaps[middle])),
        load_distance=0.0,
        contact_solves=len(solved),
        solver_iterations=sum(contact.iterations for contact in solved.values()),
    )


def _unworn(model: Model) -> dict[str, BodyState]:
    bodies = {}
    for name in model.bodies:
        wear = np.zeros((model.exposures[name].rows, model.grid.cells[1]))
        initial = model.laws[name].initial_state if name in model.laws else {}
        bodies[name] = BodyState(
            wear=wear,
            plastic=model.spread(name, np.zeros(model.grid.cells), len(model.cycle) // 2),
            law={field: np.full_like(wear, value) for field, value in initial.items()},
        )
    return bodies


def geometry(model: Model, bodies: Mapping[str, BodyState], position: int = 0) -> Array:
    """Return the undeformed gap, worn and plastically deformed, shape (nx, ny), in m."""
    gap = model.gaps[position].copy()
    for name, body in bodies.items():
        gap += model.under(name, body.wear, position)
        gap += model.under(name, body.plastic, position)
    return gap


def solve(
    model: Model,
    gap: Array,
    load: float,
    wear: WearCompliance | None = None,
    start: ContactSolution | None = None,
) -> ContactSolution:
    """Solve the contact of the case at a gap, shape (nx, ny), in m, under a load, in N."""
    return model.solver.solve(ContactProblem(model.system, gap, load, wear), start)


def solve_cycle(
    model: Model,
    gaps: Iterable[Array],
    loads: ByPosition,
    starts: Sequence[ContactSolution],
    wear: LinearWear | None = None,
) -> list[ContactSolution]:
    """Solve the contact at each position of a cycle, from gaps of shape (nx, ny), in m.

    `loads` are in N. Where the positions are solved together and each mirrors another along x, as
    on a stroke of smooth bodies, half of them are solved.
    """
    alone = [None] * len(loads) if wear is None else wear.alone
    coupling = None if wear is None else wear.coupling
    problems = [
        ContactProblem(model.system, *given) for given in zip(gaps, loads, alone, strict=True)
    ]
    if not (model.couples and _all_mirror(problems, coupling)):
        return model.solver.solve_cycle(problems, starts, coupling)
    half = len(problems) // 2 + 1
    one_side = None if coupling is None else _one_side(coupling, half)
    *left, middle = model.solver.solve_cycle(problems[:half], starts[:half], one_side)
    return [*left, _symmetric(middle), *map(_mirrored, reversed(left))]


def solved(contacts: Sequence[ContactSolution]) -> int:
    """Return how many of the contacts of a cycle were solved, others being mirrored."""
    return sum(contact.iterations > 0 for contact in contacts)


def _all_mirror(problems: Sequence[ContactProblem], coupling: CycleCompliance | None) -> bool:
    """Whether each position mirrors another along x, and the middle one itself."""
    mirrored = all(
        abs(one.load - other.load) <= MIRRORED * one.load and _mirrors(one.gap, other.gap)
        for one, other in zip(problems, reversed(problems), strict=True)
    )
    return mirrored and (coupling is None or _bodies_mirror(coupling))


def _bodies_mirror(coupling: CycleCompliance) -> bool:
    """Whether two positions that mirror each other lie so on the bodies, too."""
    for compliance, starts in coupling.bodies:
        rows = len(compliance)
        beyond = rows - (coupling.rows.stop - coupling.rows.start)
        pairs = zip(starts, reversed(starts), strict=True)
        if not _mirrors(compliance, compliance) or any((a + b - beyond) % rows for a, b in pairs):
            return False
    return True


def _mirrors(field: Array, other: Array) -> bool:
    least = MIRRORED * float(np.max(np.abs(field)))
    return bool(np.max(np.abs(field[::-1] - other)) <= least)


def _one_side(coupling: CycleCompliance, half: int) -> CycleCompliance:
    shares = coupling.shares[:half].copy()
    # The middle position mirrors itself.
    shares[-1] *= 0.5
    bodies = [(compliance, starts[:half]) for compliance, starts in coupling.bodies]
    return replace(coupling, shares=shares, bodies=bodies, mirrored=True)


def _mirrored(contact: ContactSolution) -> ContactSolution:
    pressure, overlap = contact.pressure[::-1].copy(), contact.overlap[::-1].copy()
    return replace(contact, pressure=pressure, overlap=overlap, iterations=0)


def _symmetric(contact: ContactSolution) -> ContactSolution:
    """Return the mean of a contact and its mirror image: what rounding made of it goes."""
    pressure = 0.5 * (contact.pressure + contact.pressure[::-1])
    overlap = 0.5 * (contact.overlap + contact.overlap[::-1])
    return replace(contact, pressure=pressure, overlap=overlap)


def moment_after(state: State, increment: float, time: float) -> Moment:
    """Return the end of a step from `state`."""
    return Moment(time, state.distance + increment, increment / (time - state.time))


def distance_until(model: Model, state: State, time: float) -> float:
    """Return the sliding distance at a later time, which must have grown, in m."""
    distance = model.motion.distance_at(time)
    if not state.distance < distance < np.inf:
        raise PluginError(
            f"{model.motion} does not slide on: {state.distance:g} m "
            f"at {state.time:g} s, {distance:g} m at {time:g} s"
        )
    return distance


def rests(model: Model, state: State, time: float) -> bool:
    """Whether the motion rests until a later time (s), but for rounding."""
    # A distance that has turned back by then has grown before.
    return all(
        abs(model.motion.distance_at(t) - state.distance) <= SMALLEST * state.distance
        for t in (time, 0.5 * (state.time + time))
    )


def rested(model: Model, state: State, time: float) -> State:
    """Return `state` at a later time (s), under the load of then."""
    loads = model.loads.before(time)
    if loads != model.loads.before(state.time):
        state = _under(model, state, loads)
    return replace(state, time=time, steps=state.steps + 1, invariants=Invariants())


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
            part = slid * model.average(name, rate.depth_rate, position)
            worn[name] = worn[name] + part if name in worn else part
    return worn


def lost(model: Model, worn: Mapping[str, Array], position: int) -> Array:
    """Return what the depths `worn` add to the gap at a position, shape (nx, ny), in m."""
    depth = np.zeros(model.grid.cells)
    for name, of_body in worn.items():
        depth += model.under(name, of_body, position)
    return depth


def law_states_after(
    model: Model, before: LawStates, rates: CycleRates, increment: float
) -> dict[str, dict[str, Array]]:
    """Return the state fields of the laws after `increment` (m)."""
    after = {name: dict(fields) for name, fields in before.items()}
    for position, of_bodies in enumerate(rates):
        slid = increment * model.cycle[position].share
        for name, rate in of_bodies.items():
            for field, values in rate.state_rates.items():
                change = slid * model.average(name, values, position)
                after[name][field] = after[name][field] + change
    return after


@dataclass(frozen=True)
class LinearWear:
    """The wear of a step at the positions of a cycle, linear in their pressures.

    Parameters
    ----------
    alone : sequence of WearCompliance or None
        By position, what its own pressure wears; where the positions are coupled, none.
    coupling : CycleCompliance or None
        What the pressures of all positions wear at each.
    """

    alone: Sequence[WearCompliance | None]
    coupling: CycleCompliance | None = None

    def depths(self, contacts: Sequence[ContactSolution], dx: float) -> Array:
        """Return the depth worn at each position, shape (positions, nx, ny), in m."""
        pressure = np.stack([contact.pressure for contact in contacts])
        if self.coupling is not None:
            return self.coupling.depth(pressure, dx)
        pairs = zip(self.alone, pressure, strict=True)
        return np.stack([part.depth(p, dx) if part else np.zeros_like(p) for part, p in pairs])


def linear_wear(
    model: Model, rates: CycleRates, contacts: Sequence[ContactSolution], increment: float
) -> LinearWear:
    """Return the wear over `increment` (m), linear in the pressures about those of `contacts`."""
    if model.couples:
        return LinearWear([None] * len(contacts), _coupling(model, rates, contacts, increment))
    return LinearWear(
        [
            wear_compliance(model, of_bodies, contact.pressure, increment)
            for of_bodies, contact in zip(rates, contacts, strict=True)
        ]
    )


def wear_compliance(
    model: Model, rates: Mapping[str, WearRate], pressure: Array, increment: float
) -> WearCompliance:
    """Return the wear over `increment` (m) at a position, linear in pressure, as a compliance."""
    local = np.zeros(model.grid.cells)
    swept = np.zeros(model.grid.cells[1])
    for name, rate in rates.items():
        part = model.exposures[name].compliance(rate.depth_slope, pressure)
        if part is not None:
            local += increment * part.local
            swept += increment * part.swept
    return WearCompliance(local, swept)


def _coupling(
    model: Model, rates: CycleRates, contacts: Sequence[ContactSolution], increment: float
) -> CycleCompliance:
    """Return the wear at all positions, each point of a body with the mean slope of its law."""
    shares = np.array([position.share for position in model.cycle])
    bodies = []
    for name in rates[0]:
        shape = (model.exposures[name].rows, model.grid.cells[1])
        weighed, load, nearby = np.zeros(shape), np.zeros(shape), np.zeros(shape)
        for position, (share, contact) in enumerate(zip(shares, contacts, strict=True)):
            pressure, slope = contact.pressure, rates[position][name].depth_slope
            weighed += share * model.average(name, slope * pressure, position)
            load += share * model.spread(name, pressure, position)
            np.maximum(nearby, model.average(name, slope, position), out=nearby)
        # A point that is yet to be touched has the slope that its law gives near it, on its row.
        slope = np.where(load > 0, weighed / np.where(load > 0, load, 1.0), np.max(nearby, axis=0))
        starts = model.exposures[name].starts or [0] * len(shares)
        bodies.append((increment * slope, starts))
    return CycleCompliance(shares, bodies, slice(0, model.grid.cells[0]))


def worn_bodies(state: State, worn: Mapping[str, Array], law: LawStates) -> dict[str, BodyState]:
    """Return the bodies of `state` after they have lost the depths `worn`, in m."""
    return {
        name: replace(body, wear=body.wear + worn[name], law=law[name]) if name in worn else body
        for name, body in state.bodies.items()
    }


def accepted(
    model: Model,
    before: State,
    bodies: Mapping[str, BodyState],
    contacts: Sequence[ContactSolution],
    loads: ByPosition,
    moment: Moment,
    solves: int,
    iterations: int,
) -> State:
    """Return the state of the worn bodies in contact, after what yields has come to rest.

    The contacts carry `loads`, in N; they are solved anew where those at the end are others.
    """
    mean = model.loads.over_cycle(model.loads.mean(before.time, moment.time))
    state = replace(
        before,
        time=moment.time,
        distance=moment.distance,
        load_distance=before.load_distance + mean * (moment.distance - before.distance),
        speed=moment.speed,
        bodies=bodies,
        contacts=tuple(contacts),
        steps=before.steps + 1,
        contact_solves=before.contact_solves + solves,
        solver_iterations=before.solver_iterations + iterations,
    )
    at_end = model.loads.before(moment.time)
    return _at_rest(model, state, loads) if loads == at_end else _under(model, state, at_end)


def start_sliding(model: Model, state: State) -> State:
    """Return `state` as a step begins: under the load after a jump, its indentation drawn out.

    At s = 0 plastic displacement is local; once a body slides, its groove is
    the envelope along the track, and the contact in it is solved anew.
    """
    loads = model.loads.after(state.time)
    if loads != model.loads.before(state.time):
        # How far a step may go under the load before says little.
        state = replace(_under(model, state, loads), increment=0.0)
    return _settle(model, state, loads) if state.distance == 0 else state


def _under(model: Model, state: State, loads: ByPosition) -> State:
    """Return `state` with its contacts solved anew under other loads (N), and nothing worn."""
    gaps = [geometry(model, state.bodies, position) for position in range(len(model.cycle))]
    contacts = solve_cycle(model, gaps, loads, state.contacts)
    anew = replace(
        state,
        contacts=tuple(contacts),
        rates=(),
        contact_solves=state.contact_solves + solved(contacts),
        solver_iterations=state.solver_iterations + sum(c.iterations for c in contacts),
    )
    return _at_rest(model, anew, loads)


def _at_rest(model: Model, state: State, loads: ByPosition) -> State:
    """Return `state` after what yields in its contacts, under `loads`, has come to rest."""
    if not yields(state.contacts):
        return state
    yielded = replace(state, bodies=_yielded(model, state.bodies, state.contacts))
    return _settle(model, yielded, loads) if state.distance > 0 else yielded


def yields(contacts: Sequence[ContactSolution]) -> bool:
    """Whether the bodies yield at any position."""
    return any(np.any(contact.overlap > 0) for contact in contacts)


def _yielded(
    model: Model, bodies: Mapping[str, BodyState], contacts: Sequence[ContactSolution]
) -> dict[str, BodyState]:
    """Return the bodies with what yields at each position, once where positions overlap."""
    if not yields(contacts):
        return dict(bodies)
    yielded = {}
    for name, body in bodies.items():
        overlaps = [
            model.spread(name, contact.overlap, position)
            for position, contact in enumerate(contacts)
        ]
        deepest = reduce(np.maximum, overlaps)
        yielded[name] = replace(body, plastic=body.plastic + model.plastic_share[name] * deepest)
    return yielded


def _settle(model: Model, state: State, loads: ByPosition) -> State:
    """Draw grooves out along the track and re-solve until nothing yields any more."""
    drawn_out = any(
        name in model.swept and np.any(body.plastic > 0) for name, body in state.bodies.items()
    )
    # What yields at one position alters the others, whichever body it is.
    if not drawn_out and not (len(model.cycle) > 1 and yields(state.contacts)):
        return state
    for _ in range(SETTLE_PASSES):
        drawn = {
            name: replace(body, plastic=_drawn_out(model, name, body.plastic))
            for name, body in state.bodies.items()
        }
        gaps = [geometry(model, drawn, position) for position in range(len(model.cycle))]
        contacts = solve_cycle(model, gaps, loads, state.contacts)
        deepest = max(float(np.max(body.plastic)) for body in drawn.values())
        still = max(float(np.max(contact.overlap)) for contact in contacts)
        settled = still <= SETTLED * deepest
        state = replace(
            state,
            bodies=drawn if settled else _yielded(model, drawn, contacts),
            contacts=tuple(contacts),
            rates=(),
            contact_solves=state.contact_solves + solved(contacts),
            solver_iterations=state.solver_iterations + sum(c.iterations for c in contacts),
        )
        if settled:
            return state
    raise NumericalError(
        f"at {state.distance:.6g} m the groove still yields after {SETTLE_PASSES} passes of the "
        f"contact, by {still:.2g} m a pass: sliding under "
        f"{max(loads):g} N does not come to rest at a hardness of "
        f"{1e-9 * (model.system.cap or 0):g} GPa; lower load.normal, or set contact.plasticity = "
        "false"
    )


def _drawn_out(model: Model, name: str, plastic: Array) -> Array:
    """Return the plastic depth of a body along its whole path."""
    envelope = model.exposures[name].envelope(plastic)
    return np.array(np.broadcast_to(envelope, plastic.shape))
