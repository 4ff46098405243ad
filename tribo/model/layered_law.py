"""The law of a body in layers: each layer's law where the layer lies at the surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate

import numpy as np

from tribo.core.errors import CaseError
from tribo.core.fields import WORN_DEPTH, Field, LocalConditions, WearRate
from tribo.guards.guard import Guard
from tribo.guards.parts import GuardedLaw


class LayeredLaw(GuardedLaw):
    """Laws of layers, from the top; the last is the law of the body below.

    A law whose rate jumps at the depths worn where layers end. States belong to the point: they
    change by the law of the layer that wears, and a field of two laws continues from one to the
    other. Thicknesses, in m, are given for all but the last.
    """

    def __init__(self, laws: Sequence[GuardedLaw], thicknesses: Sequence[float]) -> None:
        below = laws[-1]
        Guard.__init__(self, below.component, below.body)
        self.laws = tuple(laws)
        self.material = below.material
        self.requires = tuple(dict.fromkeys(name for law in laws for name in law.requires))
        self.bottoms = tuple(accumulate(thicknesses))
        fields, self.initial_state = _state(laws)
        own = {each for law in laws for each in law.breaks}
        # Between its breaks it does so where a layer's own law does.
        self.follows_depth = any(law.follows_depth for law in laws)
        depth = replace(WORN_DEPTH, breaks=tuple(sorted({*self.bottoms, *own})))
        self.state_fields = (*fields, depth)
        self.initial_state[WORN_DEPTH.name] = 0.0

    def rate(self, local: LocalConditions) -> WearRate:
        """Return at each point the rate of the layer that is at the surface there."""
        layer_at = np.searchsorted(self.bottoms, local.state[WORN_DEPTH.name], side="right")
        depth, slope = np.zeros_like(local.pressure), np.zeros_like(local.pressure)
        changes = {name: np.zeros_like(local.pressure) for name in self.initial_state}
        for layer, law in enumerate(self.laws):
            here = layer_at == layer
            if not here.any():
                continue
            fields = {name: local.fields[name] for name in law.requires}
            state = {name: local.state[name] for name in law.initial_state}
            rate = law.rate(replace(local, material=law.material, fields=fields, state=state))
            depth[here], slope[here] = rate.depth_rate[here], rate.depth_slope[here]
            for name, change in rate.state_rates.items():
                changes[name][here] = change[here]
        return WearRate(depth, slope, {**changes, WORN_DEPTH.name: depth})


def _state(laws: Sequence[GuardedLaw]) -> tuple[tuple[Field, ...], dict[str, float]]:
    """Return the state fields of all laws and what they begin with, each name once."""
    first: dict[str, float] = {}
    for law in laws:
        for name, value in law.own_state.items():
            if first.setdefault(name, value) != value:
                raise CaseError(
                    f"laws of the layers begin with different values of {name!r}, which a "
                    "point has once whatever layer it is in; give them the same"
                )
    known = {field.name: field for law in reversed(laws) for field in law.state_fields}
    return tuple(known[name] for name in first), first
