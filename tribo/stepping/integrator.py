"""States over a part of an increment by Euler steps, extrapolated; and its transpose."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain

import numpy as np

from tribo.core.arrays import Array

NUDGE = 3e-5
"""Part of a state by which it is moved to find how fast it relaxes, and how that changes."""
SMALL = 1e-4
"""Rise below which the derivative of its mean is that of its series."""
EXACT = 1e-10
"""Relative difference of one step from two by which means over a step are known to be exact."""
PLAIN, RELAXING = (1, 2, 3), (1, 2, 3, 4)
"""Euler steps of the rows of the extrapolation, without and with the relaxation of the states."""

Values = list[Array]
Field = Array | float
Rates = Callable[[Sequence[Array], float, float], Values]
"""Rates of states, and after them of sums, at states, at a share of a part, over a share of it."""


@dataclass(frozen=True)
class Limits:
    """What one state may be, what messages call it, and whether it may relax within a step."""

    least: float
    most: float
    name: str
    relaxes: bool = True

    def hold(self, values: Array) -> Array:
        """Return values held to the limits."""
        if math.isinf(self.least) and math.isinf(self.most):
            return values
        return np.clip(values, self.least, self.most)


@dataclass(frozen=True)
class Part:
    """A part of an increment, solved.

    Parameters
    ----------
    length : float
        In the unit that rates are per.
    relaxing : sequence of ndarray or float
        How the rate of each state changes with itself, where that is downwards.
    rows : sequence of sequence of Values
        Rates at the beginning of each Euler step, by row of the extrapolation.
    ends : sequence of Values
        States and sums at the end of each row.
    rough : Values
        Less accurate ones.
    beyond : sequence of float
        By how much trials of each state were beyond its limits, summed over the cells.
    turned : sequence of (int, Values, ndarray)
        Of each state that relaxes, its number, rates where it is moved, and by how much.
    """

    length: float
    relaxing: Sequence[Field]
    rows: Sequence[Sequence[Values]]
    ends: Sequence[Values]
    rough: Values
    beyond: Sequence[float]
    turned: Sequence[tuple[int, Values, Array]] = ()

    @cached_property
    def lasting(self) -> list[list[Field]]:
        """What a step of each row counts for in each state."""
        return [[lasting(self.length / len(row), of) for of in self.relaxing] for row in self.rows]

    @cached_property
    def bending(self) -> list[list[Field]]:
        """The derivatives of that in how fast the state relaxes."""
        return [[bending(self.length / len(row), of) for of in self.relaxing] for row in self.rows]

    @property
    def stages(self) -> list[Values]:
        """The rates of all stages; rows may begin with the same ones."""
        return [*chain(*self.rows), *(rates for _, rates, _ in self.turned)]

    @property
    def end(self) -> Values:
        """States and sums at its end."""
        return _extrapolated(self.ends, [len(row) for row in self.rows])


def solved(
    rates: Rates,
    start: Sequence[Array],
    first: Values,
    length: float,
    limits: Sequence[Limits],
    *,
    relaxes: bool,
    of_steps: bool,
    knows_means: bool,
) -> Part:
    """Return a part of an increment, solved from its first rates on.

    Rates are asked at states that may lie beyond their limits. They are means `of_steps` or not;
    where one knows that they are exact, one step that agrees with two is all.
    """
    slopes: Sequence[Field] = [0.0] * len(start)
    if relaxes:
        slopes = relaxation(rates, start, first, length, limits)
    rows, ends = list[list[Values]](), list[Values]()
    beyond = [0.0] * len(start)
    stages = RELAXING if relaxes else PLAIN
    for steps in stages:
        step = length / steps
        counts = [lasting(step, slope) for slope in slopes]
        states, row = list(start), list[Values]()
        sums = [np.zeros_like(rate) for rate in first[len(start) :]]
        for taken in range(steps):
            if taken:
                trials = zip(beyond, states, limits, strict=True)
                beyond = [max(by, apart(of.hold(state), state)) for by, state, of in trials]
            asked = taken or (of_steps and steps > 1)
            found = rates(states, taken / steps, 1 / steps) if asked else first
            row.append(found)
            changes = zip(sums, found[len(start) :], strict=True)
            sums = [total + step * rate for total, rate in changes]
            states = [
                state + count * rate
                for state, rate, count in zip(states, found, counts, strict=False)
            ]
        rows.append(row)
        ends.append([*states, *sums])
        if knows_means and steps == 2:
            pairs = zip(*ends, strict=True)
            if all(part_of(apart(twice, once), np.abs(twice)) <= EXACT for once, twice in pairs):
                return Part(length, slopes, rows[:1], ends[:1], ends[1], beyond)
    return Part(length, slopes, rows, ends, _extrapolated(ends[1:], stages[1:]), beyond)


def retraced(
    rates: Rates,
    start: Sequence[Array],
    first: Values,
    length: float,
    limits: Sequence[Limits],
    parts: Sequence[tuple[float, bool]],
    *,
    of_steps: bool,
    knows_means: bool,
) -> list[Part]:
    """Return the parts of an increment as it was divided, with what `transposed` needs of them.

    `parts` are shares of it, each with whether states relax within. Rates are asked at shares of
    the increment.
    """
    passed, states, done = 0.0, list(start), list[Part]()
    for share, relaxes in parts:

        def along(
            values: Sequence[Array],
            at: float,
            step: float,
            passed: float = passed,
            share: float = share,
        ) -> Values:
            return rates(values, passed + at * share, step * share)

        if passed:
            first = along(states, 0.0, 1.0)
        span = share * length
        part = solved(
            along,
            states,
            first,
            span,
            limits,
            relaxes=relaxes,
            of_steps=of_steps,
            knows_means=knows_means,
        )
        turned = []
        for at, slope in enumerate(part.relaxing):
            if np.any(np.asarray(slope) < 0):
                other = moved(states[at], first[at], span, limits[at])
                asked = along([*states[:at], other, *states[at + 1 :]], 0.0, 1.0)
                turned.append((at, asked, other - states[at]))
        done.append(replace(part, turned=turned))
        held = zip(part.end, limits, strict=False)
        passed, states = passed + share, [limit.hold(state) for state, limit in held]
    return done


def transposed(
    parts: Sequence[Part],
    states: Sequence[Field],
    sums: Sequence[Field],
    behind: Callable[[Values, list[Field]], Sequence[Field]],
) -> list[Field]:
    """Return derivatives in the states before some parts, from those in states and sums after.

    Parameters
    ----------
    parts : sequence of Part
        From `retraced`.
    states, sums : sequence of ndarray or float
        Derivatives in each state and in each sum.
    behind : callable
        Returns derivatives in the states that rates were asked at, from those in the rates. What
        else they follow, it adds up by itself. It is called once for each stage.
    """
    after = [*states]
    for part in reversed(parts):
        before: list[Field] = [0.0] * len(after)
        turns: list[Field] = [0.0] * len(after)
        starts = list[tuple[Values, list[Field]]]()
        lengths = [len(row) for row in part.rows]
        for row, counts, bends in zip(part.rows, part.lasting, part.bending, strict=True):
            step, share = part.length / len(row), weight(len(row), lengths)
            seeds: list[Field] = [share * seed for seed in after]
            deep: list[Field] = [step * share * seed for seed in sums]
            for stage in reversed(row):
                for at, bend in enumerate(bends):
                    if np.ndim(bend):
                        turns[at] = turns[at] + seeds[at] * stage[at] * bend
                given = [*_products(seeds, counts), *deep]
                if stage is row[0]:
                    _join(starts, stage, given)
                else:
                    seeds = _added(seeds, behind(stage, given))
            before = _added(before, seeds)
        for at, asked, by in part.turned:
            seed = (np.asarray(part.relaxing[at]) < 0) * turns[at] / by
            for stage, sign in ((asked, 1.0), (part.rows[0][0], -1.0)):
                given = [0.0] * len(stage)
                given[at] = sign * seed
                _join(starts, stage, given)
        for stage, given in starts:
            before = _added(before, behind(stage, given))
        after = before
    return after


def relaxed(rise: Field) -> Array:
    """Return the mean of a rate that changes e-fold exp(rise) over a step: (exp(rise) − 1)/rise."""
    rise = np.asarray(rise)
    return np.divide(np.expm1(rise), rise, out=np.ones_like(rise), where=rise != 0)


def lasting(step: float, slope: Field) -> Field:
    """Return how much a step counts for where the rate follows its own state by this slope."""
    return step * relaxed(step * slope) if np.any(slope) else step


def bending(step: float, slope: Field) -> Field:
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
    limits: Sequence[Limits],
) -> list[Field]:
    """Return how the rate of each state changes with itself, where that is downwards."""
    found: list[Field] = []
    for index, (state, rate, limit) in enumerate(zip(states, first, limits, strict=False)):
        other = moved(state, rate, length, limit)
        if other is state or not limit.relaxes:
            found.append(0.0)
            continue
        nudged = rates([*states[:index], other, *states[index + 1 :]], 0.0, 1.0)[index]
        found.append(np.minimum((nudged - rate) / (other - state), 0.0))
    return found


def moved(state: Array, rate: Array, length: float, limit: Limits) -> Array:
    """Return a state moved by a part of the most that it is or becomes, within its limits."""
    largest = max(float(np.max(np.abs(state))), length * float(np.max(np.abs(rate))))
    if largest == 0:
        return state
    higher = state + NUDGE * largest
    return np.where(higher > limit.most, state - NUDGE * largest, higher)


def weight(steps: int, rows: Sequence[int]) -> float:
    """Return what a row of so many steps counts for in the extrapolation of all rows."""
    return math.prod(steps / (steps - other) for other in rows if other != steps)


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


def _extrapolated(ends: Sequence[Values], rows: Sequence[int]) -> Values:
    """Return the ends of rows of Euler steps, extrapolated to steps without end."""
    counts = [weight(steps, rows) for steps in rows]
    *rough, last = ends
    total = list(last)
    for count, end in zip(counts, rough, strict=False):
        # So a state that stays as it is does so to the last bit.
        pairs = zip(total, end, last, strict=True)
        total = [value + count * (each - fine) for value, each, fine in pairs]
    return total


def _join(seeded: list[tuple[Values, list[Field]]], stage: Values, seeds: Sequence[Field]) -> None:
    """Add derivatives in the rates of a stage, to those in them that there are already."""
    for at, (other, before) in enumerate(seeded):
        if other is stage:
            seeded[at] = stage, _added(before, seeds)
            return
    seeded.append((stage, [*seeds]))


def _added(one: Sequence[Field], other: Sequence[Field]) -> list[Field]:
    return [a + b for a, b in zip(one, other, strict=True)]


def _products(one: Sequence[Field], other: Sequence[Field]) -> list[Field]:
    return [a * b for a, b in zip(one, other, strict=True)]
