"""An Euler step of states that relax, up to where a state reaches a break; and its transpose."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from tribo.core.arrays import Array, Mask
from tribo.integration.kept import Field, Kept, Numbers, Sum, Values

LEFT = 1e-12
"""Part of a step below which its remainder is rounding."""
END = 1 + LEFT
"""Where a step reaches a break, over the step: at its end but for rounding."""
SMALL = 1e-4
"""Rise below which the derivative of its mean is computed by series."""


@dataclass(frozen=True)
class Stretch:
    """States, their rates, and for how long these hold at each place: for a step, or to a break.

    `ended` has, by the number of a state, the points that reach a break or a limit, and which.
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

    def stopped(self, kept: Sequence[Kept]) -> dict[str, Mask]:
        """Return by place the points at which a state reaches a break or a limit at its end."""
        masks: dict[str, Mask] = {}
        for at, (here, _) in self.ended.items():
            masks[kept[at].place] = masks.get(kept[at].place, np.False_) | here
        return masks

    def nearly(self, kept: Sequence[Kept], slopes: Sequence[Field]) -> Values:
        """Return the states just before its end, on this side of a break."""
        states = self.stepped(kept, slopes)
        for at, (here, number) in self.ended.items():
            near = np.nextafter(kept[at].end(number), self.states[at])
            states[at] = np.where(here, near, states[at])
        return states


def stepped(
    rates: Callable[[Sequence[Array]], Values],
    start: Sequence[Array],
    first: Values,
    step: float,
    slopes: Sequence[Field],
    kept: Sequence[Kept],
    sums: Sequence[Sum],
) -> tuple[Values, Values, list[Stretch]]:
    """Return states after an Euler step, the sums over it, and its pieces.

    Where a state reaches a break or a limit, the step ends for all states at its place, and a
    shorter step with new rates follows. For the new rates, states at other places have their values
    from the beginning, as for the rates of the whole step.
    """
    states, found = list(start), first
    totals = [np.zeros_like(rate) for rate in first[len(states) :]]
    left: dict[str, Field] = {each.place: step for each in kept}
    pieces = list[Stretch]()
    # Rates that lead back to a break from both sides would end no step.
    most = 1 + sum(len(each.breaks) + 1 for each in kept if each.ends is not None)
    while True:
        spans, ended = dict(left), dict[int, tuple[Mask, Numbers]]()
        coming = [
            (at, *each.next(states[at], found[at], slopes[at]))
            for at, each in enumerate(kept)
            # A state that relaxes gets no further than by its rate at the beginning.
            if len(pieces) < most
            and each.reaches(states[at], states[at] + left[each.place] * found[at])
        ]
        for at, _, _, time in coming:
            place = kept[at].place
            if np.any((time <= END * left[place]) & (left[place] > 0)):
                spans[place] = np.minimum(spans[place], time)
        piece = Stretch(states, found, step, spans, ended)
        states = piece.stepped(kept, slopes)
        claimed: dict[str, Mask] = {}
        for at, end, number, time in coming:
            place = kept[at].place
            here = (time <= END * spans[place]) & (left[place] > 0) & ~claimed.get(place, np.False_)
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
            left[place] = np.where(rest > LEFT * step, rest, 0.0) if np.ndim(rest) else 0.0
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


def stepped_back(
    kept: Sequence[Kept],
    slopes: Sequence[Field],
    piece: Stretch,
    seeds: Sequence[Field],
    sums: Sequence[tuple[Sum, Field]],
    times: Mapping[str, Field],
    turns: list[Field],
    breaks: dict[int, Array],
    *,
    is_first: bool,
) -> tuple[list[Field], list[Field], dict[str, Field]]:
    """Return derivatives before a piece: in states, in its rates, and in the rest of the step.

    `seeds` and `times` are the derivatives in states and in the rest of the step after it. The span
    of a piece that ends at a break depends on the state that reaches it, its rate, and the break.
    """
    rates, own = piece.rates, len(kept)
    states = [*seeds]
    for at, (here, _) in piece.ended.items():
        # A state that reaches a break is at the break, whatever it was before.
        states[at] = np.where(here, 0.0, seeds[at])
    given: list[Field] = []
    left: dict[str, Field] = {}
    for seed, rate, slope, each in zip(states, rates, slopes, kept, strict=False):
        span = piece.spans[each.place]
        given.append(seed * lasting(span, slope))
        left[each.place] = left.get(each.place, 0.0) + seed * rate * growth(span, slope)
    for at, slope in enumerate(slopes):
        if isinstance(slope, np.ndarray):
            span = piece.spans[kept[at].place]
            turns[at] = turns[at] + states[at] * rates[at] * bending(span, slope)
    for (total, seed), rate in zip(sums, rates[own:], strict=True):
        given.append(seed * total.span(piece.spans, piece.step if is_first else 0.0))
        if total.place is not None and total.place in left:
            left[total.place] = left[total.place] + seed * rate
    for at, (here, number) in piece.ended.items():
        of, slope, rate = kept[at], slopes[at], rates[at]
        span = piece.spans[of.place]
        by_span = left[of.place] - times.get(of.place, 0.0)
        speed = rate * growth(span, slope)
        far = np.divide(
            np.broadcast_to(by_span, rate.shape), speed, out=np.zeros(rate.shape), where=here
        )
        states[at] = states[at] - far
        given[at] = given[at] - far * lasting(span, slope)
        if isinstance(slope, np.ndarray):
            turns[at] = turns[at] - far * rate * bending(span, slope)
        if of.breaks:
            at_break = np.where(here, far + seeds[at], 0.0)
            numbers = np.arange(len(of.breaks)).reshape(-1, *[1] * number.ndim)
            breaks[at] = breaks.get(at, 0.0) + np.where(number == numbers, at_break, 0.0)
        left[of.place] = np.where(here, times.get(of.place, 0.0), left[of.place])
    return states, given, left


def growth(span: Field, slope: Field) -> Field:
    """Return the derivative of `lasting` in the span."""
    return np.exp(slope * np.asarray(span)) if isinstance(slope, np.ndarray) else 1.0


def lasting(step: Field, slope: Field) -> Field:
    """Return the effective length of a step where the rate has this slope in its own state."""
    if not isinstance(slope, np.ndarray):
        return step
    return step * np.asarray(scipy.special.exprel(step * slope))


def bending(step: Field, slope: Field) -> Field:
    """Return the derivative of `lasting` in the slope."""
    if not isinstance(slope, np.ndarray):
        return 0.0
    rise = np.asarray(step * slope)
    small = np.abs(rise) < SMALL
    safe = np.where(small, 1.0, rise)
    mean = scipy.special.exprel(safe)
    return step**2 * np.where(small, 0.5 + rise / 3, (np.exp(safe) - mean) / safe)
