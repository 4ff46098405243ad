"""Points that pass from layer to layer within an increment, differentiated backwards."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass

import numpy as np
from tribo import Array
from tribo.kernel_api import GuardedLaw, Model, over_increment

from tribo_inverse.adjoint.response import Arrays, Field


@dataclass(frozen=True)
class Layered:
    """A body in layers as an increment (m) begins: its depth worn, and its rate in each layer."""

    bottoms: Sequence[float]
    worn: Array
    rates: Arrays
    increment: float

    def back(self, seeds: Sequence[Field]) -> tuple[Array, Arrays, list[Array]]:
        """Return derivatives in the depth, the rates and the bottoms, from those in the shares.

        Those in the bottoms are still by point. None is a difference: a point that lies just above
        a bottom has a part in that layer, however small, and the derivative of one that passes.
        """
        shares = over_increment(self.bottoms, self.worn, self.rates, self.increment)
        spent = [shares[f"rate {layer}"] for layer in range(len(self.rates))]
        worn = np.zeros_like(self.worn)
        rates = [np.zeros_like(self.worn) for _ in spent]
        bottoms = [np.zeros_like(self.worn) for _ in self.bottoms]
        # What a layer takes longer is missing in the one that a point ends in.
        ended, end = np.zeros(self.worn.shape, dtype=bool), np.zeros_like(self.worn)
        for layer in reversed(range(len(spent))):
            enters, seed = spent[layer] > 0, np.broadcast_to(seeds[layer], self.worn.shape)
            passes = enters & ended
            # The derivative in how far it is to the bottom.
            far = np.zeros_like(self.worn)
            np.divide((seed - end) / self.increment, self.rates[layer], out=far, where=passes)
            rates[layer] = -far * spent[layer] * self.increment
            if layer < len(bottoms):
                bottoms[layer] = bottoms[layer] + far
            above = enters & (self.worn < self.bottoms[layer - 1]) if layer else False
            if layer:
                bottoms[layer - 1] = -far * above
            worn = worn - far * ~np.asarray(above)
            end = np.where(enters & ~ended, seed, end)
            ended |= enters
        return worn, rates, bottoms


def by_bottoms(shares: Mapping[str, Array]) -> list[Array]:
    """Return what a depth follows the bottom of each layer by, from the shares of an increment."""
    spent, counts = (
        [shares[f"{kind} {layer}"] for layer in range(len(shares) // 2)]
        for kind in ("rate", "slope")
    )
    gains = [
        np.where(share > 0, 1 - count / np.where(share > 0, share, 1.0), 0.0)
        for share, count in zip(spent, counts, strict=True)
    ]
    return [
        np.where(share > 0, gain - below, 0.0)
        for share, gain, below in zip(spent, gains, gains[1:], strict=False)
    ]


def lowered(model: Model, base: Model, name: str) -> list[float]:
    """Return by how much the bottoms of a body's layers lie deeper in a model, in m."""
    own, others = base.laws.wear[name].bottoms, model.laws.wear[name].bottoms
    return [other - bottom for bottom, other in zip(own, others, strict=True)]


def with_bottoms(model: Model, base: Model, names: Sequence[str]) -> dict[str, GuardedLaw]:
    """Return laws of a model whose layers end where those of the base do."""
    laws = {}
    for name in names:
        laws[name] = copy(model.laws.wear[name])
        laws[name].bottoms = base.laws.wear[name].bottoms
    return laws
