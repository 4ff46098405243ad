"""States within their limits, and how fast they relax."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array

NUDGE = 1e-6
"""Part of a state by which it is moved to find how fast it relaxes."""
SMALL = 1e-4
"""Rise below which the derivative of its mean is that of its series."""

Values = list[Array]
Rates = Callable[[Sequence[Array], float, float], Values]


@dataclass(frozen=True)
class Limits:
    """What one state may be, what messages call it, and whether it may relax within a step."""

    least: float
    most: float
    name: str
    relaxes: bool = True


def relaxed(rise: Array | float) -> Array:
    """Return the mean of a rate that changes e-fold exp(rise) over a step: (exp(rise) − 1)/rise."""
    rise = np.asarray(rise)
    return np.divide(np.expm1(rise), rise, out=np.ones_like(rise), where=rise != 0)


def lasting(step: float, slope: Array | float) -> Array | float:
    """Return how much a step counts for where the rate follows its own state by this slope."""
    return step * relaxed(step * slope) if np.any(slope) else step


def bending(step: float, slope: Array | float) -> Array | float:
    """Return the derivative of `lasting` in the slope."""
    if not np.any(slope):
        return 0.0
    rise = np.asarray(step * slope)
    small = np.abs(rise) < SMALL
    safe = np.where(small, 1.0, rise)
    return step**2 * np.where(small, 0.5 + rise / 3, (np.exp(safe) - relaxed(safe)) / safe)


def relaxing(
    rates: Rates,
    states: Sequence[Array],
    first: Sequence[Array],
    length: float,
    limits: Sequence[Limits],
) -> list[Array | float]:
    """Return how the rate of each state changes with itself, where that is downwards."""
    found: list[Array | float] = []
    for index, (state, rate, limit) in enumerate(zip(states, first, limits, strict=False)):
        largest = max(float(np.max(np.abs(state))), length * float(np.max(np.abs(rate))))
        if largest == 0 or not limit.relaxes:
            found.append(0.0)
            continue
        moved = state + NUDGE * largest
        moved = np.where(moved > limit.most, state - NUDGE * largest, moved)
        nudged = rates([*states[:index], moved, *states[index + 1 :]], 0.0, 1.0)[index]
        found.append(np.minimum((nudged - rate) / (moved - state), 0.0))
    return found
