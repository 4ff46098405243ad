"""The law of a body in layers: that of each layer where it lies at the surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate

import numpy as np

from tribo.core.errors import CaseError
from tribo.core.fields import Field, LocalConditions, WearRate
from tribo.simulation.guard import Guard
from tribo.simulation.guards import GuardedLaw


class LayeredLaw(GuardedLaw):
    """Laws of layers, from the top, the last of which is that of the body below.

    It is told in the state which share of an increment each point spends in each layer. What laws
    remember belongs to the point: it changes by the law of the layer that wears, and a field that
    two of them have goes on from one to the other. Thicknesses, in m, are of all but the last.
    """

    def __init__(self, laws: Sequence[GuardedLaw], thicknesses: Sequence[float]) -> None:
        below = laws[-1]
        Guard.__init__(self, below.component, below.body)
        self.laws = tuple(laws)
        self.material = below.material
        self.requires = tuple(dict.fromkeys(name for law in laws for name in law.requires))
        self.state_fields, self.initial_state = _state(laws)
        self.bottoms = tuple(accumulate(thicknesses))

    def rate(self, local: LocalConditions, over: float = 0.0) -> WearRate:
        """Return the rates of the layers, weighted with their shares; see `GuardedLaw.rate`."""
        depth, slope = np.zeros_like(local.pressure), np.zeros_like(local.pressure)
        changes = {name: np.zeros_like(local.pressure) for name in self.initial_state}
        for layer, law in enumerate(self.laws):
            share = local.state.get(f"rate {layer}")
            if share is None or not share.any():
                continue
            fields = {name: local.fields[name] for name in law.requires}
            state = {name: local.state[name] for name in law.initial_state}
            rate = law.rate(replace(local, material=law.material, fields=fields, state=state))
            depth = depth + share * rate.depth_rate
            slope = slope + local.state[f"slope {layer}"] * rate.depth_slope
            for name, change in rate.state_rates.items():
                changes[name] = changes[name] + share * change
        return WearRate(depth, slope, changes)


def _state(laws: Sequence[GuardedLaw]) -> tuple[tuple[Field, ...], dict[str, float]]:
    """Return the state fields of all laws and what they begin with, each name once."""
    fields: dict[str, Field] = {}
    first: dict[str, float] = {}
    for law in laws:
        for field in law.state_fields:
            fields.setdefault(field.name, field)
            if (
                first.setdefault(field.name, law.initial_state[field.name])
                != (law.initial_state[field.name])
            ):
                raise CaseError(
                    f"laws of the layers begin with different values of {field.name!r}, which a "
                    "point has once whatever layer it is in; give them the same"
                )
    return tuple(fields.values()), first
