"""How an increment is divided so that states within it are integrated accurately."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import BadValues
from tribo.stepping.integrator import EXACT, Limits, Part, Rates, Values, apart, part_of, solved

ACCURACY = 3e-5
"""Error of an increment, summed over the cells, relative to what it integrates."""
LOOSER, LOOSEST = 10.0, 3e-3
"""By how much less accurate rates that jump are integrated, and how far that goes."""
MOST_PARTS = 32
"""Parts of an increment after which that is done."""
ROUGHEST = 0.05
"""Error, in the mean over those parts and in each of all there is, up to which they are taken."""
MOST_LEAVING = 64
"""Parts of an increment after which a state that leaves its limits is not followed further."""
JUMP = 0.1
"""Relative difference from a smooth rate at which one is looked at as one that jumps."""
SAFETY, LEAST = 0.9, 1 / 8
"""Of the length at which the next part would be as accurate as asked, what is taken; and the least
that is cut off it."""
FINEST = 2.0**-30
"""The smallest part, where a state goes on to leave its limits."""
FADED = 0.01
"""Part of the most that a state was, below which its error is relative to that part."""


@dataclass(frozen=True)
class Division:
    """How an increment is divided to be accurate.

    Parameters
    ----------
    parts : tuple of (float, bool)
        Parts of it, in sum 1, each with whether its states relax within it.
    accuracy : float
        To which it is integrated; infinite to take the parts as they are.
    """

    parts: tuple[tuple[float, bool], ...] = ((1.0, False),)
    accuracy: float = ACCURACY

    def until(self, share: float) -> Division:
        """Return the parts of the first share of the increment, to be taken as they are."""
        parts, left = [], share
        for part, relaxes in self.parts:
            if left > 0:
                parts.append((min(part, left) / share, relaxes))
            left -= part
        return Division(tuple(parts), math.inf)


def integrated(
    rates: Rates,
    start: Sequence[Array],
    length: float,
    limits: Sequence[Limits],
    plan: Division | None = None,
    *,
    knows_means: bool = False,
    layered: Sequence[bool] = (),
) -> tuple[Values, Values, Division]:
    """Return states after an increment, what other rates come to over it, and how it was divided.

    Each part is solved by Euler steps, extrapolated; where that is not accurate, by exponential
    ones, exact for a state that relaxes linearly; and where that is not either, or leaves the
    limits of a state, in two halves. States that relax over far less than a part come to rest
    there. Rates that jump would need parts without end: they are integrated less accurately.

    Parameters
    ----------
    rates : callable
        The rates of the states, and after them those that are only integrated, at given states, a
        part of the increment that has passed, and the part over which they are taken as constant.
    start : sequence of ndarray
        The states at the beginning.
    length : float
        The increment, in the unit that rates are per.
    limits : sequence of Limits
        One for each state: trial values are held to them.
    plan : Division, optional
        Parts to begin with; they are divided, but never joined, so that the answer follows
        smoothly from the rates.
    knows_means : bool, optional
        Whether rates are the exact means over the part that they are told of, as those of a model
        that knows them: they are asked anew for each length.
    layered : sequence of bool, optional
        Of each of the last states that are depths worn in layers, at whose bottoms rates may jump,
        whether its rates are such exact means. The others too are means over a part, as points pass
        from layer to layer within it.

    Raises
    ------
    BadValues
        If a state leaves its limits however short the part, or the increment is too long for the
        parts that it may have.

    References
    ----------
    Deuflhard, P., Hairer, E., Zugck, J. (1987), One-step and extrapolation methods for
    differential-algebraic systems, Numer. Math. 51, 501-516. Hairer, E., Wanner, G. (1996),
    Solving Ordinary Differential Equations II, section IV.9. Hochbruck, M., Ostermann, A. (2010),
    Exponential integrators, Acta Numerica 19, 209-286.
    """
    plan = plan or Division()
    problem = _Problem(rates, length, limits, knows_means, layered, math.isinf(plan.accuracy))
    here = begin = problem.begin(start)
    waiting, done, missed = list(plan.parts), list[tuple[float, bool]](), 0.0
    worst = [0.0] * len(begin.rates)
    while waiting:
        part, relaxes = waiting[0]
        trial = problem.tried(here, part, relaxes, plan.accuracy, is_last=len(waiting) == 1)
        left = max(trial.beyond, default=0.0) > ACCURACY
        if trial.off <= plan.accuracy and not left:
            here, missed = trial.end, missed + part * trial.off
            worst = [max(each) for each in zip(worst, trial.errors, strict=True)]
            done.append(waiting.pop(0))
            if waiting and trial.off > 0:
                _cut(waiting, SAFETY * part * (plan.accuracy / trial.off) ** (1 / 3))
        elif not relaxes:
            waiting[0] = part, True
        elif left and (part <= FINEST or len(waiting) + len(done) > MOST_LEAVING):
            limit = limits[int(np.argmax(trial.beyond))]
            raise BadValues(
                f"{limit.name} goes on beyond its limits of {limit.least:g} to {limit.most:g}: "
                "let its rate vanish there"
            )
        elif left or (part > FINEST and len(waiting) + len(done) < MOST_PARTS):
            waiting[:1] = [(0.5 * part, True)] * 2
        else:
            # Rates that jump, at one point after the other.
            plan = _looser(plan)
            here, waiting, done, missed = begin, list(plan.parts), [], 0.0
            worst = [0.0] * len(worst)
    if math.isinf(plan.accuracy) and not problem.repeated:
        amounts = [*here.peaks, *map(np.abs, here.sums)]
        missed = max(missed, *map(part_of, worst, amounts))
    if not missed <= ROUGHEST:
        names = ", ".join(limit.name for limit in limits)
        raise BadValues(
            f"what is remembered ({names}) changes too often to be followed over {length:g} (m, or "
            "s of a rest): shorten the steps"
        )
    return here.values, here.sums, replace(plan, parts=tuple(done))


@dataclass(frozen=True)
class _Place:
    """A place along an increment: the part passed, states and sums there, and all rates.

    `peaks` are the largest values of the states until there.
    """

    passed: float
    values: Values
    peaks: Values
    sums: Values
    rates: Values


@dataclass(frozen=True)
class _Trial:
    """Where a part of an increment ends, its error, and how far each state leaves its limits.

    The largest error `off` is relative to all that came before, as is what is beyond; `errors` are
    summed over the cells.
    """

    end: _Place
    off: float
    errors: Sequence[float]
    beyond: Sequence[float]


@dataclass(frozen=True)
class _Problem:
    """What `integrated` integrates; `repeated` where its parts are taken as they are."""

    rates: Rates
    length: float
    limits: Sequence[Limits]
    knows_means: bool
    layered: Sequence[bool]
    repeated: bool

    @property
    def of_steps(self) -> bool:
        """Whether rates are means over the part that they are told of."""
        return self.knows_means or len(self.layered) > 0

    def begin(self, start: Sequence[Array]) -> _Place:
        """Return the place where the increment begins."""
        values, first = list(start), self.rates(start, 0.0, 1.0)
        sums = [np.zeros_like(rate) for rate in first[len(values) :]]
        return _Place(0.0, values, [np.abs(value) for value in values], sums, first)

    def tried(
        self, here: _Place, part: float, relaxes: bool, accuracy: float, *, is_last: bool
    ) -> _Trial:
        """Return what a part of the increment would end with."""
        values, limits, count = here.values, self.limits, len(here.values)
        span, first = part * self.length, here.rates
        along = partial(self._along, here.passed, part)
        if self.of_steps and part < 1:
            first = along(values, 0.0, 1.0)
        taken = solved(
            along,
            values,
            first,
            span,
            limits,
            relaxes=relaxes,
            of_steps=self.of_steps,
            knows_means=self.knows_means,
        )
        best, rough = taken.end, taken.rough
        sizes = [
            np.maximum.reduce([np.abs(old), np.abs(new), FADED * peak])
            for old, new, peak in zip(values, best, here.peaks, strict=False)
        ]
        sizes += [
            np.maximum(np.abs(new), part * np.abs(old))
            for old, new in zip(here.sums, best[count:], strict=True)
        ]
        held = [limit.hold(value) for value, limit in zip(best, limits, strict=False)]
        at_end = is_last and math.isinf(accuracy)
        last = first if at_end or self.of_steps else along(held, 1.0, part)
        errors = [apart(*each) for each in zip(best, rough, strict=True)]
        off = max(map(part_of, errors, sizes), default=0.0)
        if not self.repeated:
            # Trials held to a limit agree with each other, whatever the state goes to.
            off = max(off, *map(part_of, taken.beyond, sizes), 0.0)
        if off <= accuracy < math.inf and not (self.knows_means and off <= EXACT):
            if self.layered:
                at = [
                    self._between(along, values, held, share)
                    for share in (0, 1 / 2, 1 / 3, 2 / 3, 1)
                ]
                off = max(off, _jump(at[:4], at[4], span, here.sums, count))
                late = self._late(along, values, held, at[4], span)
                off = max(off, *map(part_of, late, sizes[count - len(late) : count]))
            elif not self.of_steps:
                off = max(off, _jump(_samples(taken), last, span, here.sums, count))
        sums = [old + new for old, new in zip(here.sums, best[count:], strict=True)]
        beyond = [
            _beyond(value, np.maximum(size, peak), limit)
            for value, size, peak, limit in zip(best, sizes, here.peaks, limits, strict=False)
        ]
        peaks = [np.maximum(old, np.abs(new)) for old, new in zip(here.peaks, held, strict=True)]
        end = _Place(here.passed + part, held, peaks, sums, last)
        return _Trial(end, off, errors, beyond)

    def _along(
        self, passed: float, part: float, values: Sequence[Array], share: float, step: float
    ) -> Values:
        """Return the rates at a place within a part, 0 to 1, over a step of it."""
        held = [limit.hold(value) for value, limit in zip(values, self.limits, strict=True)]
        return self.rates(held, passed + share * part, step * part)

    def _between(
        self, along: Rates, start: Sequence[Array], end: Sequence[Array], share: float
    ) -> Values:
        """Return the rates where a share of a part has passed, in the layers where it begins."""
        remembered = len(start) - len(self.layered)
        states = [s + share * (e - s) for s, e in zip(start, end, strict=True)]
        return along([*states[:remembered], *start[remembered:]], share, 0.0)

    def _late(
        self,
        along: Rates,
        start: Sequence[Array],
        end: Sequence[Array],
        stayed: Sequence[Array],
        span: float,
    ) -> list[float]:
        """Return how far each depth may be off for what is remembered once points have passed.

        What they have passed to in the last third of a part has none of it in any trial, but where
        means are known. `stayed` are the rates at the end in the layers where the part begins.
        """
        remembered, count = len(start) - len(self.layered), len(start)
        none = [0.0] * len(self.layered)
        if all(self.layered):
            return none
        after = along(end, 1.0, 0.0)[remembered:count]
        passed = [a != b for a, b in zip(after, stayed[remembered:count], strict=True)]
        if not any(map(np.any, passed)):
            return none
        entered = along([*start[:remembered], *end[remembered:]], 1.0, 0.0)[remembered:count]
        return [
            0.0 if known else span / 3 * float(np.sum(np.abs(last - first), where=where))
            for first, last, where, known in zip(entered, after, passed, self.layered, strict=True)
        ]


def _cut(waiting: list[tuple[float, bool]], accurate: float) -> None:
    """Divide the next part where it is more than twice as long as would be accurate.

    A half, a quarter or an eighth is cut off, so that parts do not follow the rates' last digits.
    """
    whole = waiting[0][0]
    if whole > 2 * accurate:
        cut = max(2.0 ** math.floor(math.log2(accurate / whole)), LEAST) * whole
        waiting[:1] = [(cut, True), (whole - cut, True)]


def _looser(plan: Division) -> Division:
    if LOOSER * plan.accuracy <= LOOSEST:
        return replace(plan, accuracy=LOOSER * plan.accuracy)
    return Division(((1 / MOST_PARTS, False),) * MOST_PARTS, math.inf)


def _samples(part: Part) -> list[Values]:
    """Return the rates at 0, 1/2, 1/3 and 2/3 of a part."""
    return [part.rows[0][0], part.rows[1][1], *part.rows[2][1:]]


def _jump(
    samples: Sequence[Sequence[Array]],
    last: Sequence[Array],
    length: float,
    sums: Sequence[Array],
    count: int,
) -> float:
    """Return what a rate that jumps before or after all samples may hide, relative to all so far.

    It is what the end of a part differs by from the cubic through the samples.
    """
    worst = 0.0
    for total, *at, end in zip(sums, *(each[count:] for each in (*samples, last)), strict=True):
        first, half, third, two_thirds = at
        off = float(np.sum(np.abs(9 * third - 16 * half + 9 * two_thirds - first - end)))
        size = float(np.sum(np.max(np.abs([*at, end]), axis=0)))
        if off > JUMP * size:
            worst = max(worst, off * length / (float(np.sum(np.abs(total))) + size * length))
    return worst


def _beyond(values: Array, size: Array, limit: Limits) -> float:
    """Return by how much values pass their limits, relative to the largest."""
    over = max(limit.least - float(np.min(values)), float(np.max(values)) - limit.most, 0.0)
    return over / float(np.max(size)) if over > 0 else 0.0
