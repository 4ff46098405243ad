"""Differences between the fields of two results at one time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from tribo.result.quantity import interpolated
from tribo.result.read import Result


class Difference(NamedTuple):
    """Difference of a field f from the reference's field f₀, relative to f₀."""

    l2: float
    """√(Σ(f − f₀)²/Σf₀²)."""
    largest: float
    """Largest magnitude of f − f₀ over the largest magnitude of f₀."""


def differences(result: Result, reference: Result, time: float) -> dict[str, Difference]:
    """Return the differences of pressure and wear depths from the reference, by field, at a save.

    Fields are ``"pressure"`` and ``"bodies.NAME.wear_depth"``, without those that are zero in the
    reference. The norms run over the reference's cells in both windows; values of another grid are
    interpolated linearly there.
    """
    saves = [(each, each.save_at(time)) for each in (result, reference)]
    pairs = {"pressure": [each.field("pressure", save) for each, save in saves]}
    for name in reference.body_names:
        depths = [each.field("wear_depth", save, name) for each, save in saves]
        pairs[f"bodies.{name}.wear_depth"] = depths
    found = {}
    for name, (values, expected) in pairs.items():
        if result.grid != reference.grid:
            values = interpolated(values, result.grid.spacing, *reference.grid.mesh)
            inside = np.isfinite(values)
            values, expected = values[inside], expected[inside]
        largest = float(np.max(np.abs(expected), initial=0.0))
        if largest > 0:
            # Squares of small depths may underflow, so scale first.
            off, expected = (values - expected) / largest, expected / largest
            found[name] = Difference(
                l2=float(np.sqrt(np.sum(off**2) / np.sum(expected**2))),
                largest=float(np.max(np.abs(off))),
            )
    return found
