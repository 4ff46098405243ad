"""The hardness at the surface of bodies, and which of them yields."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array
from tribo.core.state import BodyState

if TYPE_CHECKING:
    from tribo.model.model import Model


def caps(model: Model, bodies: Mapping[str, BodyState]) -> Sequence[Array | None]:
    """Return the largest pressure at each point, in Pa, at each position; None where it is one."""
    if not model.contact.hardness:
        return [None] * len(model.cycle)
    each = [_hardness(model, bodies, position) for position in range(len(model.cycle))]
    return [np.minimum(*found.values()) for found in each]


def plastic_share(
    model: Model, bodies: Mapping[str, BodyState], name: str, position: int
) -> Array | float:
    """Return a body's part of the plastic overlap at a position: all where it is softer."""
    if not model.contact.hardness:
        return model.contact.plastic_share[name]
    found = _hardness(model, bodies, position)
    softest = np.minimum(*found.values())
    yielding = sum(np.asarray(each == softest, dtype=float) for each in found.values())
    return np.asarray((found[name] == softest) / yielding)


def _hardness(model: Model, bodies: Mapping[str, BodyState], position: int) -> dict[str, Array]:
    """Return the hardness at each body's surface, shape (nx, ny), in Pa."""
    found = {}
    for name, hardness in model.contact.hardness.items():
        bottoms = model.laws.wear[name].bottoms if name in model.laws.wear else ()
        worn = np.broadcast_to(
            model.cycle.maps[name].see(bodies[name].wear, position), model.grid.cells
        )
        found[name] = np.array(hardness)[np.searchsorted(bottoms, worn, side="right")]
    return found
