"""The contacts of a cycle, solved together where the solver can."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    CycleCompliance,
    WearCompliance,
)
from tribo.core.state import BodyState, State
from tribo.evolution.states import filling, remembered
from tribo.evolution.yielding import caps

if TYPE_CHECKING:
    from tribo.model.model import Model

MIRRORED = 1e-12
"""Relative difference below which two positions mirror each other: rounding."""


def solve_cycle(
    model: Model,
    gaps: Iterable[Array],
    load: float,
    starts: Sequence[ContactSolution],
    bodies: Mapping[str, BodyState],
    wear: Sequence[WearCompliance] | CycleCompliance | None = None,
) -> list[ContactSolution]:
    """Solve the contact at each position of a cycle, from gaps of shape (nx, ny), in m.

    `load` is in N, and `wear` is from `linear_wear`; the layers that `bodies` are worn down to
    limit the pressure. Where the positions are solved together and each mirrors another along x, as
    on a stroke of smooth bodies, half of them are solved.
    """
    coupling = None
    alone: Sequence[WearCompliance | None] = [None] * len(model.cycle)
    if isinstance(wear, CycleCompliance):
        coupling = wear
    elif wear is not None:
        alone = wear
    problems = [
        ContactProblem(model.contact.system, gap, load, own, cap)
        for gap, own, cap in zip(gaps, alone, caps(model, bodies), strict=True)
    ]
    if not (model.couples and _all_mirror(problems, coupling)):
        return model.contact.solver.solve_cycle(problems, starts, coupling)
    half = len(problems) // 2 + 1
    one_side = None if coupling is None else _one_side(coupling, half)
    *left, middle = model.contact.solver.solve_cycle(problems[:half], starts[:half], one_side)
    return [*left, _symmetric(middle), *map(_mirrored, reversed(left))]


def extrapolated(state: State) -> Sequence[ContactSolution]:
    """Return contacts to start solves from, with pressures that change as in the last step."""
    if not state.previous:
        return state.contacts
    starts = []
    for contact, before in zip(state.contacts, state.previous, strict=True):
        # Before a jump the load was another.
        share = float(np.sum(contact.pressure)) / float(np.sum(before))
        pressure = np.maximum(2 * contact.pressure - share * before, 0.0)
        starts.append(replace(contact, pressure=pressure))
    return starts


def undeformed(model: Model, state: State) -> Array:
    """Return the gap at each position, worn, plastically deformed and filled, in m.

    Shape (positions, nx, ny).
    """
    removed = seen(model, {name: body.wear + body.plastic for name, body in state.bodies.items()})
    return np.stack(model.contact.gaps) + removed - filling(model, remembered(model, state))


def seen(model: Model, of_bodies: Mapping[str, Array]) -> Array:
    """Return the sum of the bodies' fields at each position, (positions, nx, ny)."""
    maps, none = model.cycle.maps, np.zeros(model.grid.cells)
    here = (
        sum((maps[name].see(field, position) for name, field in of_bodies.items()), none)
        for position in range(len(model.cycle))
    )
    return np.stack([*here])


def counted(state: State, contacts: Sequence[ContactSolution]) -> State:
    """Return `state` with the solves of the contacts of a cycle counted."""
    # Those that mirror others took no iterations.
    iterations = [contact.iterations for contact in contacts if contact.iterations > 0]
    return replace(
        state,
        contact_solves=state.contact_solves + len(iterations),
        solver_iterations=state.solver_iterations + sum(iterations),
    )


def solved_anew(model: Model, state: State, load: float) -> State:
    """Return `state` with its contacts solved under another load (N), without wear."""
    gaps = undeformed(model, state)
    contacts = solve_cycle(model, gaps, load, state.contacts, state.bodies)
    model.listener.solved(contacts)
    return replace(counted(state, contacts), contacts=tuple(contacts), rates=())


def _all_mirror(problems: Sequence[ContactProblem], coupling: CycleCompliance | None) -> bool:
    """Whether each position mirrors another along x, and the middle one itself."""
    half = len(problems) // 2 + 1
    mirrored = len(problems) % 2 == 1 and all(
        _mirrors(one.gap, other.gap)
        and (one.cap is None or other.cap is None or _mirrors(one.cap, other.cap))
        for one, other in zip(problems[:half], reversed(problems), strict=False)
    )
    return mirrored and (coupling is None or _bodies_mirror(coupling))


def _bodies_mirror(coupling: CycleCompliance) -> bool:
    """Whether two positions that mirror each other wear alike, and lie so on the bodies."""
    shares = coupling.shares
    if np.max(np.abs(shares - shares[::-1])) > MIRRORED:
        return False
    for compliance, cells in coupling.bodies:
        rows = len(compliance)
        beyond = rows - (coupling.rows.stop - coupling.rows.start)
        pairs = zip(cells, reversed(cells), strict=True)
        if not _mirrors(compliance, compliance) or any(
            (a + b - beyond) % rows or across != other for (a, across), (b, other) in pairs
        ):
            return False
    return True


def _mirrors(field: Array, other: Array) -> bool:
    least = MIRRORED * float(np.max(np.abs(field)))
    return bool(np.max(np.abs(field[::-1] - other)) <= least)


def _one_side(coupling: CycleCompliance, half: int) -> CycleCompliance:
    shares = coupling.shares[:half].copy()
    # The middle position mirrors itself.
    shares[-1] *= 0.5
    bodies = [(compliance, cells[:half]) for compliance, cells in coupling.bodies]
    return replace(coupling, shares=shares, bodies=bodies, mirrored=True)


def _mirrored(contact: ContactSolution) -> ContactSolution:
    return replace(
        contact,
        pressure=readonly(contact.pressure[::-1].copy()),
        overlap=readonly(contact.overlap[::-1].copy()),
        iterations=0,
    )


def _symmetric(contact: ContactSolution) -> ContactSolution:
    """Return the mean of a contact and its mirror image, which removes rounding errors."""
    pressure = 0.5 * (contact.pressure + contact.pressure[::-1])
    overlap = 0.5 * (contact.overlap + contact.overlap[::-1])
    return replace(contact, pressure=readonly(pressure), overlap=readonly(overlap))
