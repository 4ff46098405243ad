"""How an increment is divided so that states within it are integrated accurately."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import BadValues, PluginError
from tribo.integration.integrator import Part, apart, part_of, solved
from tribo.integration.kept import Kept, Rates, Sum, Values
from tribo.integration.step_to_break import places_passing

ACCURACY = 3e-5
"""Error of an increment, summed over the cells, relative to what it integrates."""
LOOSER, LOOSEST = 10.0, 3e-3
"""Factor on the accuracy of rates that jump, and the least accuracy that it may lead to."""
MOST_PARTS = 32
"""Parts of an increment after which the accuracy is loosened."""
ROUGHEST = 0.05
"""Largest error, as the mean over those parts and in each part of the whole."""
MOST_LEAVING = 64
"""Parts of an increment after which a state that leaves its limits is not followed further."""
JUMP = 0.1
"""Relative difference from a smooth rate at which a rate is taken to jump."""
SAFETY, LEAST = 0.9, 1 / 8
"""Length of the next part over the length of the accuracy asked for; and the least part cut off
at once."""
FINEST = 2.0**-30
"""The smallest part, where a state keeps leaving its limits."""
FADED = 0.01
"""Part of the largest value of a state, below which its error is relative to that part."""


@dataclass(frozen=True)
class Division:
    """How an increment is divided to be accurate.

    Parameters
    ----------
    parts : tuple of (float, bool)
        Parts of it, which add up to 1, each with whether its states relax within it.
    accuracy : float
        Of the integration; infinite to take the parts as they are.
    """

    parts: tuple[tuple[float, bool], ...] = ((1.0, False),)
    accuracy: float = ACCURACY


@dataclass(frozen=True)
class Integral:
    """States at the end of an increment, the sums over it, and its division.

    `passed` has by state and break, both by number, the first share of the increment at which a
    point rises to the break.
    """

    values: Values
    sums: Values
    plan: Division
    passed: Mapping[tuple[int, int], float]


def integrated(
    rates: Rates,
    start: Sequence[Array],
    length: float,
    kept: Sequence[Kept],
    sums: Sequence[Sum] = (),
    plan: Division | None = None,
) -> Integral:
    """Integrate states and sums over an increment.

    Each part is solved by Euler steps, extrapolated; where that is not accurate, by exponential
    ones, exact for a state that relaxes linearly; and where that is not either, or leaves the
    limits of a state, in two halves. States that relax over far less than a part reach equilibrium
    there. Steps end at breaks that a state declares; rates that jump elsewhere would need endless
    parts, and are integrated less accurately.

    Parameters
    ----------
    rates : callable
        The rates of the states, then of the sums, at given states and the part of the increment
        that has passed.
    start : sequence of ndarray
        The states at the beginning.
    length : float
        The increment, in the unit that rates are per.
    kept : sequence of Kept
        One for each state; trial values are clipped to its limits.
    sums : sequence of Sum, optional
        One for each sum.
    plan : Division, optional
        Parts to begin with; they are divided, but never joined, so that the answer follows
        smoothly from the rates.

    Raises
    ------
    PluginError
        If a state leaves its limits however short the part.
    BadValues
        If the increment is too long for the parts that it may have.

    References
    ----------
    Deuflhard, P., Hairer, E., Zugck, J. (1987), One-step and extrapolation methods for
    differential-algebraic systems, Numer. Math. 51, 501-516. Hairer, E., Wanner, G. (1996),
    Solving Ordinary Differential Equations II, section IV.9. Hochbruck, M., Ostermann, A. (2010),
    Exponential integrators, Acta Numerica 19, 209-286.
    """
    plan = plan or Division()
    problem = _Problem(rates, length, kept, sums, math.isinf(plan.accuracy))
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
            of = kept[int(np.argmax(trial.beyond))]
            raise PluginError(
                f"{of} leaves its limits of {of.least:g} to {of.most:g}: let its rate vanish there"
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
        names = ", ".join(map(str, kept))
        raise BadValues(
            f"states ({names}) change too often to be integrated over {length:g} (m, or s of a "
            "rest): shorten the steps"
        )
    return Integral(here.values, here.sums, replace(plan, parts=tuple(done)), here.breaks)


@dataclass(frozen=True)
class _Place:
    """A place along an increment: the part passed, states and sums there, and all rates.

    `peaks` are the largest values of the states until there; `breaks` is as `Integral.passed`.
    """

    passed: float
    values: Values
    peaks: Values
    sums: Values
    rates: Values
    breaks: Mapping[tuple[int, int], float]


@dataclass(frozen=True)
class _Trial:
    """Where a part of an increment ends, its error, and how far each state leaves its limits.

    The largest error `off` and the distances beyond limits are relative to the integral so far;
    `errors` are summed over the cells.
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
    kept: Sequence[Kept]
    sums: Sequence[Sum]
    repeated: bool

    def begin(self, start: Sequence[Array]) -> _Place:
        """Return the place where the increment begins."""
        values, first = list(start), self.rates(start, 0.0)
        sums = [np.zeros_like(rate) for rate in first[len(values) :]]
        return _Place(0.0, values, [np.abs(value) for value in values], sums, first, {})

    def tried(
        self, here: _Place, part: float, relaxes: bool, accuracy: float, *, is_last: bool
    ) -> _Trial:
        """Return the trial of a part of the increment."""
        values, kept, count = here.values, self.kept, len(here.values)
        span = part * self.length

        def along(states: Sequence[Array], share: float) -> Values:
            held = [of.hold(state) for state, of in zip(states, kept, strict=True)]
            return self.rates(held, here.passed + share * part)

        taken = solved(along, values, here.rates, span, kept, self.sums, relaxes=relaxes)
        best, rough = taken.end, taken.rough
        sizes = [
            np.maximum.reduce([np.abs(old), np.abs(new), FADED * peak])
            for old, new, peak in zip(values, best, here.peaks, strict=False)
        ]
        sizes += [
            np.maximum(np.abs(new), part * np.abs(old))
            for old, new in zip(here.sums, best[count:], strict=True)
        ]
        held = [of.hold(value) for value, of in zip(best, kept, strict=False)]
        at_end = is_last and math.isinf(accuracy)
        last = taken.last or (here.rates if at_end else along(held, 1.0))
        errors = [apart(*each) for each in zip(best, rough, strict=True)]
        off = max(map(part_of, errors, sizes), default=0.0)
        passing = places_passing(kept, taken.pieces)
        if not self.repeated:
            # Trials held to a limit agree with each other, whatever the state goes to.
            off = max(off, *map(part_of, taken.beyond, sizes), 0.0)
            if passing:
                off = max(off, *map(part_of, _unseen(taken, self.sums, along, last), sizes))
        passed = taken.passed()
        if off <= accuracy < math.inf and taken.last is None:
            # At a place where points pass breaks, rates jump as is known; elsewhere all may then.
            amounts = [*sizes[:count], *map(np.abs, here.sums)]
            places = [*(of.place for of in kept), *(of.place for of in self.sums)]
            for at, place in enumerate(places):
                if place not in passing and (passing or at >= count):
                    rates = [each[at] for each in (*_samples(taken), last)]
                    off = max(off, _jump(rates, span, amounts[at]))
        totals = [old + new for old, new in zip(here.sums, best[count:], strict=True)]
        beyond = [
            _beyond(value, np.maximum(size, peak), of)
            for value, size, peak, of in zip(best, sizes, here.peaks, kept, strict=False)
        ]
        peaks = [np.maximum(old, np.abs(new)) for old, new in zip(here.peaks, held, strict=True)]
        first = {at: here.passed + share * part for at, share in passed.items()}
        end = _Place(here.passed + part, held, peaks, totals, last, {**first, **here.breaks})
        return _Trial(end, off, errors, beyond)


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


def _unseen(part: Part, sums: Sequence[Sum], rates: Rates, last: Values) -> list[float]:
    """Return the error of states and sums where a break is passed, summed over the cells.

    Rates change before and after the break, while a step evaluates them only before the break and
    at its end. `last` are the rates at the end of the increment.
    """
    # States lie at their places.
    every = [*(Sum(of.place) for of in part.kept), *sums]
    off, row = [0.0] * len(every), part.rows[-1]
    for taken, pieces in enumerate(row):
        if not pieces[0].ended:
            continue
        end = last if taken + 1 == len(row) else row[taken + 1][0].rates
        for piece in pieces:
            after = piece.rates if piece is pieces[0] else end
            change = [np.abs(a - b) for a, b in zip(after, piece.rates, strict=True)]
            states = piece.stepped(part.kept, part.relaxing)
            for at, (here, number) in piece.ended.items():
                near = np.nextafter(part.kept[at].end(number), piece.states[at])
                states[at] = np.where(here, near, states[at])
            found = rates(states, taken / len(row)) if piece.ended else []
            for at, (here, _) in piece.ended.items():
                for other, of in enumerate(every):
                    if of.place == part.kept[at].place:
                        own = np.abs(found[other] - piece.rates[other])
                        change[other] = np.where(of.seen(here), own, change[other])
            for at, of in enumerate(every):
                off[at] += 0.5 * float(np.sum(change[at] * of.span(piece.spans, 0.0)))
    for at, of in enumerate(every):
        # Rows of a sum over all of a step may agree by chance.
        if of.place is None:
            off[at] = apart(part.ends[-1][at], part.ends[0][at])
    return off


def _samples(part: Part) -> list[Values]:
    """Return the rates at 0, 1/2, 1/3 and 2/3 of a part."""
    first, half, thirds = ([step[0].rates for step in row] for row in part.rows[:3])
    return [first[0], half[1], *thirds[1:]]


def _jump(rates: Sequence[Array], span: float, so_far: Array) -> float:
    """Return the error of a rate that jumps before or after all samples, relative to all so far.

    It is the difference of the last sample, at the end of a part, from a cubic through the others.
    """
    first, half, third, two_thirds, last = rates
    off = float(np.sum(np.abs(9 * third - 16 * half + 9 * two_thirds - first - last)))
    size = float(np.sum(np.max(np.abs(rates), axis=0)))
    return off * span / (float(np.sum(so_far)) + size * span) if off > JUMP * size else 0.0


def _beyond(values: Array, size: Array, kept: Kept) -> float:
    """Return the distance of values beyond their limits, relative to the largest."""
    over = max(kept.least - float(np.min(values)), float(np.max(values)) - kept.most, 0.0)
    return over / float(np.max(size)) if over > 0 else 0.0
