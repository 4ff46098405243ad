"""An increment of bodies that remember, or that follow what lies between them, backwards."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import chain
from math import prod
from typing import Generic, TypeVar

import numpy as np

from tribo.contact.projection import CELLS, over
from tribo.core.arrays import Array
from tribo.stepping.memory import Memory
from tribo.stepping.neville import EXACT, PLAIN, RELAXING, apart, part_of
from tribo.stepping.relaxation import bending, lasting, relaxing
from tribo.study.gradient.course import Before, Other
from tribo.study.gradient.linear import Carrier
from tribo.study.gradient.passing import lowered, with_bottoms
from tribo.study.gradient.response import NUDGE, Arrays, Field
from tribo.study.gradient.slopes import Slopes, Sloping
from tribo.study.gradient.stages import Place, Stage, together

_Seeded = tuple[Slopes, Sequence[Field]]
"""Rates, and the derivatives in them."""


Kind = TypeVar("Kind", bound=Stage)


@dataclass(frozen=True)
class _Part(Generic[Kind]):
    """A part of an increment: its stages along each row of the extrapolation.

    `moved` has each state that relaxes, the stage where it is moved by a little, and by how much.
    """

    length: float
    relaxing: Sequence[Field]
    rows: Sequence[Sequence[Kind]]
    moved: Sequence[tuple[int, Kind, Array]]

    @property
    def stages(self) -> list[Kind]:
        """All of them; rows may begin with the same one."""
        return [*chain(*self.rows), *(stage for _, stage, _ in self.moved)]


@dataclass(frozen=True)
class _Along:
    """Derivatives of an objective along an increment.

    `rates` has those in the `means` of rates along it, `moved` those in rates that only tell how
    fast states relax, and `bent` those in ln(its length) where all these stay as they are.
    """

    rates: Sequence[_Seeded]
    moved: Sequence[_Seeded]
    bent: Sequence[Field]
    asked: Sloping

    def plus(self, other: _Along, by: Array) -> _Along:
        """Return the sum with another's, times a number at each point."""
        return _Along(
            _plus(self.rates, other.rates, by),
            _plus(self.moved, other.moved, by),
            _added(self.bent, _times(by, other.bent)),
            self.asked,
        )

    @cached_property
    def by_cell(self) -> Arrays:
        """The derivatives in the rates at each cell, shape (stages, positions, nx, ny)."""
        shares = over(self.asked.shares)
        each = [self.asked.seen(seeds) for _, seeds in self.seeded]
        shape = self.seeded[0][0].rates[0].shape
        return [
            np.stack([np.broadcast_to(shares * seed, shape) for seed in of_rate])
            for of_rate in zip(*each, strict=True)
        ]

    @cached_property
    def seeded(self) -> Sequence[_Seeded]:
        """All rates, and the derivatives in their means."""
        return [*self.rates, *self.moved]

    @cached_property
    def states(self) -> Arrays:
        """What is remembered at their stages, shape (stages, rows, ny)."""
        return together([slopes.states for slopes, _ in self.seeded])

    @cached_property
    def by_bottoms(self) -> dict[str, list[float]]:
        """The derivatives in the depths at which layers end, by body."""
        found = {
            name: [0.0] * len(self.asked.model.laws[name].bottoms) for name in self.asked.layered
        }
        for rates, seeds in self.seeded:
            for name, more in self.asked.by_bottoms(rates, seeds).items():
                found[name] = [a + b for a, b in zip(found[name], more, strict=True)]
        return found

    @cached_property
    def by_length(self) -> float:
        """The derivative in ln(its length) where the rates stay as they are."""
        parts = [
            seed * mean
            for rates, seeds in self.rates
            for seed, mean in zip(seeds, rates.means, strict=True)
        ]
        return sum(float(np.sum(each)) for each in (*self.bent, *parts))


@dataclass(frozen=True)
class _Back:
    """Derivatives of an objective in what an increment depends on, and `along` it.

    In the pressure of each cell; in the load and Σp²/2 of each position, still by cell; in factors
    on the rates of bodies; and in the `states` before.
    """

    pressure: Field
    load: Field
    square: Field
    factors: Sequence[Field]
    states: Sequence[Field]
    along: _Along


@dataclass(frozen=True)
class Remembering:
    """An increment of the bodies of a model that wear, of which these rates are asked."""

    asked: Sloping

    def _before(
        self, wear: Mapping[str, Array], states: Memory, found: _Back, along: Callable[[], _Along]
    ) -> Before:
        each = iter(np.asarray(state) for state in found.states)
        pressure = found.pressure + _summed(found.load)
        pressure = pressure + _summed(found.square) * self.asked.pressure
        pressure = self.asked.embedded(pressure)
        states = states.with_values(each)
        through = {
            name: wear[name] + seed for name, seed in zip(self.asked.layered, each, strict=True)
        }
        factors = dict(zip(self.asked.model.laws, map(np.asarray, found.factors), strict=True))
        return Before(
            pressure,
            {**wear, **through},
            states,
            factors,
            lambda other: self._through(along(), other),
        )

    def _through(self, along: _Along, other: Other) -> float:
        laws = self.asked.model.laws
        if not other.wears & laws.keys():
            return 0.0
        asked = replace(
            self.asked,
            model=replace(other.model, laws=with_bottoms(other.model, self.asked.model, [*laws])),
            carriers=other.carriers,
            slid=replace(other.slid, before=self.asked.slid.before),
        )
        longer = asked.slid.increment / self.asked.slid.increment
        # Rates follow the length where they are means over it, or loads change along it.
        asks = other.asks & laws.keys() or self.asked.follows_length
        total = (longer - 1) * along.by_length
        for name, deeper in along.by_bottoms.items():
            total += float(np.dot(deeper, lowered(other.model, self.asked.model, name)))

        if not asks and other.carriers is self.asked.carriers:
            return total
        seeded, rates = along.seeded, together([slopes.rates for slopes, _ in along.seeded])
        if asks:
            places = [
                asked.in_layers(s.states, s.place._replace(over=longer * s.place.over))
                for s, _ in seeded
            ]
            rates = asked.rates(along.states, places)
        if other.carriers is self.asked.carriers:
            before = together([slopes.rates for slopes, _ in seeded])
            return total + _dot(along.by_cell, rates, before)
        return total + sum(
            _dot(seeds, asked.means([rate[i] for rate in rates]), slopes.means)
            for i, (slopes, seeds) in enumerate(seeded)
        )

    @cached_property
    def _parts(self) -> list[_Part[Slopes]]:
        """Go through the increment as it was divided, once more."""
        asked, passed = self.asked, 0.0
        states, divided = asked.begin, list[_Part[Stage]]()
        if not asked.along:
            divided.append(_Part(asked.slid.increment, [0.0] * len(states), [[asked.start]], []))
        for share, relaxes in asked.slid.plan.parts if asked.along else ():
            part, states = self._part(states, passed, share, relaxes=relaxes)
            divided.append(part)
            passed += share
        stages = {id(stage): stage for part in divided for stage in part.stages}
        slopes = dict(zip(stages, asked.sloped(list(stages.values())), strict=True))
        return [
            _Part(
                part.length,
                part.relaxing,
                [[slopes[id(stage)] for stage in row] for row in part.rows],
                [(at, slopes[id(stage)], by) for at, stage, by in part.moved],
            )
            for part in divided
        ]

    def _part(
        self, states: Arrays, passed: float, share: float, *, relaxes: bool
    ) -> tuple[_Part[Stage], Arrays]:
        """Return the stages of a part of the increment, and the states at its end."""
        asked, span, own = self.asked, share * self.asked.slid.increment, len(self.asked.own)
        begin = Place(passed, span)
        start = asked.at([states], [begin])[0] if passed else asked.start
        of_states: list[Field] = [0.0] * len(states)
        moved = []
        if relaxes:

            def nearby(others: Sequence[Array], *_: float) -> Arrays:
                return asked.at([others], [begin])[0].means[own:]

            of_states = relaxing(nearby, states, start.means[own:], span, asked.limits)
            falling = [at for at, of in enumerate(of_states) if np.any(np.asarray(of) < 0)]
            nudges = asked.nudges(states, start.rates, NUDGE)
            for at in falling:
                other = [*states[:at], states[at] + nudges[at], *states[at + 1 :]]
                moved.append((at, asked.at([other], [begin])[0], nudges[at]))
        rows, ends = self._rows(states, start, of_states, passed, share, relaxes=relaxes)
        counts = [_counts(len(row), [len(each) for each in rows]) for row in rows]
        total = [
            np.sum([by * end[at] for by, end in zip(counts, ends, strict=True)], axis=0)
            for at in range(len(states))
        ]
        return _Part(span, of_states, rows, moved), asked.held(total)

    def _rows(
        self,
        states: Arrays,
        start: Stage,
        of_states: Sequence[Field],
        passed: float,
        share: float,
        *,
        relaxes: bool,
    ) -> tuple[list[list[Stage]], list[Arrays]]:
        """Return the stages of each row of Euler steps, and the states at its end.

        The rows are gone along side by side. Where means over one step and over two agree, as exact
        ones do, one step is all.
        """
        asked, own = self.asked, len(self.asked.own)
        rows: list[list[Stage]] = [[] for _ in (RELAXING if relaxes else PLAIN)]
        ends = [states] * len(rows)
        for taken in range(len(rows)):
            going = range(taken, len(rows))
            begin = [
                Place(passed + share * taken / (1 + i), share * asked.slid.increment / (1 + i))
                for i in going
            ]
            if taken or asked.of_steps:
                found = asked.at([ends[i] for i in going], begin)
            else:
                found = [start] * len(rows)
            for i, stage, (_, step, *_) in zip(going, found, begin, strict=True):
                rows[i].append(start if i == taken == 0 else stage)
                changes = zip(ends[i], rows[i][-1].means[own:], of_states, strict=True)
                ends[i] = [state + lasting(step, of) * mean for state, mean, of in changes]
            if taken == 1 and asked.advances and asked.model.advances:
                once, twice = (
                    [*end, *np.mean([stage.means[:own] for stage in row], axis=0)]
                    for row, end in zip(rows[:2], ends[:2], strict=True)
                )
                pairs = zip(once, twice, strict=True)
                if all(part_of(apart(fine, one), np.abs(fine)) <= EXACT for one, fine in pairs):
                    return rows[:1], ends[:1]
        return rows, ends

    def _back(self, depth: Sequence[Field], after: Sequence[Field]) -> _Back:
        """Go back from derivatives in the depths and the states after."""
        total: list[Field] = [0.0] * (3 + len(depth))
        along, moved, bent = list[_Seeded](), list[_Seeded](), list[Field]()

        def behind(seeded: _Seeded, before: Sequence[Field]) -> list[Field]:
            """Go back through rates; return what they add to derivatives in the states before."""
            found, states = self.asked.behind(*seeded)
            total[:] = _added(total, found)
            return _added(before, states)

        for part in reversed(self._parts):
            before: list[Field] = [0.0] * len(after)
            bends: list[Field] = [0.0] * len(after)
            starts: list[_Seeded] = []
            stages = [len(row) for row in part.rows]
            for steps, row in zip(stages, part.rows, strict=True):
                counts = _counts(steps, stages)
                seeds = [counts * seed for seed in after]
                step = part.length / steps
                deep = [step * counts * seed for seed in depth]
                counted = [lasting(step, slope) for slope in part.relaxing]
                bent_by = [bending(step, slope) for slope in part.relaxing]
                for rates in reversed(row):
                    for at, bend in enumerate(bent_by):
                        if np.ndim(bend):
                            bends[at] = bends[at] + seeds[at] * rates.means[len(depth) + at] * bend
                    kept = [seed * by for seed, by in zip(seeds, counted, strict=True)]
                    each: _Seeded = (rates, [*deep, *kept])
                    if rates is row[0]:
                        _join(starts, each)
                    else:
                        along.append(each)
                        seeds = behind(each, seeds)
                before = _added(before, seeds)
            for each in starts:
                along.append(each)
                before = behind(each, before)
            bent += [bend * slope for bend, slope in zip(bends, part.relaxing, strict=True)]
            for each in self._of_relaxing(part, bends):
                moved.append(each)
                before = behind(each, before)
            after = before
        pressure, load, square, *factors = total
        return _Back(pressure, load, square, factors, after, _Along(along, moved, bent, self.asked))

    def _of_relaxing(self, part: _Part[Slopes], seeds: Sequence[Field]) -> list[_Seeded]:
        """Return derivatives in the rates that tell how fast states relax, from those in that."""
        found, own = list[_Seeded](), len(self.asked.own)
        for at, rates, by in part.moved:
            falls = np.asarray(part.relaxing[at]) < 0
            for where, sign in ((rates, 1.0), (part.rows[0][0], -1.0)):
                of_rates: list[Field] = [0.0] * (own + len(seeds))
                of_rates[own + at] = sign * falls * seeds[at] / by
                found.append((where, of_rates))
        return found


@dataclass(frozen=True)
class Together(Remembering):
    """An increment of bodies that follow what lies between them."""

    def back(self, wear: Mapping[str, Array], states: Memory) -> Before:
        """Return derivatives before it from those in the depths and what is remembered after."""
        laws = self.asked.model.laws
        # What the depths in layers come to within the increment counts as their wear.
        within = [0.0] * len(self.asked.layered)
        found = self._back([wear[name] for name in laws], [*states.values, *within])
        return self._before(wear, states, found, lambda: found.along)

    @cached_property
    def bodies(self) -> Sequence[tuple[Carrier, Array]]:
        """Of each body its carrier and what its depth follows pressures by.

        That of the pressures of its own cells, which is not all if effects follow more.
        """
        own, columns = self.asked.own, self.asked.model.grid.cells[1]
        found = []
        for at, carrier in enumerate(own):
            ones = [np.full((each.rows, columns), float(at == i)) for i, each in enumerate(own)]
            found.append(
                (carrier, np.asarray(self._back(ones, [0.0] * len(self.asked.begin)).pressure))
            )
        return found


@dataclass(frozen=True)
class Alone(Remembering):
    """An increment of one body, of which each point follows its own cells and memory alone.

    Derivatives before it are proportional to that in the depth of the point, but for what comes of
    those in what is remembered `after` it.
    """

    after: Memory

    @property
    def bodies(self) -> Sequence[tuple[Carrier, Array]]:
        """Its carrier, and the derivative of a point's depth in the pressures of its cells."""
        (carrier,) = self.asked.own
        return [(carrier, self.asked.embedded(np.asarray(self._of_depth.pressure)))]

    def back(self, wear: Mapping[str, Array]) -> Before:
        """Return derivatives before it from those in the depths after."""
        (name,), (carrier,) = self.asked.model.laws, self.asked.own
        one, other, by = self._of_states, self._of_depth, wear[name]
        cells = carrier.seen(by, self.asked.box)
        found = _Back(
            one.pressure + cells * other.pressure,
            one.load + cells * other.load,
            one.square + cells * other.square,
            _added(one.factors, _times(by, other.factors)),
            _added(one.states, _times(by, other.states)),
            one.along,
        )
        along = cache(lambda: one.along.plus(other.along, by))
        return self._before({name: by}, self.after, found, along)

    @cached_property
    def _of_depth(self) -> _Back:
        return self._back([np.ones(self._shape)], [0.0] * len(self.asked.begin))

    @cached_property
    def _of_states(self) -> _Back:
        # What the depth in layers comes to within the increment counts as its wear.
        return self._back([0.0], [*self.after.values, *(0.0 for _ in self.asked.layered)])

    @property
    def _shape(self) -> tuple[int, int]:
        return self.asked.own[0].rows, self.asked.model.grid.cells[1]


def _plus(one: Sequence[_Seeded], other: Sequence[_Seeded], by: Array) -> Sequence[_Seeded]:
    return [
        (rates, _added(seeds, _times(by, more)))
        for (rates, seeds), (_, more) in zip(one, other, strict=True)
    ]


def _join(seeded: list[_Seeded], new: _Seeded) -> None:
    """Add derivatives in rates to those in the same ones, which rows may begin with."""
    rates, seeds = new
    if seeded and seeded[-1][0] is rates:
        seeded[-1] = rates, _added(seeded[-1][1], seeds)
    else:
        seeded.append(new)


def _times(by: Array, fields: Sequence[Field]) -> list[Field]:
    return [by * field for field in fields]


def _added(one: Sequence[Field], other: Sequence[Field]) -> list[Field]:
    return [a + b for a, b in zip(one, other, strict=True)]


def _dot(seeds: Sequence[Field], now: Arrays, before: Arrays) -> float:
    """Return what changes make, from derivatives in what changes."""
    changes = zip(seeds, now, before, strict=True)
    return sum(float(np.sum(seed * (new - old))) for seed, new, old in changes)


def _summed(field: Field) -> Field:
    """Return the sum over each contact of what is known by cell."""
    return over(np.sum(field, CELLS)) if np.ndim(field) else field


def _counts(steps: int, stages: Sequence[int]) -> float:
    """Return what a row of the extrapolation counts for in its end."""
    return prod(steps / (steps - other) for other in stages if other != steps)
