"""Layers of bodies: for how much of an increment each of them is what wears, at each point."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.notices import Notice
from tribo.core.state import BodyState, State
from tribo.stepping.memory import Memory
from tribo.stepping.rates import Moment, wear_rates

if TYPE_CHECKING:
    from tribo.simulation.model import Model

REACHED = 1e-9
"""Part of a layer that may be left where it counts as worn through: rounding."""


def in_layers(
    model: Model,
    before: Memory,
    contacts: Sequence[ContactSolution],
    increment: float,
    moment: Moment,
) -> Memory:
    """Return `before` with the shares of an increment (m) that points spend in each layer.

    At given pressures a point wears through a layer at that layer's rate and goes on at the
    next one's: with the mean rates, weighted with the shares, the depth is exact however long
    the increment. On a track it is that of the mean rates along it.
    """
    layered = {name: law.bottoms for name, law in model.laws.items() if law.bottoms}
    if not layered:
        return before
    found: dict[str, list[Array]] = {name: [] for name in layered}
    for layer in range(1 + max(map(len, layered.values()))):
        everywhere = {
            name: only(min(layer, len(bottoms)), before.worn[name])
            for name, bottoms in layered.items()
        }
        alone = wear_rates(model, contacts, replace(before, shares=everywhere), moment)
        for name, rates in found.items():
            total = np.zeros_like(before.worn[name])
            for position, (place, of_bodies) in enumerate(zip(model.cycle, alone, strict=True)):
                depth = model.average(name, of_bodies[name].depth_rate, position)
                total = total + place.share * depth
            rates.append(total)
    shares = {
        name: over_increment(bottoms, before.worn[name], found[name], increment)
        for name, bottoms in layered.items()
    }
    return replace(before, shares=shares)


def only(layer: int, worn: Array) -> dict[str, Array]:
    """Return the shares where one layer is all that wears."""
    whole = np.ones_like(worn)
    return {f"rate {layer}": whole, f"slope {layer}": whole}


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


def worn_through(
    model: Model,
    before: State,
    after: Mapping[str, BodyState],
    memory: Memory,
    increment: float,
) -> Iterator[Notice]:
    """Yield a notice for each layer that a body's deepest point passes in a step.

    It has the time and distance at which that is, under the pressures of the step.
    """
    for name, shares in memory.shares.items():
        bottoms = model.laws[name].bottoms
        was, worn = before.bodies[name].wear, after[name].wear
        spent = np.zeros_like(worn)
        for layer, bottom in enumerate(bottoms):
            spent = spent + shares[f"rate {layer}"]
            reached = bottom * (1 - REACHED)
            if not np.max(was) < reached <= np.max(worn):
                continue
            distance = before.distance + increment * float(np.min(spent[worn >= reached]))
            time = model.motion.time_at(distance)
            yield Notice(
                "layer",
                f"layer {layer + 1} of {name}, down to {1e6 * bottom:.4g} µm, is worn through at "
                f"its deepest point after {distance:.6g} m, {time:.6g} s",
                time,
                distance,
                name,
                layer + 1,
            )
