"""A state as effects and observers see it: with its scalars and the fields of effects."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import prod
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, view
from tribo.core.contact import ContactSolution
from tribo.core.measures import (
    BodyMeasures,
    Measures,
    centre,
    contact_area,
    half_widths,
)
from tribo.core.state import Snapshot, State
from tribo.evolution.friction import friction_force
from tribo.evolution.local_fields import effect_fields
from tribo.evolution.yielding import caps

if TYPE_CHECKING:
    from tribo.model.model import Model


def with_effects(model: Model, snapshot: Snapshot) -> Snapshot:
    """Return a snapshot with the fields of effects."""
    if snapshot.effects:
        return snapshot
    return replace(snapshot, effects=effect_fields(model, snapshot.state))


def load_factor(model: Model, state: State) -> float:
    """Return the load factor by effects at `state`."""
    effects = [effect for effect in model.laws.effects if effect.changes_load]
    if not effects:
        return state.load_factor
    snapshot = view(with_effects(model, Snapshot(state, measure(model, state))))
    return prod(each.load_factor(snapshot) for each in effects)


def measure(model: Model, state: State) -> Measures:
    """Return the scalars of `state` that are recorded at every step."""
    pressure = state.contact.pressure
    extent = state.contact.extent
    touched = pressure[extent]
    own = caps(model, state.bodies)[len(model.cycle) // 2]
    cap = model.contact.system.cap if own is None else own[extent]
    load = model.loads(state).before(state.time)
    friction = friction_force(model, state)
    width, breadth = half_widths(state.contact, model.grid)
    bodies = {
        name: BodyMeasures(
            max_wear_depth=float(np.max(body.wear)),
            centre_wear_depth=centre(body.wear),
            wear_volume=model.cycle.maps[name].volume(body.wear),
            max_plastic_depth=float(np.max(body.plastic)),
        )
        for name, body in state.bodies.items()
    }
    return Measures(
        time=state.time,
        distance=state.distance,
        load=load,
        load_distance=state.load_distance,
        friction_force=friction,
        friction_energy=np.nan if np.isnan(friction) else state.friction_energy,
        max_pressure=float(np.max(touched)),
        centre_pressure=centre(pressure),
        half_width_x=width,
        half_width_y=breadth,
        area=contact_area(touched, model.grid),
        # At the cap.
        plastic_area=0.0 if cap is None else contact_area(touched >= cap, model.grid),
        approach=state.contact.approach - model.contact.closest,
        residuals=state.contact.residuals,
        contact_solves=state.contact_solves,
        solver_iterations=state.solver_iterations,
        bodies=bodies,
        invariants=state.invariants,
    )


def loaded_mean(
    model: Model, contacts: Sequence[ContactSolution], arrays: Iterable[Array]
) -> float:
    """Return the mean size over a cycle of arrays, one for each position, weighted by the load."""
    weighed = load = 0.0
    for position, contact, array in zip(model.cycle, contacts, arrays, strict=True):
        here = contact.extent
        pressure = contact.pressure[here]
        array = np.broadcast_to(array, contact.pressure.shape)[here]
        weighed += position.share * float(np.sum(pressure * np.abs(array)))
        load += position.share * float(np.sum(pressure))
    return weighed / load
