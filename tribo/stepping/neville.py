"""A part of an increment by Euler steps, extrapolated, and how far its numbers are apart."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from tribo.core.arrays import Array
from tribo.stepping.relaxation import Limits, Rates, Values, lasting

EXACT = 1e-10
"""Relative difference of one step from two by which means over a step are known to be exact."""
PLAIN, RELAXING = (1, 2, 3), (1, 2, 3, 4)
"""Euler steps of the rows of the extrapolation, without and with the relaxation of the states."""


def extrapolated(
    rates: Rates,
    start: Sequence[Array],
    first: Sequence[Array],
    relaxing: Sequence[Array | float],
    length: float,
    stages: Sequence[int],
    limits: Sequence[Limits],
    *,
    of_steps: bool,
    knows_means: bool,
) -> tuple[Values, Values, list[Sequence[Array]], list[float]]:
    """Return the last two columns of Neville's table: ends of the states, integrals of the rest.

    With them come the rates at 0, 1/2, 1/3 and 2/3 of the part, and by how much trials of each
    state were beyond its limits, summed over the cells.
    """
    row: list[Values] = []
    moved = [0.0] * len(start)
    samples: list[Sequence[Array]] = [first]
    for stage, steps in enumerate(stages):
        step = length / steps
        slides = [lasting(step, slope) for slope in relaxing]
        states = list(start)
        found = rates(start, 0.0, 1 / steps) if of_steps and steps > 1 else first
        sums = [np.zeros_like(rate) for rate in first[len(start) :]]
        for taken in range(steps):
            if taken:
                trial = [within(*each) for each in zip(states, limits, strict=True)]
                moved = [
                    max(by, apart(inside, state))
                    for by, state, inside in zip(moved, states, trial, strict=True)
                ]
                found = rates(trial, taken / steps, 1 / steps)
                samples.append(found)
            sums = [
                total + step * rate for total, rate in zip(sums, found[len(start) :], strict=True)
            ]
            states = [
                state + slide * rate
                for state, rate, slide in zip(states, found, slides, strict=False)
            ]
        column = [[*states, *sums]]
        for back, before in enumerate(row, start=1):
            ratio = steps / stages[stage - back] - 1
            pairs = zip(column[-1], before, strict=True)
            column.append([fine + (fine - coarse) / ratio for fine, coarse in pairs])
        row = column
        if knows_means and stage == 1:
            pairs = zip(*column, strict=True)
            if all(part_of(apart(fine, once), np.abs(fine)) <= EXACT for once, fine in pairs):
                break
    return row[-1], row[-2], samples[:4], moved


def apart(one: Array, other: Array) -> float:
    """Return how far two arrays are apart, summed over the cells."""
    return float(np.sum(np.abs(one - other)))


def part_of(amount: float, size: Array) -> float:
    """Return an amount relative to a size, summed over the cells."""
    whole = float(np.sum(size))
    if whole > 0:
        return amount / whole
    # Of what comes out as 0 nothing tells how large it is.
    return 0.0 if amount == 0 else math.inf


def within(values: Array, limit: Limits) -> Array:
    """Return values held to their limits."""
    if math.isinf(limit.least) and math.isinf(limit.most):
        return values
    return np.clip(values, limit.least, limit.most)
