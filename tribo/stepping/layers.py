"""Layers of bodies: for how much of an increment each of them is what wears, at each point."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np
import scipy

from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.findings import Finding, layer_worn_through
from tribo.core.state import BodyState, State
from tribo.stepping.memory import Memory, at_surface
from tribo.stepping.rates import Moment, Rates, rates_at_each

if TYPE_CHECKING:
    from tribo.stepping.model import Model

REACHED = 1e-10
"""Part of a layer that may be left where it counts as worn through: rounding."""


def in_layers(
    model: Model,
    before: Memory,
    contacts: Sequence[ContactSolution],
    increment: float,
    moment: Moment,
) -> tuple[Memory, list[Rates]]:
    """Return `before` with the shares of an increment (m) that points spend in each layer.

    With it come the mean rates over it. At given pressures a point wears through a layer at that
    layer's rate and goes on at the next one's: with the mean rates, weighted with the shares, the
    depth is exact however long the increment. On a track it is that of the mean rates along it.
    """
    layered = {name: law.bottoms for name, law in model.laws.wear.items() if law.bottoms}

    def shared(shares: Mapping[str, Mapping[str, Array]]) -> tuple[Memory, list[Rates]]:
        memory = replace(before, shares=shares)
        return memory, rates_at_each(model, contacts, memory, moment)

    surface = {name: at_surface(bottoms, before.worn[name]) for name, bottoms in layered.items()}
    staying = shared(surface)
    if not layered:
        return staying
    lost = _depths(model, layered, staying[1])
    if all(_stays(layered[name], before.worn[name], lost[name] * increment) for name in layered):
        return staying
    found: dict[str, list[Array]] = {name: [] for name in layered}
    for layer in range(1 + max(map(len, layered.values()))):
        everywhere = shared(only(layer, layered, before.worn))[1]
        for name, rate in _depths(model, layered, everywhere).items():
            found[name].append(rate)
    return shared(
        {
            name: over_increment(bottoms, before.worn[name], found[name], increment)
            for name, bottoms in layered.items()
        }
    )


def _depths(model: Model, names: Iterable[str], rates: Sequence[Rates]) -> dict[str, Array]:
    """Return the depth per metre on each of some bodies, where it lies."""
    total = {}
    for name in names:
        depths = (
            place.share * model.cycle.maps[name].gather(of_bodies.wear[name].depth_rate, position)
            for position, (place, of_bodies) in enumerate(zip(model.cycle, rates, strict=True))
        )
        total[name] = reduce(np.add, depths)
    return total


def _stays(bottoms: Sequence[float], worn: Array, lost: Array) -> bool:
    """Whether no point passes from a layer to the next."""
    after = worn + lost
    return all(not np.any((worn < bottom) & (after >= bottom)) for bottom in bottoms)


def only(
    layer: int, layered: Mapping[str, Sequence[float]], worn: Mapping[str, Array]
) -> dict[str, dict[str, Array]]:
    """Return the shares where one layer, or what is below the last, is all that wears."""
    shares = {}
    for name, bottoms in layered.items():
        whole, here = np.ones_like(worn[name]), min(layer, len(bottoms))
        shares[name] = {f"rate {here}": whole, f"slope {here}": whole}
    return shares


def over_increment(
    bottoms: Sequence[float], worn: Array, rates: Sequence[Array], increment: float
) -> dict[str, Array]:
    """Return the shares of an increment spent in each layer, and those with which slopes count.

    Parameters
    ----------
    bottoms : sequence of float
        Depth of the bottom of each layer, in m; what is below the last has none.
    worn : ndarray
        Depth worn before, in m.
    rates : sequence of ndarray
        Depth per metre in each layer and in what is below, of the shape of `worn`.
    increment : float
        In m.

    Returns
    -------
    dict of ndarray
        ``"rate j"`` and ``"slope j"`` by layer, from the top. With R the rate of the layer that a
        point ends in, the depth changes by R/Rⱼ for each in layer j.
    """
    depth, left = worn, np.full_like(worn, increment)
    spent: list[Array] = []
    last = np.zeros_like(worn)
    for bottom, rate in zip((*bottoms, np.inf), rates, strict=False):
        inside = depth < bottom
        room = np.full_like(worn, np.inf)
        np.divide(bottom - depth, rate, out=room, where=rate > 0)
        taken = np.where(inside, np.minimum(left, room), 0.0)
        depth = np.where(inside & (room <= left), bottom, depth + taken * rate)
        left = left - taken
        last = np.where(taken > 0, rate, last)
        spent.append(taken / increment)
    shares = {}
    for layer, (share, rate) in enumerate(zip(spent, rates, strict=False)):
        shares[f"rate {layer}"] = share
        counts = np.divide(last, rate, out=np.ones_like(worn), where=rate > 0)
        shares[f"slope {layer}"] = share * counts
    return shares


def caps(model: Model, bodies: Mapping[str, BodyState]) -> Sequence[Array | None]:
    """Return the largest pressure at each point, in Pa, at each position; None where it is one."""
    if not model.contact.hardness:
        return [None] * len(model.cycle)
    each = [_hardness(model, bodies, position) for position in range(len(model.cycle))]
    return [np.minimum(*found.values()) for found in each]


def plastic_share(
    model: Model, bodies: Mapping[str, BodyState], name: str, position: int
) -> Array | float:
    """Return a body's part of what yields at a position: all where it is the softer one."""
    if not model.contact.hardness:
        return model.contact.plastic_share[name]
    found = _hardness(model, bodies, position)
    softest = np.minimum(*found.values())
    yielding = sum(np.asarray(each == softest, dtype=float) for each in found.values())
    return np.asarray((found[name] == softest) / yielding)


def _hardness(model: Model, bodies: Mapping[str, BodyState], position: int) -> dict[str, Array]:
    """Return the hardness of what is at each body's surface, shape (nx, ny), in Pa."""
    found = {}
    for name, hardness in model.contact.hardness.items():
        bottoms = model.laws.wear[name].bottoms if name in model.laws.wear else ()
        worn = np.broadcast_to(
            model.cycle.maps[name].see(bodies[name].wear, position), model.grid.cells
        )
        found[name] = np.array(hardness)[np.searchsorted(bottoms, worn, side="right")]
    return found


def worn_through(
    model: Model,
    before: State,
    after: Mapping[str, BodyState],
    increment: float,
    depths: Callable[[float], Mapping[str, Array]],
) -> Iterator[Finding]:
    """Yield a finding for each layer that a body's deepest point passes in a step.

    It has the time and distance at which that is, under the pressures of the step: `depths` are
    those that bodies lose over its first metres, in m.
    """
    for name, law in model.laws.wear.items():
        was, worn = before.bodies[name].wear, after[name].wear
        for layer, bottom in enumerate(law.bottoms, start=1):
            reached = bottom * (1 - REACHED)
            if not np.max(was) < reached <= np.max(worn):
                continue

            def beyond(first: float, name: str = name, reached: float = reached) -> float:
                lost = depths(first)[name] if first > 0 else 0.0
                return float(np.max(before.bodies[name].wear + lost)) - reached

            first = increment
            if beyond(increment) > 0:
                first = float(
                    scipy.optimize.brentq(beyond, 0.0, increment, xtol=REACHED * increment)
                )
            distance = before.distance + first
            passed = layer_worn_through(name, layer, bottom)
            yield passed.at(model.motion.time_at(distance), distance)
