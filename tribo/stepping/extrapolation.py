"""Rates integrated over an increment by extrapolation, to an accuracy of its own."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import BadValues

ACCURACY = 3e-5
"""Error of a part of the increment, summed over the cells, relative to what it integrates."""
STAGES = (1, 2, 3, 4)
"""Euler steps of the rows of the extrapolation, which is of fourth order."""
MOST_PARTS = 64
"""Parts of an increment, after which what is not smooth is taken as it is."""
FINEST = 2.0**-20
"""The smallest part, where a state goes on to leave its limits."""
NUDGE = 1e-6
"""Part of a state by which it is moved to find how fast it relaxes."""

Values = list[Array]
Rates = Callable[[Sequence[Array]], Values]


@dataclass(frozen=True)
class Limits:
    """What one state may be, at the least and at the most, and what messages call it."""

    least: float
    most: float
    name: str


def integrated(
    rates: Rates,
    start: Sequence[Array],
    length: float,
    limits: Sequence[Limits],
    parts: Sequence[float] = (1.0,),
    accuracy: float = ACCURACY,
) -> tuple[Values, Values, tuple[float, ...]]:
    """Return states after an increment, what other rates come to over it, and its parts.

    Each part is solved by Euler steps that are linearly implicit, each state in itself, and
    extrapolated; one that is not accurate, or leaves the limits of a state, is halved. States
    that relax over far less than a part come to rest there.

    Parameters
    ----------
    rates : callable
        The rates of the states, and after them those that are only integrated, at given states.
    start : sequence of ndarray
        The states at the beginning.
    length : float
        The increment, in the unit that rates are per.
    limits : sequence of Limits
        One for each state: trial values are held to them.
    parts : sequence of float, optional
        Parts of the increment to begin with, in sum 1; they are halved, but never joined.
    accuracy : float, optional
        As `ACCURACY`; infinite to take `parts` as they are.

    Raises
    ------
    BadValues
        If a state leaves its limits however short the part.

    References
    ----------
    Deuflhard, P., Hairer, E., Zugck, J. (1987), One-step and extrapolation methods for
    differential-algebraic systems, Numer. Math. 51, 501-516. Hairer, E., Wanner, G. (1996),
    Solving Ordinary Differential Equations II, section IV.9.
    """
    count, values = len(start), list(start)
    first = rates(values)
    sums = [np.zeros_like(rate) for rate in first[count:]]
    waiting, done = list(parts), list[float]()
    while waiting:
        part = waiting[0]
        relaxing = _relaxing(rates, values, first, part * length, limits)
        best, rough = _extrapolated(rates, values, first, relaxing, part * length, limits)
        sizes = [
            np.maximum(np.abs(old), np.abs(new)) for old, new in zip(values, best, strict=False)
        ]
        sizes += [
            np.maximum(np.abs(new), part * np.abs(old))
            for old, new in zip(sums, best[count:], strict=True)
        ]
        off = max(map(_relative, best, rough, sizes), default=0.0)
        beyond = [_beyond(*each) for each in zip(best, sizes, limits, strict=False)]
        left = max(beyond, default=0.0)
        wrong = off > accuracy and len(waiting) + len(done) < MOST_PARTS
        if wrong or left > min(accuracy, ACCURACY):
            if part <= FINEST:
                limit = limits[int(np.argmax(beyond))]
                raise BadValues(
                    f"{limit.name} goes on beyond its limits of {limit.least:g} to {limit.most:g}: "
                    "let its rate vanish there"
                )
            waiting[:1] = [0.5 * part, 0.5 * part]
            continue
        values = [_held(*each) for each in zip(best, limits, strict=False)]
        sums = [old + new for old, new in zip(sums, best[count:], strict=True)]
        done.append(waiting.pop(0))
        if waiting:
            first = rates(values)
    return values, sums, tuple(done)


def _extrapolated(
    rates: Rates,
    start: Sequence[Array],
    first: Sequence[Array],
    relaxing: Sequence[Array | float],
    length: float,
    limits: Sequence[Limits],
) -> tuple[Values, Values]:
    """Return the last two columns of Neville's table: ends of the states, integrals of the rest."""
    row: list[Values] = []
    for stage, steps in enumerate(STAGES):
        step = length / steps
        states, found = list(start), first
        sums = [np.zeros_like(rate) for rate in first[len(start) :]]
        for taken in range(steps):
            if taken:
                found = rates([_held(*each) for each in zip(states, limits, strict=True)])
            sums = [
                total + step * rate for total, rate in zip(sums, found[len(start) :], strict=True)
            ]
            states = [
                state + step * rate / (1 - step * slope)
                for state, rate, slope in zip(states, found, relaxing, strict=False)
            ]
        column = [[*states, *sums]]
        for back, before in enumerate(row, start=1):
            ratio = steps / STAGES[stage - back] - 1
            pairs = zip(column[-1], before, strict=True)
            column.append([fine + (fine - coarse) / ratio for fine, coarse in pairs])
        row = column
    return row[-1], row[-2]


def _relaxing(
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
        if largest == 0:
            found.append(0.0)
            continue
        moved = state + NUDGE * largest
        moved = np.where(moved > limit.most, state - NUDGE * largest, moved)
        nudged = rates([*states[:index], moved, *states[index + 1 :]])[index]
        found.append(np.minimum((nudged - rate) / (moved - state), 0.0))
    return found


def _relative(fine: Array, coarse: Array, size: Array) -> float:
    whole = float(np.sum(size))
    return float(np.sum(np.abs(fine - coarse))) / whole if whole > 0 else 0.0


def _beyond(values: Array, size: Array, limit: Limits) -> float:
    """Return by how much values pass their limits, relative to the largest."""
    over = max(limit.least - float(np.min(values)), float(np.max(values)) - limit.most, 0.0)
    return over / float(np.max(size)) if over > 0 else 0.0


def _held(values: Array, limit: Limits) -> Array:
    if math.isinf(limit.least) and math.isinf(limit.most):
        return values
    return np.clip(values, limit.least, limit.most)
