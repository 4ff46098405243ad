"""An increment of bodies that remember, or that follow what lies between them, backwards."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial, reduce
from math import prod
from typing import NamedTuple

import numpy as np

from tribo.contact.projection import CELLS, over
from tribo.core.arrays import Array
from tribo.core.box import Box, whole
from tribo.core.contact import ContactSolution
from tribo.simulation.model import Model
from tribo.stepping.evolution import limits_of, loaded
from tribo.stepping.extrapolation import PLAIN, RELAXING
from tribo.stepping.memory import Memory
from tribo.stepping.relaxation import Limits, relaxed, relaxing
from tribo.study.gradient.course import Before, pressed, stacked
from tribo.study.gradient.linear import Carrier
from tribo.study.gradient.local import localised
from tribo.study.gradient.response import NUDGE, Arrays, Response, check_sum, local, shared
from tribo.study.gradient.tape import Slid

FINE = 1e-6
"""Part of the largest value by which what is remembered is varied."""
SMALL = 1e-4
"""Rise below which the derivative of its mean is that of its series."""


class _Place(NamedTuple):
    """Which part of an increment has passed, and over how much (m) of it means are asked for."""

    passed: float
    over: float = 0.0


@dataclass(frozen=True)
class _Rates:
    """Rates at one state, of depths and states, with their derivatives in each cell."""

    found: Arrays
    by_pressure: Sequence[Response]
    by_state: Sequence[Arrays]
    by_factor: Sequence[Arrays]
    inside: Sequence[Array]


@dataclass(frozen=True)
class _Part:
    """A part of an increment: its rates along each row of the extrapolation.

    `moved` has the rates at each state moved by a little, and by how much, where it relaxes.
    """

    length: float
    relaxing: Sequence[Array | float]
    rows: Sequence[Sequence[_Rates]]
    moved: Sequence[tuple[_Rates, Array]]


@dataclass(frozen=True)
class Remembering:
    """An increment of the bodies of a model that wear.

    `kept` are the carriers of what is remembered, in the order of `Memory.values`. `along` tells
    whether rates are integrated along the increment, as where any body remembers, and `advances`
    whether they are the means that laws know.
    """

    model: Model
    carriers: Mapping[str, Carrier]
    kept: Sequence[Carrier]
    contacts: Sequence[ContactSolution]
    slid: Slid
    along: bool
    advances: bool

    def back(self, wear: Mapping[str, Array], states: Memory) -> Before:
        """Return derivatives before it from those in the depths and what is remembered after."""
        states = replace(states, laws={name: states.laws[name] for name in self.model.laws})
        (own, load, square, *factor), before = self._back(
            [wear[name] for name in self.model.laws], states.values
        )
        factors = dict(zip(self.model.laws, factor, strict=True))
        pressure = own + load + square * self._pressure
        return Before(pressure, wear, states.with_values(iter(before)), factors)

    @cached_property
    def bodies(self) -> Sequence[tuple[Carrier, Array]]:
        """Of each body its carrier and what its depth follows pressures by.

        Where one wears alone, a point's depth depends on the pressures of its own cells, and on
        what it itself remembers: one way back, from 1 on each point, has all derivatives.
        """
        shapes = [(carrier.rows, self.model.grid.cells[1]) for carrier in self._own]
        states = [np.zeros_like(value) for value in self.slid.before.values]
        found = []
        for at, carrier in enumerate(self._own):
            ones = [np.full(shape, float(at == i)) for i, shape in enumerate(shapes)]
            found.append((carrier, self._back(ones, states)[0][0]))
        return found

    @cached_property
    def _own(self) -> Sequence[Carrier]:
        return [self.carriers[name] for name in self.model.laws]

    @cached_property
    def _pressure(self) -> Array:
        return np.stack([contact.pressure for contact in self.contacts])

    @cached_property
    def _shares(self) -> Array:
        return np.array([position.share for position in self.model.cycle])

    def _told(self, place: _Place, pressure: Array | None = None) -> Sequence[ContactSolution]:
        """Return the contacts as laws are told of them where a part of the increment has passed."""
        contacts = self.contacts if pressure is None else pressed(self.contacts, pressure)
        if not self.along:
            return contacts
        end, half = self.slid.moment, 0.5 * self.slid.increment
        return loaded(self.model, contacts, end.back(half).time, end.time, place.passed)

    def _asked(
        self,
        states: Sequence[Array],
        place: _Place,
        told: Sequence[ContactSolution] | None = None,
        model: Model | None = None,
    ) -> Arrays:
        """Return the rates at each position where a part of the increment has passed."""
        moment = self.slid.moment
        if self.along:
            moment = moment.back((1 - place.passed) * self.slid.increment)
            moment = replace(moment, over=place.over)
        memory = self.slid.before.with_values(iter(states))
        return stacked(model or self.model, told or self._told(place), memory, moment)

    def _by_pressure(self, states: Sequence[Array], place: _Place) -> list[Response]:
        if self.model.effects:
            return shared(
                lambda p: self._asked(states, place, self._told(place, p)), self._pressure
            )
        told = self._told(place)
        pressure = np.stack([contact.pressure for contact in told])
        found = local(lambda p: self._asked(states, place, pressed(told, p)), pressure)
        if told is self.contacts:
            return found
        # Along the increment pressures are told in proportion to the load.
        total = over(np.sum(self._pressure, CELLS))
        longer = over(np.sum(pressure, CELLS)) / total
        of_own = [longer * each.own for each in found]
        return [Response(own, -own * self._pressure / total) for own in of_own]

    def _by_factor(self, states: Sequence[Array], place: _Place, found: Arrays) -> list[Arrays]:
        names = list(self.model.laws)
        if not self.slid.before.between:
            zeros = [np.zeros_like(rate) for rate in found]
            return [[*zeros[:at], found[at], *zeros[at + 1 :]] for at in range(len(names))]
        of_bodies = []
        for name, carrier in zip(names, self._own, strict=True):
            ones = np.ones((carrier.rows, self.model.grid.cells[1]))
            ends = (
                self._asked(states, place, model=localised(self.model, {name: by * ones}))
                for by in (1 + NUDGE, 1 - NUDGE)
            )
            pairs = zip(*ends, strict=True)
            of_bodies.append([(up - down) / (2 * NUDGE) for up, down in pairs])
        return of_bodies

    @cached_property
    def _limits(self) -> list[Limits]:
        return limits_of(self.model, self.slid.before)

    def _held(self, states: Sequence[Array]) -> Arrays:
        pairs = zip(states, self._limits, strict=True)
        return [np.clip(state, limit.least, limit.most) for state, limit in pairs]

    def _apart(self, states: Arrays, nudges: Arrays) -> tuple[Arrays, Arrays, Arrays]:
        """Return states moved up and down as far as they may be, and how far apart they lie."""
        higher, lower = (
            self._held([s + sign * by for s, by in zip(states, nudges, strict=True)])
            for sign in (1, -1)
        )
        pairs = zip(self.kept, higher, lower, strict=True)
        return higher, lower, [kept.seen(up - down, self._window) for kept, up, down in pairs]

    def _local(self, states: Sequence[Array], place: _Place) -> _Rates:
        """Return rates with their derivatives, where a part of the increment has passed."""
        held, by_state = self._held(states), []
        found = self._asked(held, place)
        nudges = self._nudges(held, found)
        higher, lower, apart = self._apart(held, nudges)
        for at, span in enumerate(apart):
            ends = (
                self._asked([*held[:at], end[at], *held[at + 1 :]], place)
                for end in (higher, lower)
            )
            by_state.append([(up - down) / span for up, down in zip(*ends, strict=True)])
        inside = [s == h for s, h in zip(states, held, strict=True)]
        by_pressure = self._by_pressure(held, place)
        by_factor = self._by_factor(held, place, found)
        return _Rates(found, by_pressure, by_state, by_factor, inside)

    def _check(self, rates: _Rates, states: Sequence[Array], place: _Place) -> None:
        """Refuse effects of which a change in all at once is not the sum of its parts."""
        random, held = np.random.default_rng(0), self._held(states)
        nudges = [
            by * random.uniform(0.5, 1.5, state.shape)
            for by, state in zip(self._nudges(held, rates.found), held, strict=True)
        ]
        by = NUDGE * self._pressure * random.uniform(-1, 1, self._pressure.shape)
        *ends, apart = self._apart(held, nudges)
        higher, lower = (
            self._asked(end, place, self._told(place, self._pressure + sign * by))
            for end, sign in zip(ends, (1, -1), strict=True)
        )
        expected = [each.change(self._pressure, 2 * by) for each in rates.by_pressure]
        for span, slopes in zip(apart, rates.by_state, strict=True):
            expected = [total + span * slope for total, slope in zip(expected, slopes, strict=True)]
        who = ", ".join(repr(effect.component.type) for effect in self.model.effects)
        found = [up - down for up, down in zip(higher, lower, strict=True)]
        check_sum(expected, found, rates.found, who)

    def _nudges(self, states: Sequence[Array], found: Arrays) -> Arrays:
        """Return by how much each state is varied to find what follows it."""
        nudges = []
        for state, rate in zip(states, found[len(self._own) :], strict=True):
            fastest = self.slid.increment * float(np.max(np.abs(rate)))
            largest = max(float(np.max(np.abs(state))), fastest) or 1.0
            nudges.append(np.full_like(state, FINE * largest))
        return nudges

    @cached_property
    def _parts(self) -> list[_Part]:
        """Go through the increment as it was divided, once more."""
        slid, limits, passed = self.slid, self._limits, 0.0
        found: list[_Part] = []
        states = slid.before.values
        if not self.along:
            alone = self._local([], _Place(1.0))
            self._check(alone, [], _Place(1.0))
            return [_Part(slid.increment, [], [[alone]], [])]
        for share, relaxes in slid.plan.parts:
            span = share * slid.increment
            begin = self._place(passed, span)
            start = self._local(states, begin)
            if self.model.effects and not found:
                self._check(start, states, begin)
            of_states: list[Array | float] = [0.0] * len(states)
            moved = []
            if relaxes:
                at_start = partial(self._of_states, begin)
                of_states = relaxing(at_start, states, at_start(states), span, limits)
                for at, nudge in enumerate(self._nudges(states, start.found)):
                    state = states[at]
                    by = np.where(state + nudge > limits[at].most, -nudge, nudge)
                    other = [*states[:at], state + by, *states[at + 1 :]]
                    moved.append((self._local(other, begin), by))
            rows, ends = [], [np.zeros_like(state) for state in states]
            stages = RELAXING if relaxes else PLAIN
            for steps in stages:
                first = start
                if steps > 1 and self.advances:
                    first = self._local(states, self._place(passed, span / steps))
                row, end = self._row(states, first, of_states, passed, share, steps)
                rows.append(row)
                counts = _counts(steps, stages)
                ends = [total + counts * each for total, each in zip(ends, end, strict=True)]
            found.append(_Part(span, of_states, rows, moved))
            states = self._held(ends)
            passed += share
        return found

    def _means(self, rates: Arrays) -> Arrays:
        """Return the mean rates of what is remembered, where it lies."""
        pairs = zip(self.kept, rates[len(self._own) :], strict=True)
        return [kept.mean(rate, self._shares) for kept, rate in pairs]

    def _of_states(self, place: _Place, values: Sequence[Array], *_: float) -> Arrays:
        return self._means(self._asked(values, place))

    def _place(self, passed: float, over: float) -> _Place:
        return _Place(passed, over if self.advances else 0.0)

    def _row(
        self,
        states: Arrays,
        start: _Rates,
        of_states: Sequence[Array | float],
        passed: float,
        share: float,
        steps: int,
    ) -> tuple[list[_Rates], Arrays]:
        """Return the rates along some Euler steps, and the states at their end."""
        row, step = [start], share * self.slid.increment / steps
        for taken in range(1, steps + 1):
            means = self._means(row[-1].found)
            states = [
                state + step * mean * relaxed(step * slope)
                for state, mean, slope in zip(states, means, of_states, strict=True)
            ]
            if taken < steps:
                row.append(self._local(states, self._place(passed + share * taken / steps, step)))
        return row, states

    def _back(self, depth: Arrays, after: Arrays) -> tuple[Arrays, Arrays]:
        """Return derivatives in what an increment depends on, and in the states before.

        The first are in the pressure of each cell, the load and Σp²/2 of each position, and factors
        on the bodies' rates.
        """
        total: Arrays = []

        def add(found: Arrays) -> None:
            total[:] = [a + b for a, b in zip(total, found, strict=True)] if total else found

        for part in reversed(self._parts):
            before = [np.zeros_like(seed) for seed in after]
            bends = [np.zeros_like(seed) for seed in after]
            stages = [len(row) for row in part.rows]
            for steps, row in zip(stages, part.rows, strict=True):
                counts = _counts(steps, stages)
                seeds = [counts * seed for seed in after]
                step = part.length / steps
                for rates in reversed(row):
                    means = self._means(rates.found)
                    deep = [step * counts * seed for seed in depth]
                    for at, slope in enumerate(part.relaxing):
                        bends[at] += seeds[at] * means[at] * step**2 * _steeper(step * slope)
                    each = [
                        seed * step * relaxed(step * slope)
                        for seed, slope in zip(seeds, part.relaxing, strict=True)
                    ]
                    found, states = self._behind(rates, [*deep, *each])
                    add(found)
                    seeds = [seed + state for seed, state in zip(seeds, states, strict=True)]
                before = [old + seed for old, seed in zip(before, seeds, strict=True)]
            for at, (rates, by) in enumerate(part.moved):
                for where, sign in ((rates, 1.0), (part.rows[0][0], -1.0)):
                    seeds = [np.zeros_like(seed) for seed in (*depth, *after)]
                    falls = np.asarray(part.relaxing[at]) < 0
                    seeds[len(depth) + at] = sign * falls * bends[at] / by
                    found, states = self._behind(where, seeds)
                    add(found)
                    before = [old + state for old, state in zip(before, states, strict=True)]
            after = before
        return total, after

    @property
    def _window(self) -> Box:
        return whole(self.model.grid.cells)

    def _behind(self, rates: _Rates, seeds: Arrays) -> tuple[Arrays, Arrays]:
        """Return derivatives, as `_back`, from those in the rates of depths and states."""
        seen = [
            carrier.part * carrier.seen(seed, self._window)
            for carrier, seed in zip((*self._own, *self.kept), seeds, strict=True)
        ]

        def through(slopes: Sequence[Array | float]) -> Array:
            return reduce(np.add, map(np.multiply, seen, slopes))

        own = through([each.own for each in rates.by_pressure])
        load, square = (
            over(np.sum(through(slopes), CELLS))
            for slopes in (
                [each.load for each in rates.by_pressure],
                [each.square for each in rates.by_pressure],
            )
        )
        weights = over(self._shares)
        factors = [
            carrier.gathered(weights * through(slopes), self._window)
            for carrier, slopes in zip(self._own, rates.by_factor, strict=True)
        ]
        states = [
            inside * kept.gathered(weights * through(slopes), self._window)
            for kept, inside, slopes in zip(self.kept, rates.inside, rates.by_state, strict=True)
        ]
        return [own, load, square, *factors], states


def _steeper(rise: Array | float) -> Array:
    """Return the derivative of `relaxed`."""
    small = np.abs(rise) < SMALL
    safe = np.where(small, 1.0, rise)
    return np.where(small, 0.5 + np.asarray(rise) / 3, (np.exp(safe) - relaxed(safe)) / safe)


def _counts(steps: int, stages: Sequence[int]) -> float:
    """Return what a row of the extrapolation counts for in its end."""
    return prod(steps / (steps - other) for other in stages if other != steps)
