"""An increment of bodies that remember, or that follow what lies between them, backwards."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import prod

import numpy as np

from tribo.core.arrays import Array
from tribo.stepping.extrapolation import PLAIN, RELAXING
from tribo.stepping.memory import Memory
from tribo.stepping.relaxation import relaxed, relaxing
from tribo.study.gradient.asked import Place
from tribo.study.gradient.course import Before, Other
from tribo.study.gradient.linear import Carrier
from tribo.study.gradient.response import NUDGE, Arrays
from tribo.study.gradient.slopes import Slopes, Sloping

SMALL = 1e-4
"""Rise below which the derivative of its mean is that of its series."""


@dataclass(frozen=True)
class _Part:
    """A part of an increment: its rates along each row of the extrapolation.

    `moved` has each state that relaxes, the rates where it is moved by a little, and by how much.
    """

    length: float
    relaxing: Sequence[Array | float]
    rows: Sequence[Sequence[Slopes]]
    moved: Sequence[tuple[int, Slopes, Array]]


@dataclass(frozen=True)
class _Followed:
    """The derivatives of an objective in what rates an increment asked for, and in ln(its length).

    `seeds` are those in the `means` of each of them; with `by_length` these stay as they are.
    """

    seeds: Sequence[tuple[Slopes, Arrays]]
    by_length: float


@dataclass(frozen=True)
class Remembering:
    """An increment of the bodies of a model that wear, of which these rates are asked."""

    asked: Sloping

    def back(self, wear: Mapping[str, Array], states: Memory) -> Before:
        """Return derivatives before it from those in the depths and what is remembered after."""
        laws = self.asked.model.laws
        states = replace(states, laws={name: states.laws[name] for name in laws})
        # What the depths in layers come to within the increment counts as their wear.
        within = [np.zeros_like(wear[name]) for name in self.asked.layered]
        (own, load, square, *factor), before, followed = self._back(
            [wear[name] for name in laws], [*states.values, *within]
        )
        factors = dict(zip(laws, factor, strict=True))
        pressure, each = own + load + square * self.asked.pressure, iter(before)
        states = states.with_values(each)
        through = {
            name: wear[name] + seed for name, seed in zip(self.asked.layered, each, strict=True)
        }
        return Before(
            pressure, {**wear, **through}, states, factors, partial(self._through, followed)
        )

    def _through(self, followed: _Followed, other: Other) -> float:
        laws = self.asked.model.laws
        if not other.wears & laws.keys():
            return 0.0
        asked = replace(
            self.asked,
            model=replace(other.model, laws={name: other.model.laws[name] for name in laws}),
            carriers=other.carriers,
            slid=replace(other.slid, before=self.asked.slid.before),
        )
        longer = asked.slid.increment / self.asked.slid.increment
        # Rates follow the length where they are means over it, or loads change along it.
        asks = other.asks & laws.keys() or self.asked.follows_length
        total = (longer - 1) * followed.by_length
        if not asks and other.carriers is self.asked.carriers:
            return total
        for slopes, seeds in followed.seeds:
            found = slopes.found
            if asks:
                place = slopes.place._replace(over=longer * slopes.place.over)
                found = asked.rates(slopes.states, asked.in_layers(slopes.states, place))
            changed = zip(seeds, asked.means(found), slopes.means, strict=True)
            total += sum(float(np.sum(seed * (mean - was))) for seed, mean, was in changed)
        return total

    @cached_property
    def bodies(self) -> Sequence[tuple[Carrier, Array]]:
        """Of each body its carrier and what its depth follows pressures by.

        Where one wears alone, a point's depth depends on the pressures of its own cells, and on
        what it itself remembers: one way back, from 1 on each point, has all derivatives.
        """
        own, columns = self.asked.own, self.asked.model.grid.cells[1]
        states = [np.zeros_like(value) for value in self.asked.begin]
        found = []
        for at, carrier in enumerate(own):
            ones = [np.full((each.rows, columns), float(at == i)) for i, each in enumerate(own)]
            (pressure, *_), *_ = self._back(ones, states)
            found.append((carrier, pressure))
        return found

    @cached_property
    def _parts(self) -> list[_Part]:
        """Go through the increment as it was divided, once more."""
        asked, slid, passed = self.asked, self.asked.slid, 0.0
        found: list[_Part] = []
        states = asked.begin
        start, _ = asked.first
        if not asked.along:
            return [_Part(slid.increment, [0.0] * len(states), [[start]], [])]
        for share, relaxes in slid.plan.parts:
            span = share * slid.increment
            begin = Place(passed, span)
            if found:
                start = asked.sloped(states, begin)
            of_states: list[Array | float] = [0.0] * len(states)
            moved = []
            if relaxes:
                at_start = partial(asked.of_states, begin)
                of_states = relaxing(at_start, states, at_start(states), span, asked.limits)
                for at, nudge in enumerate(asked.nudges(states, start.found, NUDGE)):
                    if np.any(np.asarray(of_states[at]) < 0):
                        other = [*states[:at], states[at] + nudge, *states[at + 1 :]]
                        moved.append((at, asked.sloped(other, begin), nudge))
            rows, ends = [], [np.zeros_like(state) for state in states]
            stages = RELAXING if relaxes else PLAIN
            for steps in stages:
                first = start
                if steps > 1 and asked.of_steps:
                    first = asked.sloped(states, Place(passed, span / steps))
                row, end = self._row(states, first, of_states, passed, share, steps)
                rows.append(row)
                counts = _counts(steps, stages)
                ends = [total + counts * each for total, each in zip(ends, end, strict=True)]
            found.append(_Part(span, of_states, rows, moved))
            states = asked.held(ends)
            passed += share
        return found

    def _row(
        self,
        states: Arrays,
        start: Slopes,
        of_states: Sequence[Array | float],
        passed: float,
        share: float,
        steps: int,
    ) -> tuple[list[Slopes], Arrays]:
        """Return the rates along some Euler steps, and the states at their end."""
        asked, row, step = self.asked, [start], share * self.asked.slid.increment / steps
        for taken in range(1, steps + 1):
            means = row[-1].means[len(asked.own) :]
            states = [
                state + step * mean * relaxed(step * slope)
                for state, mean, slope in zip(states, means, of_states, strict=True)
            ]
            if taken < steps:
                place = Place(passed + share * taken / steps, step)
                row.append(asked.sloped(states, place))
        return row, states

    def _back(self, depth: Arrays, after: Arrays) -> tuple[Arrays, Arrays, _Followed]:
        """Return derivatives in what an increment depends on, in the states before, and in rates.

        The first are in the pressure of each cell, the load and Σp²/2 of each position, and factors
        on the bodies' rates.
        """
        total: Arrays = []
        followed, by_length = list[tuple[Slopes, Arrays]](), 0.0

        def behind(rates: Slopes, seeds: Arrays) -> Arrays:
            found, states = self.asked.behind(rates, seeds)
            total[:] = [a + b for a, b in zip(total, found, strict=True)] if total else found
            followed.append((rates, seeds))
            return states

        for part in reversed(self._parts):
            before = [np.zeros_like(seed) for seed in after]
            bends = [np.zeros_like(seed) for seed in after]
            stages = [len(row) for row in part.rows]
            for steps, row in zip(stages, part.rows, strict=True):
                counts = _counts(steps, stages)
                seeds = [counts * seed for seed in after]
                step = part.length / steps
                for rates in reversed(row):
                    means = rates.means[len(depth) :]
                    deep = [step * counts * seed for seed in depth]
                    for at, slope in enumerate(part.relaxing):
                        bends[at] += seeds[at] * means[at] * step**2 * _steeper(step * slope)
                    each = [
                        seed * step * relaxed(step * slope)
                        for seed, slope in zip(seeds, part.relaxing, strict=True)
                    ]
                    states = behind(rates, [*deep, *each])
                    for seed, mean in zip((*deep, *each), rates.means, strict=True):
                        by_length += float(np.sum(seed * mean))
                    seeds = [seed + state for seed, state in zip(seeds, states, strict=True)]
                before = [old + seed for old, seed in zip(before, seeds, strict=True)]
            for bend, slope in zip(bends, part.relaxing, strict=True):
                by_length += float(np.sum(bend * slope))
            for at, rates, by in part.moved:
                for where, sign in ((rates, 1.0), (part.rows[0][0], -1.0)):
                    seeds = [np.zeros_like(seed) for seed in (*depth, *after)]
                    falls = np.asarray(part.relaxing[at]) < 0
                    seeds[len(depth) + at] = sign * falls * bends[at] / by
                    states = behind(where, seeds)
                    before = [old + state for old, state in zip(before, states, strict=True)]
            after = before
        return total, after, _Followed(followed, by_length)


def _steeper(rise: Array | float) -> Array:
    """Return the derivative of `relaxed`."""
    small = np.abs(rise) < SMALL
    safe = np.where(small, 1.0, rise)
    return np.where(small, 0.5 + np.asarray(rise) / 3, (np.exp(safe) - relaxed(safe)) / safe)


def _counts(steps: int, stages: Sequence[int]) -> float:
    """Return what a row of the extrapolation counts for in its end."""
    return prod(steps / (steps - other) for other in stages if other != steps)
