"""How fast states relax, what an Euler step counts for where they do; and the derivatives."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from tribo.core.arrays import Array
from tribo.integration.kept import Field, Kept, Values

Rates = Callable[[Sequence[Array], float], Values]
"""Rates of states, and after them of sums, at states and at a share of a part."""

NUDGE = 3e-5
"""Part of a state by which it is moved to find how fast it relaxes, and how that changes."""
SMALL = 1e-4
"""Rise below which the derivative of its mean is that of its series."""


def growth(span: Field, slope: Field) -> Field:
    """Return the derivative of `lasting` in the span."""
    return np.exp(slope * np.asarray(span)) if np.any(slope) else 1.0


def relaxed(rise: Field) -> Array:
    """Return the mean of a rate that changes e-fold exp(rise) over a step: (exp(rise) − 1)/rise."""
    rise = np.asarray(rise)
    return np.divide(np.expm1(rise), rise, out=np.ones_like(rise), where=rise != 0)


def lasting(step: Field, slope: Field) -> Field:
    """Return how much a step counts for where the rate follows its own state by this slope."""
    return step * relaxed(step * slope) if np.any(slope) else step


def bending(step: Field, slope: Field) -> Field:
    """Return the derivative of `lasting` in the slope."""
    if not np.any(slope):
        return 0.0
    rise = np.asarray(step * slope)
    small = np.abs(rise) < SMALL
    safe = np.where(small, 1.0, rise)
    return step**2 * np.where(small, 0.5 + rise / 3, (np.exp(safe) - relaxed(safe)) / safe)


def relaxation(
    rates: Rates,
    states: Sequence[Array],
    first: Sequence[Array],
    length: float,
    kept: Sequence[Kept],
) -> list[Field]:
    """Return how the rate of each state changes with itself, where that is downwards."""
    found: list[Field] = []
    for index, (state, rate, of) in enumerate(zip(states, first, kept, strict=False)):
        other = moved(state, rate, length, of)
        if other is state:
            found.append(0.0)
            continue
        nudged = rates([*states[:index], other, *states[index + 1 :]], 0.0)[index]
        found.append(np.minimum((nudged - rate) / (other - state), 0.0))
    return found


def moved(state: Array, rate: Array, length: float, kept: Kept) -> Array:
    """Return a state moved by a part of the most that it is or becomes, past no break or limit."""
    largest = max(float(np.max(np.abs(state))), length * float(np.max(np.abs(rate))))
    return state if largest == 0 else kept.aside(state, NUDGE * largest)
