"""Points that pass from layer to layer within an increment, differentiated backwards."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.stepping.layers import over_increment
from tribo.study.gradient.response import Arrays, Field

FINE = 1e-6
"""Part of the largest depth or rate by which it is varied."""


@dataclass(frozen=True)
class Layered:
    """A body in layers as an increment (m) begins: its depth worn, and its rate in each layer."""

    bottoms: Sequence[float]
    worn: Array
    rates: Arrays
    increment: float

    def back(self, seeds: Sequence[Field]) -> tuple[Array, Arrays]:
        """Return derivatives in the depth and the rates, from those in the shares of the layers."""
        found = []
        given = [self.worn, *self.rates]
        for at, values in enumerate(given):
            by = FINE * (float(np.max(np.abs(values))) or self.bottoms[-1])
            up, down = (
                self._shares([*given[:at], values + sign * by, *given[at + 1 :]])
                for sign in (1, -1)
            )
            changes = [one - other for one, other in zip(up, down, strict=True)]
            pairs = zip(seeds, changes, strict=True)
            found.append(np.sum([seed * change for seed, change in pairs], axis=0) / (2 * by))
        worn, *rates = found
        return worn, rates

    def _shares(self, given: Arrays) -> Arrays:
        worn, *rates = given
        shares = over_increment(self.bottoms, worn, rates, self.increment)
        return [shares[f"rate {layer}"] for layer in range(len(rates))]
