"""What the positions of a cycle miss of the wear between them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tribo.core.state import State

if TYPE_CHECKING:
    from tribo.model.model import Model


def cycle_error(model: Model, state: State) -> float:
    """Return the estimated error of the depths, as the cycle has no more positions than it has.

    It is the mean over the contact, weighted with the load, relative to the body's deepest wear, of
    the body where that is most; 0 where the cycle has every cell, or is not resolved.
    """
    worst = 0.0
    for name, body in state.bodies.items():
        deepest = float(np.max(body.wear))
        if body.missed is None or deepest <= 0:
            continue
        off = load = 0.0
        for position, contact in enumerate(state.contacts):
            share = model.cycle[position].share
            missed = np.abs(model.cycle.maps[name].see(body.missed, position))
            off += share * float(np.sum(contact.pressure * missed))
            load += share * float(np.sum(contact.pressure))
        worst = max(worst, off / load / deepest)
    return worst
