"""The law of a body in layers: that of each layer where it lies at the surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError, PluginError
from tribo.core.fields import Field, LocalConditions, WearRate
from tribo.guards.guard import Guard
from tribo.guards.parts import GuardedLaw


class LayeredLaw(GuardedLaw):
    """Laws of layers, from the top, the last of which is that of the body below.

    It is told in the state which share of an increment each point spends in each layer. What laws
    remember belongs to the point: it changes by the law of the layer that wears, and a field that
    two of them have goes on from one to the other. Thicknesses, in m, are of all but the last.
    Where all laws know the means of their rates each gives that over the part spent in its layer.
    """

    def __init__(self, laws: Sequence[GuardedLaw], thicknesses: Sequence[float]) -> None:
        below = laws[-1]
        Guard.__init__(self, below.component, below.body)
        self.laws = tuple(laws)
        self.material = below.material
        self.requires = tuple(dict.fromkeys(name for law in laws for name in law.requires))
        self.state_fields, self.initial_state = _state(laws)
        self.bottoms = tuple(accumulate(thicknesses))
        self.advances = all(map(_knows_means, laws))
        self.steady_above = not any(law.initial_state for law in laws[:-1])

    def rate(self, local: LocalConditions, over: Array | float = 0.0) -> WearRate:
        """Return the rates of the layers, weighted with their shares; see `GuardedLaw.rate`."""
        depth, slope = np.zeros_like(local.pressure), np.zeros_like(local.pressure)
        changes = {name: np.zeros_like(local.pressure) for name in self.initial_state}
        now = {name: local.state[name] for name in self.initial_state}
        for layer, law in enumerate(self.laws):
            share = local.state.get(f"rate {layer}")
            if share is None or not share.any():
                continue
            fields = {name: local.fields[name] for name in law.requires}
            state = {name: now[name] for name in law.initial_state}
            told = replace(local, material=law.material, fields=fields, state=state)
            if self.advances and over:
                # What counts for nothing is over some length all the same.
                rate = law.rate(told, over * np.where(share > 0, share, 1.0))
            else:
                rate = law.rate(told)
            depth = depth + share * rate.depth_rate
            slope = slope + local.state[f"slope {layer}"] * rate.depth_slope
            for name, change in rate.state_rates.items():
                changes[name] = changes[name] + share * change
                if self.advances and over:
                    # A point comes to the next layer with what it remembers of this one.
                    now[name] = now[name] + over * share * change
        return WearRate(depth, slope, changes)


def _knows_means(law: GuardedLaw) -> bool:
    """Whether a law knows the mean of its rate over a part that each point has of its own."""
    if not law.advances:
        return not law.initial_state
    state = {name: np.full((1, 2), value) for name, value in law.initial_state.items()}
    pressed = LocalConditions(np.ones((1, 2)), 1.0, law.material, {}, state)
    over = np.array([[1.0, 2.0]])
    try:
        known = law.ask(law.component.advance, pressed, over) is not None
        law.rate(pressed, over)
    except PluginError:
        # One that takes a single number is integrated.
        return False
    return known


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
