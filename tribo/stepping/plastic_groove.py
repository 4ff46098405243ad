"""Plastic depth: the yielding in contact, and the groove that it leaves along a track."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.contact import ContactSolution
from tribo.core.errors import NumericalError
from tribo.core.state import BodyState, State
from tribo.evolution.yielding import plastic_share
from tribo.stepping.contacts import solved_anew

if TYPE_CHECKING:
    from tribo.model.model import Model

# Each pass is one warm solve; a groove in a much softer body takes over a thousand.
SETTLE_PASSES = 5000
SETTLED = 1e-6
"""Growth in a pass, over the depth, of a groove at rest: four digits are printed."""


def yields(contacts: Sequence[ContactSolution]) -> bool:
    """Whether the bodies yield at any position."""
    return any(np.any(contact.overlap > 0) for contact in contacts)


def yielded(
    model: Model,
    bodies: Mapping[str, BodyState],
    contacts: Sequence[ContactSolution],
    places: Sequence[int],
) -> dict[str, BodyState]:
    """Return the bodies after yielding at some positions, counted once where these overlap."""
    if not yields(contacts):
        return dict(bodies)
    model.listener.yielded(places)
    found = {}
    for name, body in bodies.items():
        overlaps = (
            plastic_share(model, bodies, name, position) * contacts[position].overlap
            for position in places
        )
        own = (model.cycle.maps[name].lay(*each) for each in zip(overlaps, places, strict=True))
        found[name] = replace(body, plastic=body.plastic + reduce(np.maximum, own))
    return found


def settled(model: Model, state: State, load: float) -> State:
    """Draw grooves out along the track and re-solve until nothing yields any more."""
    drawn_out = any(
        name in model.cycle.swept and np.any(body.plastic > 0)
        for name, body in state.bodies.items()
    )
    # What yields at one position alters the others, whichever body it is.
    if not drawn_out and not (len(model.cycle) > 1 and yields(state.contacts)):
        return state
    for _ in range(SETTLE_PASSES):
        model.listener.drawn({name: body.plastic for name, body in state.bodies.items()})
        drawn = {}
        for name, body in state.bodies.items():
            envelope = model.cycle.maps[name].envelope(body.plastic)
            plastic = np.array(np.broadcast_to(envelope, body.plastic.shape))
            drawn[name] = replace(body, plastic=plastic)
        state = solved_anew(model, replace(state, bodies=drawn), load)
        deepest = max(float(np.max(body.plastic)) for body in drawn.values())
        still = max(float(np.max(contact.overlap)) for contact in state.contacts)
        if still <= SETTLED * deepest:
            return state
        everywhere = range(len(state.contacts))
        state = replace(state, bodies=yielded(model, drawn, state.contacts, everywhere))
    raise NumericalError(
        f"at {state.distance:.6g} m the groove still yields after {SETTLE_PASSES} passes of the "
        f"contact, by {still:.2g} m a pass, under {load:g} N at a hardness of "
        f"{1e-9 * (model.contact.system.cap or 0):g} GPa; lower load.normal, or set "
        "contact.plasticity = false"
    )
