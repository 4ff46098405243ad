"""How an increment is divided so that states within it are integrated accurately."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tribo.core.arrays import Array, Mask
from tribo.core.errors import BadValues, PluginError
from tribo.integration.integrator import Part, Share, apart, part_of, solutions
from tribo.integration.kept import Kept, Rates, Sum, Values
from tribo.integration.step_to_break import places_passing

ACCURACY = 2e-5
"""Error of an increment, summed over the cells, relative to what it integrates."""
MOST_PARTS = 100
"""Parts of an increment after which it is refused: to 1e-5 of it, a jump takes 40."""
JUMP = 0.1
"""Relative difference from a smooth rate at which a rate is taken to jump."""
FADED = 0.01
"""Part of the largest value of a state, below which its error is relative to that part."""
WHOLE = (Share(),)
"""An increment in one part."""


@dataclass(frozen=True)
class Integral:
    """States at the end of an increment, the sums over it, and the parts it was solved in.

    `passed` has by state and break, both by number, the first share of the increment at which a
    point rises to the break.
    """

    values: Values
    sums: Values
    plan: Sequence[Share]
    passed: Mapping[tuple[int, int], float]


def integrated(
    rates: Rates,
    start: Sequence[Array],
    length: float,
    kept: Sequence[Kept],
    sums: Sequence[Sum] = (),
    plan: Sequence[Share] = WHOLE,
    *,
    adapts: bool = True,
) -> Integral:
    """Integrate states and sums over an increment.

    Each part is solved by exponential Euler steps, exact for a state that relaxes linearly, which
    are extrapolated, with as many rows as the accuracy needs; where the most rows are not accurate,
    or leave the limits of a state, it is solved in two halves.
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
    plan : sequence of Share, optional
        Parts to begin with, whose sizes add up to 1.
    adapts : bool, optional
        Whether parts are divided to be accurate. They are never joined; if they are taken as they
        are, the answer follows smoothly from the rates.

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
    count, accuracy = len(start), ACCURACY if adapts else math.inf
    first = rates(start, 0.0)
    values = [*start, *(np.zeros_like(rate) for rate in first[count:])]
    peaks, breaks = [*map(np.abs, values)], dict[tuple[int, int], float]()
    waiting, done = list(plan), list[Share]()

    def along(states: Sequence[Array], passed: float) -> Values:
        held = [of.hold(state) for state, of in zip(states, kept, strict=True)]
        return rates(held, passed)

    while waiting:
        share, begun = waiting[0], [0.0] * count + values[count:]
        for taken in solutions(along, values[:count], first, length, kept, sums, share):
            end = [old + new for old, new in zip(begun, taken.end, strict=True)]
            largest = [*map(np.maximum, peaks, map(np.abs, end))]
            beyond = [*map(_beyond, end, largest, kept)]
            left = max(beyond, default=0.0) > ACCURACY
            held = [of.hold(value) for value, of in zip(end, kept, strict=False)]
            last, off = first, 0.0
            if adapts:
                sizes = [
                    np.maximum(np.maximum(np.abs(old), np.abs(new)), FADED * peak)
                    for old, new, peak in zip(values, end, largest, strict=True)
                ]
                errors = [apart(*each) for each in zip(taken.end, taken.rough, strict=True)]
                off = max(map(part_of, errors, sizes), default=0.0)
            if off > accuracy or left:
                continue
            if adapts or len(waiting) > 1:
                last = along(held, share.at(1.0))
            if adapts:
                errors = _errors(taken, share, length, sums, along, last)
                off = max(map(part_of, errors, sizes), default=0.0)
            if off <= accuracy:
                # Later parts pass later.
                later = {at: share.at(when) for at, when in taken.passed().items()}
                breaks, values, peaks = {**later, **breaks}, held + end[count:], largest
                first = last
                waiting.pop(0)
                relaxes = [np.ndim(slope) > 0 for slope in taken.relaxing]
                done.append(replace(share, rows=len(taken.rows), relaxes=relaxes))
                break
        else:
            if len(waiting) + len(done) < MOST_PARTS:
                half = 0.5 * share.size
                waiting[:1] = [Share(share.start, half), Share(share.start + half, half)]
            elif left:
                of = kept[int(np.argmax(beyond))]
                raise PluginError(
                    f"{of} leaves its limits of {of.least:g} to {of.most:g}: let its rate vanish "
                    "there"
                )
            else:
                names = ", ".join(map(str, kept))
                raise BadValues(
                    f"states ({names}) change too often to be integrated over {length:g} (m, or s "
                    "of a rest): shorten the steps, or declare the breaks where rates jump"
                )
    return Integral(values[:count], values[count:], done, breaks)


def _errors(
    part: Part, share: Share, length: float, sums: Sequence[Sum], rates: Rates, last: Values
) -> list[float]:
    """Return the error of states and sums after a part, summed over the cells.

    It is the change by the last row of the extrapolation. Where a point passes a break it is half
    the change of its rates up to the break, and from there to the end of a step; a rate that jumps
    elsewhere is in error by its jump. `last` are the rates at the end.
    """
    # States lie at their places.
    every = [*(Sum(of.place) for of in part.kept), *sums]
    passing, row = places_passing(part.kept, part.pieces), part.rows[-1]
    errors = [apart(*each) for each in zip(part.end, part.rough, strict=True)]
    stopped: Mapping[str, Mask] = {}
    for taken, pieces in enumerate(row):
        passes = stopped or pieces[0].ended
        for piece in pieces:
            begun, stopped = stopped, piece.stopped(part.kept)
            if not passes:
                continue
            found = rates(piece.nearly(part.kept, part.relaxing), share.at(taken / len(row)))
            for at, of in enumerate(every):
                if of.place in passing:
                    lasts = of.span(piece.spans, 0.0)
                    here = np.asarray(lasts < piece.step)
                    for points in (begun, stopped):
                        if of.place in points:
                            here = here | of.seen(points[of.place])
                    change = np.abs(found[at] - piece.rates[at])
                    errors[at] += 0.5 * float(np.sum(change * np.where(here, lasts, 0.0)))
    for at, of in enumerate(every):
        if of.place is None and passing:
            # Rows may agree by chance.
            errors[at] = apart(part.ends[-1][at], part.ends[0][at])
        if of.place not in passing:
            samples = np.array([*(step[0].rates[at] for step in row), last[at]])
            errors[at] = max(errors[at], share.size * length * _jump(samples))
    return errors


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
