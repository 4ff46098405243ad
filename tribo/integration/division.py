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

ACCURACY = 2e-5
"""Error of an increment, summed over the cells, relative to what it integrates."""
MOST_PARTS = 128
"""Parts of an increment after which it is refused: to 1e-5 of it, a jump takes 40."""
JUMP = 0.1
"""Relative difference from a smooth rate at which a rate is taken to jump."""
SAFETY, LEAST = 0.9, 1 / 8
"""Length of the next part over the length of the accuracy asked for; and the least part cut off
at once."""
FADED = 0.01
"""Part of the largest value of a state, below which its error is relative to that part."""


@dataclass(frozen=True)
class Division:
    """How an increment is divided to be accurate.

    Parameters
    ----------
    parts : tuple of float
        Parts of it, which add up to 1.
    accuracy : float
        Of the integration; infinite to take the parts as they are.
    """

    parts: tuple[float, ...] = (1.0,)
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

    Each part is solved by exponential Euler steps, exact for a state that relaxes linearly, which
    are extrapolated; where that is not accurate, or leaves the limits of a state, in two halves.
    States that relax over far less than a part reach equilibrium there. Steps end at breaks that a
    state declares; towards a jump elsewhere parts are halved, and many jumps are refused.

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
        If states change too often for the parts that it may have.

    References
    ----------
    Deuflhard, P., Hairer, E., Zugck, J. (1987), One-step and extrapolation methods for
    differential-algebraic systems, Numer. Math. 51, 501-516. Hairer, E., Wanner, G. (1996),
    Solving Ordinary Differential Equations II, section IV.9. Hochbruck, M., Ostermann, A. (2010),
    Exponential integrators, Acta Numerica 19, 209-286.
    """
    plan = plan or Division()
    problem = _Problem(rates, length, kept, sums, math.isinf(plan.accuracy))
    here = problem.begin(start)
    waiting, done = list(plan.parts), list[float]()
    while waiting:
        part = waiting[0]
        trial = problem.tried(here, part, plan.accuracy, is_last=len(waiting) == 1)
        left = max(trial.beyond, default=0.0) > ACCURACY
        if trial.off <= plan.accuracy and not left:
            here = trial.end
            done.append(waiting.pop(0))
            if waiting and trial.off > 0:
                _cut(waiting, SAFETY * part * (plan.accuracy / trial.off) ** (1 / 3))
        elif len(waiting) + len(done) < MOST_PARTS:
            waiting[:1] = [0.5 * part] * 2
        elif left:
            of = kept[int(np.argmax(trial.beyond))]
            raise PluginError(
                f"{of} leaves its limits of {of.least:g} to {of.most:g}: let its rate vanish there"
            )
        else:
            names = ", ".join(map(str, kept))
            raise BadValues(
                f"states ({names}) change too often to be integrated over {length:g} (m, or s of "
                "a rest): shorten the steps, or declare the breaks where rates jump"
            )
    return Integral(here.values, here.sums, replace(plan, parts=tuple(done)), here.breaks)


@dataclass(frozen=True)
class _Place:
    """A place along an increment: the part passed, states and sums there, and all rates.

    `peaks` are the largest states and sums until there; `breaks` is as `Integral.passed`.
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

    The largest error `off` and the distances beyond limits are relative to the integral so far.
    """

    end: _Place
    off: float
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
        return _Place(0.0, values, [*map(np.abs, values), *sums], sums, first, {})

    def tried(self, here: _Place, part: float, accuracy: float, *, is_last: bool) -> _Trial:
        """Return the trial of a part of the increment."""
        values, kept, count = here.values, self.kept, len(here.values)
        span = part * self.length

        def along(states: Sequence[Array], share: float) -> Values:
            held = [of.hold(state) for state, of in zip(states, kept, strict=True)]
            return self.rates(held, here.passed + share * part)

        taken = solved(along, values, here.rates, span, kept, self.sums)
        best = taken.end
        totals = [old + new for old, new in zip(here.sums, best[count:], strict=True)]
        amounts = [np.abs(each) for each in (*best[:count], *totals)]
        peaks = [*map(np.maximum, here.peaks, amounts)]
        sizes = [
            np.maximum.reduce([np.abs(old), new, FADED * peak])
            for old, new, peak in zip((*values, *here.sums), amounts, peaks, strict=True)
        ]
        held = [of.hold(value) for value, of in zip(best, kept, strict=False)]
        last, off = here.rates, 0.0
        if not (is_last and math.isinf(accuracy)):
            last = along(held, 1.0)
            errors = self._errors(taken, along, last, span)
            off = max(map(part_of, errors, sizes), default=0.0)
        beyond = [
            _beyond(value, peak, of) for value, peak, of in zip(best, peaks, kept, strict=False)
        ]
        first = {at: here.passed + share * part for at, share in taken.passed().items()}
        end = _Place(here.passed + part, held, peaks, totals, last, {**first, **here.breaks})
        return _Trial(end, off, beyond)

    def _errors(self, part: Part, rates: Rates, last: Values, span: float) -> list[float]:
        """Return the error of states and sums after a part, summed over the cells.

        It is the change by the last row of the extrapolation. Where a point passes a break it is
        half the change of its rates up to the break, and from there on; a rate that jumps elsewhere
        is in error by its jump. `last` are the rates at the end.
        """
        # States lie at their places.
        every = [*(Sum(of.place) for of in self.kept), *self.sums]
        passing, row = places_passing(self.kept, part.pieces), part.rows[-1]
        errors = [apart(*each) for each in zip(part.end, part.rough, strict=True)]
        for taken, pieces in enumerate(row):
            for piece in pieces if pieces[0].ended else ():
                found = rates(piece.nearly(self.kept, part.relaxing), taken / len(row))
                for at, of in enumerate(every):
                    lasts = np.asarray(of.span(piece.spans, 0.0))
                    change = np.abs(found[at] - piece.rates[at])
                    passed = np.where(lasts < piece.step, lasts, 0.0)
                    errors[at] += 0.5 * float(np.sum(change * passed))
        for at, of in enumerate(every):
            if of.place is None and passing:
                # Rows may agree by chance.
                errors[at] = apart(part.ends[-1][at], part.ends[0][at])
            if of.place not in passing:
                samples = np.array([*(step[0].rates[at] for step in row), last[at]])
                errors[at] = max(errors[at], span * _jump(samples))
        return errors


def _cut(waiting: list[float], accurate: float) -> None:
    """Divide the next part where it is more than twice as long as would be accurate.

    A half, a quarter or an eighth is cut off, so that parts do not follow the rates' last digits.
    """
    whole = waiting[0]
    if whole > 2 * accurate:
        cut = max(2.0 ** math.floor(math.log2(accurate / whole)), LEAST) * whole
        waiting[:1] = [cut, whole - cut]


def _jump(rates: Array) -> float:
    """Return the jump of a rate before or after evenly spaced samples, summed over the cells.

    It is their highest difference, which is small where a rate is smooth.
    """
    jump = float(np.sum(np.abs(np.diff(rates, len(rates) - 1, axis=0))))
    return jump if jump > JUMP * float(np.sum(np.max(np.abs(rates), axis=0))) else 0.0


def _beyond(values: Array, size: Array, kept: Kept) -> float:
    """Return the distance of values beyond their limits, relative to the largest."""
    over = max(kept.least - float(np.min(values)), float(np.max(values)) - kept.most, 0.0)
    return over / float(np.max(size)) if over > 0 else 0.0
