"""The contact before any sliding."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution
from tribo.core.errors import CaseError
from tribo.core.state import BodyState, State
from tribo.evolution.measure import load_factor
from tribo.evolution.states import first_memory
from tribo.evolution.yielding import caps
from tribo.stepping.contacts import undeformed
from tribo.stepping.plastic_groove import yielded

if TYPE_CHECKING:
    from tribo.model.model import Model


def first_contact(
    model: Model,
    worn: Mapping[str, BodyState] | None = None,
    between: Mapping[str, Array] | None = None,
) -> State:
    """Solve the contact before any sliding, plastic flow and the load of effects included.

    `worn` has bodies that are worn already, and `between` states of effects that do not start at
    their initial values, as in `State`. `CaseError` if the contact does not fit the window.
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
    first = _solved(model, state, gaps)
    factor = load_factor(model, first)
    return first if factor == 1 else _solved(model, replace(state, load_factor=factor), gaps)


def _solved(model: Model, state: State, gaps: Sequence[Array]) -> State:
    """Return `state` in contact and yielded, from the gaps (m) before contact."""
    solutions: dict[int, ContactSolution] = {}
    load = model.loads(state).after(0.0)
    for gap, cap in zip(gaps, caps(model, state.bodies), strict=True):
        # Where nothing varies along the path, one solve serves all positions.
        if id(gap) not in solutions:
            problem = ContactProblem(model.contact.system, gap, load, cap=cap)
            start = next(reversed(solutions.values()), None)
            solutions[id(gap)] = model.contact.solver.solve(problem, start)
    contacts = tuple(solutions[id(gap)] for gap in gaps)
    if any(map(model.leaves_window, contacts)):
        size = f"{1e3 * model.grid.size[0]:.4g} × {1e3 * model.grid.size[1]:.4g} mm"
        remedy = (
            "make it larger, or, for a body that ends there, set grid.ends_at_window = true (two "
            'flat bodies need an edge, surface.type = "pin", or contact.type = "periodic")'
        )
        if model.cycle.across:
            remedy = "make it larger: the path and the contact have to fit into it along y"
        raise CaseError(
            f"the first contact reaches the edge of the window of {size}; {remedy}", "grid.size"
        )
    model.listener.solved(contacts)
    middle = len(contacts) // 2
    return replace(
        state,
        contacts=contacts,
        contact_solves=len(solutions),
        solver_iterations=sum(contact.iterations for contact in solutions.values()),
        bodies=yielded(model, state.bodies, contacts, [middle]),
        # The approach counts from the lowest point of unworn bodies.
        reference_depth=contacts[middle].approach - float(np.min(gaps[middle])),
    )


def _unworn(model: Model) -> dict[str, BodyState]:
    bodies = {}
    for name in model.case.bodies:
        wear = np.zeros((model.cycle.maps[name].rows, model.grid.cells[1]))
        plastic = model.cycle.maps[name].lay(np.zeros(model.grid.cells), model.cycle.middle)
        bodies[name] = BodyState(wear, plastic, first_law_state(model, name, wear))
    return bodies


def first_law_state(model: Model, name: str, wear: Array) -> dict[str, Array]:
    """Return the state of a body's law before any sliding, shaped as its `wear`."""
    first = model.laws.wear[name].own_state if name in model.laws.wear else {}
    return {field: np.full_like(wear, value) for field, value in first.items()}
