"""Error control of steps: the errors of a step, and the length of the next."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, union
from tribo.core.rounding import ROUND_OFF
from tribo.core.state import State
from tribo.evolution.measure import loaded_mean

if TYPE_CHECKING:
    from tribo.model.model import Model

FIRST = 0.05
"""Part of the first approach, below which wear does not alter the contact."""
VOLUME = 5.0
"""Error of the volume that a step wears, in depth tolerances: a body ends with 0.1 to 0.4 % too
little at the default."""
LATE = 0.003
"""Depth of a step over the depth worn so far, below which its volume need not be as exact."""
SAFETY = 0.9
"""As usual for the control of steps: Hairer, Nørsett & Wanner (1993), section II.4."""
SHRINK, GROW = 0.2, 2.5
"""Least and largest change of a step's length, from the same section."""


def step_errors(
    model: Model,
    before: State,
    after: State,
    forward: Mapping[str, Array],
    depth_tolerance: float,
    pressure_tolerance: float,
) -> tuple[float, float, float]:
    """Return a step's errors of depth and volume and its change of pressure, over their tolerances.

    The local error of backward Euler in depth is half the difference between
    its wear and forward Euler's. It is weighted with the load, since the
    largest difference is always at newly touched edge cells, and compared
    with the depth worn so far (and a part of the first approach, below which
    wear does not alter the contact).

    Where a body wore too little in depth, the load shifts there and corrects
    it: errors of depth do not add up. Errors of volume add up, with one sign,
    for a law that is not linear in pressure or has a state. So the error of
    the volume is compared with the volume that the step itself wears. A load
    that effects change is held over the step, which misses half of its change.

    The pressure lags by about a quarter of the relative increment of distance. So its
    load-weighted relative change Σ|Δp|/Σp limits the next step; the step itself may stay, whose
    depth has an error of its own, and of whose change on a coarse grid much is cells that touch.
    """
    contacts, shares = after.contacts, [position.share for position in model.cycle]
    load = change = 0.0
    for share, contact, was in zip(shares, contacts, before.contacts, strict=True):
        here = union(contact.extent, was.extent)
        pressure = contact.pressure[here]
        load += share * float(np.sum(pressure))
        change += share * float(np.sum(np.abs(pressure - was.pressure[here])))
    drift = abs(after.load_factor / before.load_factor - 1)
    depth_error = volume_error = 0.0
    for name, explicit in forward.items():
        worn = after.bodies[name].wear - before.bodies[name].wear
        lag = worn - explicit
        scale = float(np.max(after.bodies[name].wear)) + FIRST * after.reference_depth
        # Flat bodies that have not begun to wear have neither.
        scale = scale or float(np.finfo(np.float64).tiny)
        late = loaded_mean(
            model, contacts, [model.cycle.maps[name].see(lag, m) for m in range(len(shares))]
        )
        depth_error = max(depth_error, 0.5 * late / scale)
        own = 0.5 * (worn + explicit)
        if np.any(own > 0):
            share = min(1.0, float(np.max(own)) / (LATE * scale))
            missed = abs(float(np.sum(worn)) - float(np.sum(explicit))) / float(np.sum(own))
            # What points that pass a break lag behind is mended too: their load goes elsewhere.
            missed = drift if model.laws.wear[name].breaks else missed + drift
            volume_error = max(volume_error, 0.5 * share * missed)
    return (
        depth_error / depth_tolerance,
        volume_error / (VOLUME * depth_tolerance),
        change / load / pressure_tolerance,
    )


def increment_factor(depth: float, volume: float, pressure: float) -> float:
    """Return the factor for the next increment, by the errors of a step."""
    # The depth error of a step grows as its square, the two others in proportion.
    wanted = SAFETY * min(
        1 / math.sqrt(depth) if depth > 0 else math.inf,
        1 / pressure if pressure > 0 else math.inf,
        1 / volume if volume > 0 else math.inf,
    )
    return min(GROW, max(SHRINK, wanted))


def next_increment(natural: float, remaining: float, last: float) -> float:
    """Return the next increment with `remaining` metres to go.

    Increments are halved down to `last` metres, which lets the pressure catch up with the wear.
    """
    increment = min(natural, max(0.5 * remaining, last)) if last else natural
    if remaining <= increment * (1 + ROUND_OFF):
        return remaining
    # Two equal steps rather than a full one and a sliver.
    return 0.5 * remaining if remaining < 2 * increment else increment
