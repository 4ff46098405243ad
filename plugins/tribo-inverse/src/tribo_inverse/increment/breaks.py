"""Depths at which the rate of a law jumps, such as the bottoms of layers, moved by a number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from tribo import WORN_DEPTH, LocalConditions, WearRate
from tribo.kernel_api import GuardedLaw, Model

from tribo_inverse.recording.local import replaced


def sided(law: GuardedLaw, breaks: Sequence[float]) -> GuardedLaw:
    """Return a law whose rate jumps at other depths.

    Its input is the depth, clipped to lie between the corresponding two breaks of its own.
    """
    own = np.array([-np.inf, *law.breaks, np.inf])

    def rate(local: LocalConditions) -> WearRate:
        depth = local.state[WORN_DEPTH.name]
        at = np.searchsorted(breaks, depth, side="right")
        told = np.clip(depth, own[at], np.nextafter(own[at + 1], -np.inf))
        return law.rate(replace(local, state={**local.state, WORN_DEPTH.name: told}))

    fields = tuple(
        replace(each, breaks=tuple(breaks)) if each.name == WORN_DEPTH.name else each
        for each in law.state_fields
    )
    bottoms = tuple(breaks) if law.bottoms else ()
    return replaced(law, rate=rate, state_fields=fields, bottoms=bottoms)


def other_breaks(model: Model) -> list[tuple[float, ...]]:
    """Return the breaks of states other than the bottoms of layers."""
    of_laws = (
        field.breaks
        for law in model.laws.wear.values()
        for field in law.state_fields
        if law.follows_depth or field.name != WORN_DEPTH.name
    )
    return [*of_laws, *(field.breaks for _, field in model.laws.between.values())]


def with_breaks(model: Model, base: Model) -> Model:
    """Return a model whose laws jump at the breaks of the base."""
    laws = {
        name: sided(law, base.laws.wear[name].breaks)
        for name, law in model.laws.wear.items()
        if law.breaks != base.laws.wear[name].breaks
    }
    return model.with_laws({**model.laws.wear, **laws}) if laws else model
