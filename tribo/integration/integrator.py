"""States over a part of an increment by Euler steps, extrapolated; and its transpose."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from tribo.core.arrays import Array
from tribo.integration.kept import Field, Kept, Rates, Sum, Values
from tribo.integration.step_to_break import Stretch, places_passing, stepped, stepped_back

NUDGE = 3e-5
"""Part of a state by which it is moved to determine its relaxation rate."""
MOST_ROWS = 4
"""Rows of the extrapolation, of 1, 2, … Euler steps."""

Row = Sequence[Sequence[Stretch]]
"""Euler steps of a part, each in pieces."""


@dataclass(frozen=True)
class Share:
    """How a part of an increment is solved.

    Parameters
    ----------
    start, size : float
        Where it begins, and its length, over the length of the increment.
    rows : int
        The least rows of its extrapolation.
    relaxes : sequence of bool, optional
        Whether the rate of each state may fall with the state; if left out, any may.
    """

    start: float = 0.0
    size: float = 1.0
    rows: int = 2
    relaxes: Sequence[bool] | None = None

    def at(self, part: float) -> float:
        """Return the share of the increment that has passed after a part of it."""
        return self.start + part * self.size


@dataclass(frozen=True)
class Part:
    """A part of an increment, solved.

    Parameters
    ----------
    kept : sequence of Kept
        The states.
    relaxing : sequence of ndarray or float
        Derivative of the rate of each state in the state, where negative.
    rows : sequence of Row
        The Euler steps of each row of the extrapolation.
    ends : sequence of Values
        States and sums at the end of each row.
    turned : sequence of (int, Values, ndarray)
        For each state that relaxes, its number, the rates with it moved, and the displacement.
    """

    kept: Sequence[Kept]
    relaxing: Sequence[Field]
    rows: Sequence[Row]
    ends: Sequence[Values]
    turned: Sequence[tuple[int, Values, Array]]

    @property
    def first(self) -> Values:
        """The rates at its beginning."""
        return self.rows[0][0][0].rates

    @property
    def pieces(self) -> list[Stretch]:
        """The stretches of all rows."""
        return [*chain.from_iterable(chain.from_iterable(self.rows))]

    @property
    def stages(self) -> list[Values]:
        """The rates of all stages; rows may begin with the same ones."""
        return [*(piece.rates for piece in self.pieces), *(rates for _, rates, _ in self.turned)]

    @property
    def end(self) -> Values:
        """States and sums at its end."""
        return _extrapolated(self.ends, 1)

    @property
    def rough(self) -> Values:
        """States and sums at its end, less accurate."""
        return _extrapolated(self.ends[1:], 2)

    def passed(self) -> dict[tuple[int, int], float]:
        """Return by state and break the first share of it at which a point rises to the break."""
        found: dict[tuple[int, int], float] = {}
        row = self.rows[-1]
        for at, pieces in enumerate(row):
            gone: dict[str, Field] = {}
            for piece in pieces:
                for place, span in piece.spans.items():
                    gone[place] = gone.get(place, 0.0) + span
                for state, (here, number) in piece.ended.items():
                    times = np.broadcast_to(gone[self.kept[state].place], here.shape)
                    rises = here & (piece.rates[state] > 0)
                    for each in np.unique(number[rises]):
                        first = float(np.min(times[rises & (number == each)])) / piece.step
                        share = (at + first) / len(row)
                        found[state, int(each)] = min(share, found.get((state, int(each)), 1.0))
        return found


def solutions(
    rates: Rates,
    start: Sequence[Array],
    first: Values,
    length: float,
    kept: Sequence[Kept],
    sums: Sequence[Sum],
    share: Share,
) -> Iterator[Part]:
    """Yield a part of an increment, solved from its first rates on, with ever more rows.

    Rates are evaluated at states that may exceed their limits, and at shares of the increment.
    """
    span = share.size * length
    slopes, turned = relaxation(rates, start, first, span, kept, share)
    rows, ends = list[Row](), list[Values]()
    for steps in range(1, MOST_ROWS + 1):
        step, row, states = span / steps, list[list[Stretch]](), list(start)
        totals = [np.zeros_like(rate) for rate in first[len(start) :]]
        for taken in range(steps):

            def along(values: Sequence[Array], passed: float = share.at(taken / steps)) -> Values:
                return rates(values, passed)

            found = along(states) if taken else first
            states, more, pieces = stepped(along, states, found, step, slopes, kept, sums)
            totals = [total + each for total, each in zip(totals, more, strict=True)]
            row.append(pieces)
        rows.append(row)
        ends.append([*states, *totals])
        if steps >= share.rows:
            yield Part(kept, slopes, [*rows], [*ends], turned)


def retraced(
    rates: Rates,
    start: Sequence[Array],
    first: Values,
    length: float,
    kept: Sequence[Kept],
    sums: Sequence[Sum],
    shares: Sequence[Share],
) -> list[Part]:
    """Return the parts of an increment as it was divided, for `transposed`."""
    states, done = list(start), list[Part]()
    for share in shares:
        if done:
            first = rates(states, share.start)
        done.append(next(solutions(rates, states, first, length, kept, sums, share)))
        states = [of.hold(state) for state, of in zip(done[-1].end, kept, strict=False)]
    return done


def transposed(
    parts: Sequence[Part],
    states: Sequence[Field],
    sums: Sequence[tuple[Sum, Field]],
    behind: Callable[[Values, list[Field]], Sequence[Field]],
) -> tuple[list[Field], Mapping[int, Array]]:
    """Return derivatives in the states before some parts, and by state in its breaks at each point.

    Parameters
    ----------
    parts : sequence of Part
        From `retraced`.
    states : sequence of ndarray or float
        Derivatives in each state.
    sums : sequence of (Sum, ndarray or float)
        Sums that lie where their place does, and derivatives in them.
    behind : callable
        Returns derivatives in the states of a stage from derivatives in its rates, and itself
        accumulates derivatives in other inputs. It is called once for each stage.
    """
    after = [*states]
    breaks: dict[int, Array] = {}
    for part in reversed(parts):
        before: list[Field] = [0.0] * len(after)
        turns: list[Field] = [0.0] * len(after)
        starts = list[tuple[Values, list[Field]]]()
        lengths = [len(row) for row in part.rows]
        for row in part.rows:
            share = weight(len(row), lengths)
            seeds: list[Field] = [share * seed for seed in after]
            deep = [(each, share * seed) for each, seed in sums]
            for pieces in reversed(row):
                times: dict[str, Field] = {}
                passing = places_passing(part.kept, pieces)
                elsewhere = [of.place not in passing for of in part.kept]
                begun: list[Field] = [0.0] * len(after)
                for piece in reversed(pieces):
                    is_first = piece is pieces[0]
                    seeds, given, times = stepped_back(
                        part.kept,
                        part.relaxing,
                        piece,
                        seeds,
                        deep,
                        times,
                        turns,
                        breaks,
                        is_first=is_first,
                    )
                    if piece.rates is row[0][0].rates:
                        _join(starts, piece.rates, given)
                        continue
                    for at, more_of in enumerate(behind(piece.rates, given)):
                        of = begun if elsewhere[at] and not is_first else seeds
                        of[at] = of[at] + more_of
                seeds = _added(seeds, begun)
            before = _added(before, seeds)
        for at, asked, by in part.turned:
            seed = (np.asarray(part.relaxing[at]) < 0) * turns[at] / by
            for stage, sign in ((asked, 1.0), (part.first, -1.0)):
                given = [0.0] * len(stage)
                given[at] = sign * seed
                _join(starts, stage, given)
        for stage, given in starts:
            before = _added(before, behind(stage, given))
        after = before
    return after, breaks


def relaxation(
    rates: Rates,
    states: Sequence[Array],
    first: Sequence[Array],
    length: float,
    kept: Sequence[Kept],
    share: Share,
) -> tuple[list[Field], list[tuple[int, Values, Array]]]:
    """Return the derivative of the rate of each state in the state, where negative.

    With it come `Part.turned`. States are moved by a part of their largest value, past no break or
    limit.
    """
    found: list[Field] = [0.0] * len(states)
    turned = []
    for at, (state, rate, of) in enumerate(zip(states, first, kept, strict=False)):
        largest = max(float(np.max(np.abs(state))), length * float(np.max(np.abs(rate))))
        if largest == 0 or not (share.relaxes is None or share.relaxes[at]):
            continue
        other = of.aside(state, NUDGE * largest)
        asked = rates([*states[:at], other, *states[at + 1 :]], share.start)
        slope = (asked[at] - rate) / (other - state)
        if np.any(slope < 0):
            found[at] = np.minimum(slope, 0.0)
            turned.append((at, asked, other - state))
    return found, turned


def weight(steps: int, rows: Sequence[int]) -> float:
    """Return the weight of a row of so many steps in the extrapolation of all rows."""
    return math.prod(steps / (steps - other) for other in rows if other != steps)


def apart(one: Array, other: Array) -> float:
    """Return the absolute difference of two arrays, summed over the cells."""
    return float(np.sum(np.abs(one - other)))


def part_of(amount: float, size: Array) -> float:
    """Return an amount relative to a size, summed over the cells."""
    whole = float(np.sum(size))
    if whole > 0:
        return amount / whole
    # Of what comes out as 0 nothing tells how large it is.
    return 0.0 if amount == 0 else math.inf


def _extrapolated(ends: Sequence[Values], fewest: int) -> Values:
    """Return the ends of rows of `fewest` Euler steps and more, extrapolated to infinitely many."""
    steps = range(fewest, fewest + len(ends))
    *rough, last = ends
    total = list(last)
    for own, end in zip(steps, rough, strict=False):
        # So a state that stays as it is does so to the last bit.
        pairs = zip(total, end, last, strict=True)
        total = [value + weight(own, steps) * (each - fine) for value, each, fine in pairs]
    return total


def _join(seeded: list[tuple[Values, list[Field]]], stage: Values, seeds: Sequence[Field]) -> None:
    """Add derivatives in the rates of a stage to the derivatives already listed for it."""
    for at, (other, before) in enumerate(seeded):
        if other is stage:
            seeded[at] = stage, _added(before, seeds)
            return
    seeded.append((stage, [*seeds]))


def _added(one: Sequence[Field], other: Sequence[Field]) -> list[Field]:
    return [a + b for a, b in zip(one, other, strict=True)]
