"""States over a part of an increment by Euler steps, extrapolated; and its transpose."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from tribo.core.arrays import Array, Mask
from tribo.stepping.kept import Field, Kept, Numbers, Sum
from tribo.stepping.relaxation import bending, growth, lasting

NUDGE = 3e-5
"""Part of a state by which it is moved to find how fast it relaxes, and how that changes."""
EXACT = 1e-12
"""Relative difference, summed over the cells, of what is the same but for rounding."""
PLAIN, RELAXING = (1, 2, 3), (1, 2, 3, 4)
"""Euler steps of the rows of the extrapolation, without and with the relaxation of the states."""

Values = list[Array]
Rates = Callable[[Sequence[Array], float], Values]
"""Rates of states, and after them of sums, at states and at a share of a part."""


@dataclass(frozen=True)
class Stretch:
    """States, their rates, and for how long these hold at each place: for a step, or to a break.

    `ended` has where a state, by its number, comes to a break or to a limit, and to which.
    """

    states: Values
    rates: Values
    step: float
    spans: Mapping[str, Field]
    ended: Mapping[int, tuple[Mask, Numbers]]

    def stepped(self, kept: Sequence[Kept], slopes: Sequence[Field]) -> Values:
        """Return the states at its end."""
        return [
            state + lasting(self.spans[of.place], slope) * rate
            for state, rate, slope, of in zip(self.states, self.rates, slopes, kept, strict=False)
        ]


Row = Sequence[Sequence[Stretch]]
"""Euler steps of a part, each in pieces."""


@dataclass(frozen=True)
class Part:
    """A part of an increment, solved.

    Parameters
    ----------
    kept : sequence of Kept
        The states.
    relaxing : sequence of ndarray or float
        How the rate of each state changes with itself, where that is downwards.
    rows : sequence of Row
        The Euler steps of each row of the extrapolation.
    ends : sequence of Values
        States and sums at the end of each row.
    rough : Values
        Less accurate ones.
    beyond : sequence of float
        By how much trials of each state were beyond its limits, summed over the cells.
    last : Values or None
        Rates at its end, where they are known to be those of all of it.
    turned : sequence of (int, Values, ndarray)
        Of each state that relaxes, its number, rates where it is moved, and by how much.
    """

    kept: Sequence[Kept]
    relaxing: Sequence[Field]
    rows: Sequence[Row]
    ends: Sequence[Values]
    rough: Values
    beyond: Sequence[float]
    last: Values | None = None
    turned: Sequence[tuple[int, Values, Array]] = ()

    @property
    def first(self) -> Values:
        """The rates at its beginning."""
        return self.rows[0][0][0].rates

    @property
    def pieces(self) -> list[Stretch]:
        """Those of all rows."""
        return [*chain.from_iterable(chain.from_iterable(self.rows))]

    @property
    def stages(self) -> list[Values]:
        """The rates of all stages; rows may begin with the same ones."""
        return [*(piece.rates for piece in self.pieces), *(rates for _, rates, _ in self.turned)]

    @property
    def end(self) -> Values:
        """States and sums at its end."""
        return _extrapolated(self.ends, [len(row) for row in self.rows])

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


def stepped(
    rates: Callable[[Sequence[Array]], Values],
    start: Sequence[Array],
    first: Values,
    step: float,
    slopes: Sequence[Field],
    kept: Sequence[Kept],
    sums: Sequence[Sum],
) -> tuple[Values, Values, list[Stretch]]:
    """Return states after an Euler step, what sums come to over it, and its pieces.

    Where a state comes to a break or a limit, the step ends for all states at its place, and a
    shorter one goes on from there with rates asked anew. What lies elsewhere, for these rates, is
    as it was at the beginning, as for those of the whole step.
    """
    states, found = list(start), first
    totals = [np.zeros_like(rate) for rate in first[len(states) :]]
    left: dict[str, Field] = {each.place: step for each in kept}
    pieces = list[Stretch]()
    # Rates that lead back to a break from both sides would end no step.
    most = 1 + sum(len(each.breaks) + 1 for each in kept if each.ends is not None)
    while True:
        spans, ended = dict(left), dict[int, tuple[Mask, Numbers]]()
        coming = _coming(states, found, slopes, kept, left) if len(pieces) < most else []
        for at, _, _, time in coming:
            place = kept[at].place
            if np.any((time <= left[place]) & (left[place] > 0)):
                spans[place] = np.minimum(spans[place], time)
        piece = Stretch(states, found, step, spans, ended)
        states = piece.stepped(kept, slopes)
        claimed: dict[str, Mask] = {}
        for at, end, number, time in coming:
            place = kept[at].place
            here = (time <= spans[place]) & (left[place] > 0) & ~claimed.get(place, np.False_)
            if np.any(here):
                claimed[place] = claimed.get(place, np.False_) | here
                ended[at] = here, number
                states[at] = np.where(here, end, states[at])
        totals = [
            total + each.span(spans, 0.0 if pieces else step) * rate
            for total, each, rate in zip(totals, sums, found[len(states) :], strict=True)
        ]
        pieces.append(piece)
        for place, span in spans.items():
            rest = left[place] - span
            left[place] = np.where(rest > EXACT * step, rest, 0.0) if np.ndim(rest) else 0.0
        if not any(map(np.any, left.values())):
            return states, totals, pieces
        passing = places_passing(kept, pieces)
        found = rates(
            [
                now if of.place in passing else was
                for now, was, of in zip(states, start, kept, strict=True)
            ]
        )


def places_passing(kept: Sequence[Kept], pieces: Iterable[Stretch]) -> set[str]:
    """Return the places at which a state reaches a break or a limit in some pieces."""
    return {kept[at].place for piece in pieces for at in piece.ended}


def _coming(
    states: Sequence[Array],
    rates: Values,
    slopes: Sequence[Field],
    kept: Sequence[Kept],
    left: Mapping[str, Field],
) -> list[tuple[int, Array, Numbers, Array]]:
    """Return of each state that may come to a break or a limit its number, and `Kept.next`."""
    return [
        (at, *each.next(states[at], rates[at], slopes[at]))
        for at, each in enumerate(kept)
        if each.changes(states[at], states[at] + left[each.place] * rates[at])
    ]


def solved(
    rates: Rates,
    start: Sequence[Array],
    first: Values,
    length: float,
    kept: Sequence[Kept],
    sums: Sequence[Sum],
    *,
    relaxes: bool,
    shortens: bool = True,
) -> Part:
    """Return a part of an increment, solved from its first rates on.

    Rates are asked at states that may lie beyond their limits. Where they stay as they are, but for
    the breaks that are passed, one step or two are all, if it `shortens`.
    """
    slopes: Sequence[Field] = [0.0] * len(start)
    if relaxes:
        slopes = relaxation(rates, start, first, length, kept)
    rows, ends = list[Row](), list[Values]()
    beyond = [0.0] * len(start)
    stages = RELAXING if relaxes else PLAIN
    for steps in stages:
        step, row = length / steps, list[list[Stretch]]()
        states = list(start)
        totals = [np.zeros_like(rate) for rate in first[len(start) :]]
        for taken in range(steps):
            share = taken / steps
            if taken:
                trials = zip(beyond, states, kept, strict=True)
                beyond = [max(by, apart(of.hold(state), state)) for by, state, of in trials]

            def along(values: Sequence[Array], share: float = share) -> Values:
                return rates(values, share)

            found = along(states) if taken else first
            states, more, pieces = stepped(along, states, found, step, slopes, kept, sums)
            totals = [total + each for total, each in zip(totals, more, strict=True)]
            row.append(pieces)
        rows.append(row)
        ends.append([*states, *totals])
        if shortens and steps == 2 and all(map(_same, *ends)):
            last = rates(states, 1.0)
            passes = bool(places_passing(kept, chain.from_iterable(chain(*rows))))
            constant = zip(sums, first[len(kept) :], last[len(kept) :], strict=True)
            # A sum at the place of a state is as that is.
            if all(map(_same, _ending(kept, row[-1]), last)) and all(
                _same(one, other) for of, one, other in constant if not (passes and of.place)
            ):
                rows, ends = (rows, ends) if passes else (rows[:1], ends[:1])
                return Part(kept, slopes, rows, ends, ends[-1], beyond, last)
    return Part(kept, slopes, rows, ends, _extrapolated(ends[1:], stages[1:]), beyond)


def _ending(kept: Sequence[Kept], pieces: Sequence[Stretch]) -> Values:
    """Return the rates of states that hold as a step ends."""
    ending = pieces[0].rates[: len(kept)]
    for piece in pieces[1:]:
        ending = [
            np.where(np.asarray(piece.spans[of.place]) > 0, rate, before)
            for of, rate, before in zip(kept, piece.rates, ending, strict=False)
        ]
    return ending


def _same(one: Array, other: Array) -> bool:
    """Whether two arrays are the same but for rounding."""
    return part_of(apart(one, other), np.abs(other)) <= EXACT


def retraced(
    rates: Rates,
    start: Sequence[Array],
    first: Values,
    length: float,
    kept: Sequence[Kept],
    sums: Sequence[Sum],
    parts: Sequence[tuple[float, bool]],
) -> list[Part]:
    """Return the parts of an increment as it was divided, with what `transposed` needs of them.

    `parts` are shares of it, each with whether states relax within. Rates are asked at shares of
    the increment.
    """
    passed, states, done = 0.0, list(start), list[Part]()
    for share, relaxes in parts:

        def along(
            values: Sequence[Array], at: float, passed: float = passed, share: float = share
        ) -> Values:
            return rates(values, passed + at * share)

        if passed:
            first = along(states, 0.0)
        span = share * length
        # Rates that stay as they are need not do so with another number.
        part = solved(along, states, first, span, kept, sums, relaxes=relaxes, shortens=False)
        turned = []
        for at, slope in enumerate(part.relaxing):
            if np.any(np.asarray(slope) < 0):
                other = moved(states[at], first[at], span, kept[at])
                asked = along([*states[:at], other, *states[at + 1 :]], 0.0)
                turned.append((at, asked, other - states[at]))
        done.append(replace(part, turned=turned))
        held = zip(part.end, kept, strict=False)
        passed, states = passed + share, [of.hold(state) for state, of in held]
    return done


@dataclass(frozen=True)
class Transposed:
    """Derivatives in the states before some parts, and by state in its breaks at each point."""

    states: list[Field]
    breaks: Mapping[int, Array]


def transposed(
    parts: Sequence[Part],
    states: Sequence[Field],
    sums: Sequence[tuple[Sum, Field]],
    behind: Callable[[Values, list[Field]], Sequence[Field]],
) -> Transposed:
    """Return derivatives before some parts, from those in states and sums after.

    Parameters
    ----------
    parts : sequence of Part
        From `retraced`.
    states : sequence of ndarray or float
        Derivatives in each state.
    sums : sequence of (Sum, ndarray or float)
        Sums that lie where their place does, and derivatives in them.
    behind : callable
        Returns derivatives in the states that rates were asked at, from those in the rates. What
        else they follow, it adds up by itself. It is called once for each stage.
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
                    seeds, given, times = _back(
                        part, piece, seeds, deep, times, turns, breaks, is_first=is_first
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
    return Transposed(after, breaks)


def _back(
    part: Part,
    piece: Stretch,
    seeds: Sequence[Field],
    sums: Sequence[tuple[Sum, Field]],
    times: Mapping[str, Field],
    turns: list[Field],
    breaks: dict[int, Array],
    *,
    is_first: bool,
) -> tuple[list[Field], list[Field], dict[str, Field]]:
    """Return derivatives before a piece: in states, in its rates, and in what was left of a step.

    From those in states and in what is left after it, `times`. The span of a piece that ends at a
    break follows the state that comes to it, its rate, and the break.
    """
    rates, own = piece.rates, len(part.kept)
    states = [*seeds]
    for at, (here, _) in piece.ended.items():
        # What comes to a break is there, whatever it was before.
        states[at] = np.where(here, 0.0, seeds[at])
    given: list[Field] = []
    left: dict[str, Field] = {}
    for seed, rate, slope, each in zip(states, rates, part.relaxing, part.kept, strict=False):
        span = piece.spans[each.place]
        given.append(seed * lasting(span, slope))
        left[each.place] = left.get(each.place, 0.0) + seed * rate * growth(span, slope)
    for at, slope in enumerate(part.relaxing):
        if np.ndim(slope):
            span = piece.spans[part.kept[at].place]
            turns[at] = turns[at] + states[at] * rates[at] * bending(span, slope)
    for (total, seed), rate in zip(sums, rates[own:], strict=True):
        given.append(seed * total.span(piece.spans, piece.step if is_first else 0.0))
        if total.place is not None and total.place in left:
            left[total.place] = left[total.place] + seed * rate
    for at, (here, number) in piece.ended.items():
        kept, slope, rate = part.kept[at], part.relaxing[at], rates[at]
        span = piece.spans[kept.place]
        by_span = left[kept.place] - times.get(kept.place, 0.0)
        speed = rate * growth(span, slope)
        far = np.divide(
            np.broadcast_to(by_span, rate.shape), speed, out=np.zeros(rate.shape), where=here
        )
        states[at] = states[at] - far
        given[at] = given[at] - far * lasting(span, slope)
        if np.ndim(slope):
            turns[at] = turns[at] - far * rate * bending(span, slope)
        if kept.breaks:
            at_break = np.where(here, far + seeds[at], 0.0)
            numbers = np.arange(len(kept.breaks)).reshape(-1, *[1] * number.ndim)
            breaks[at] = breaks.get(at, 0.0) + np.where(number == numbers, at_break, 0.0)
        left[kept.place] = np.where(here, times.get(kept.place, 0.0), left[kept.place])
    return states, given, left


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
