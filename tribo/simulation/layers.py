"""The law of a body in layers: that of each layer where it lies at the surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate

import numpy as np

from tribo.core.fields import LocalConditions, WearRate
from tribo.simulation.guard import Guard
from tribo.simulation.guards import GuardedLaw


class LayeredLaw(GuardedLaw):
    """Laws of layers, from the top, the last of which is that of the body below.

    It is told in the state which share of an increment each point spends in each layer.

    Parameters
    ----------
    laws : sequence of GuardedLaw
        Each with its own material.
    thicknesses : sequence of float
        Of all but the last, in m.
    """

    def __init__(self, laws: Sequence[GuardedLaw], thicknesses: Sequence[float]) -> None:
        below = laws[-1]
        Guard.__init__(self, below.component, below.body)
        self.laws = tuple(laws)
        self.material = below.material
        self.requires = tuple(dict.fromkeys(name for law in laws for name in law.requires))
        self.state_fields = ()
        self.initial_state = {}
        self.bottoms = tuple(accumulate(thicknesses))

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the rates of the layers, weighted with their shares; see `GuardedLaw.rate`."""
        depth, slope = np.zeros_like(local.pressure), np.zeros_like(local.pressure)
        for layer, law in enumerate(self.laws):
            share = local.state.get(f"rate {layer}")
            if share is None or not share.any():
                continue
            fields = {name: local.fields[name] for name in law.requires}
            here = replace(local, material=law.material, fields=fields, state={})
            rate = law.rate(here)
            depth = depth + share * rate.depth_rate
            slope = slope + local.state[f"slope {layer}"] * rate.depth_slope
        return WearRate(depth, slope)
