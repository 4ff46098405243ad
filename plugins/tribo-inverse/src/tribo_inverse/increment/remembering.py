"""An increment of bodies that remember, or that follow what lies between them, backwards."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np
from tribo import WORN_DEPTH, Array
from tribo.kernel_api import CELLS, Memory, Part, Stretch, Values, over, own, retraced, transposed

from tribo_inverse.increment.across import held_effects
from tribo_inverse.increment.breaks import moved_breaks, with_breaks
from tribo_inverse.increment.carriers import Carrier
from tribo_inverse.increment.course import Before, Other
from tribo_inverse.increment.rate_stage import RateStage
from tribo_inverse.increment.response import ALONE, Arrays, Field
from tribo_inverse.increment.slopes import Slopes, Sloping
from tribo_inverse.increment.stages import together

_Seeded = tuple[Slopes, Sequence[Field]]
"""Rates, and the derivatives in them."""


@dataclass(frozen=True)
class _Along:
    """Derivatives of an objective along an increment.

    `rates` has those in the `means` of the rates at its stages, and `breaks` those in the breaks of
    states, by number, still for each point.
    """

    rates: Sequence[_Seeded]
    breaks: Mapping[int, Array]
    stages: Sloping

    def plus(self, other: _Along, by: Array) -> _Along:
        """Return the sum with another's, times a number at each point."""
        rates = [
            (stage, _added(seeds, _times(by, more)))
            for (stage, seeds), (_, more) in zip(self.rates, other.rates, strict=True)
        ]
        breaks = {at: self.breaks.get(at, 0.0) + by * more for at, more in other.breaks.items()}
        return _Along(rates, {**self.breaks, **breaks}, self.stages)

    @cached_property
    def by_cell(self) -> Arrays:
        """The derivatives in the rates at each cell, shape (stages, positions, nx, ny)."""
        shares = over(self.stages.shares)
        each = [self.stages.seen(*seeded) for seeded in self.rates]
        shape = self.rates[0][0].rates[0].shape
        return [
            np.stack([np.broadcast_to(shares * seed, shape) for seed in of_rate])
            for of_rate in zip(*each, strict=True)
        ]

    @cached_property
    def states(self) -> Arrays:
        """What is remembered at their stages, shape (stages, rows, ny)."""
        return together([stage.states for stage, _ in self.rates])

    @cached_property
    def found(self) -> Arrays:
        """The rates there, shape (stages, positions, nx, ny)."""
        return together([stage.rates for stage, _ in self.rates])

    @property
    def by_length(self) -> float:
        """The derivative in ln(its length) where the rates stay as they are."""
        products = (_products(seeds, stage.means) for stage, seeds in self.rates)
        return sum(float(np.sum(each)) for of_stage in products for each in of_stage)


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
    """An increment of the bodies of a model that wear, and the rates at its stages."""

    stages: Sloping

    def _before(
        self, wear: Mapping[str, Array], found: _Back, along: Callable[[], _Along]
    ) -> Before:
        behind = self.stages.slid.before.with_values(map(np.asarray, found.states))
        pressure = found.pressure + _summed(found.load)
        pressure = pressure + _summed(found.square) * self.stages.pressure
        pressure = self.stages.embedded(pressure)
        through = {
            name: wear[name] + of[WORN_DEPTH.name]
            for name, of in behind.laws.items()
            if WORN_DEPTH.name in of
        }
        states = Memory({name: own(of) for name, of in behind.laws.items()}, behind.between)
        factors = dict(
            zip(self.stages.model.laws.wear, map(np.asarray, found.factors), strict=True)
        )
        return Before(
            pressure,
            {**wear, **through},
            states,
            factors,
            lambda other: self._through(along(), other),
        )

    def _through(self, along: _Along, other: Other) -> float:
        laws = self.stages.model.laws.wear
        if not other.wears & laws.keys():
            return 0.0
        others = replace(
            self.stages,
            model=other.model.with_laws(with_breaks(other.model, self.stages.model, [*laws])),
            carriers=other.carriers,
            slid=replace(other.slid, before=self.stages.slid.before),
        )
        longer = others.slid.interval.length / self.stages.slid.interval.length
        # Rates follow the length where loads change along it.
        asks = other.asks & laws.keys() or self.stages.loads_change
        total = (longer - 1) * along.by_length
        for at, by in along.breaks.items():
            deeper = moved_breaks(other.model, self.stages.model, self.stages.slid.before, at)
            total += sum(float(np.sum(of)) * far for of, far in zip(by, deeper, strict=True))
        rates, moves = along.found, other.carriers is not self.stages.carriers
        if asks:
            rates = others.rates_at([stage for stage, _ in along.rates])
        if moves:
            told = len(others.counts)
            total += _dot(along.by_cell[told:], rates[told:], along.found[told:])
            return total + sum(
                _dot(seeds, others.means([rate[i] for rate in rates]), stage.means)
                for i, (stage, seeds) in enumerate(along.rates)
            )
        return total + _dot(along.by_cell, rates, along.found) if asks else total

    @cached_property
    def _retraced(self) -> tuple[Sequence[Part], Mapping[int, Slopes]]:
        """The parts of the increment, and by the identity of rates in them their derivatives."""
        increment, length = self.stages, self.stages.slid.interval.length
        asked = dict[int, tuple[Values, RateStage]]()

        def known(stage: RateStage) -> Values:
            bodies = len(increment.own)
            rates = [*stage.means[bodies:], *stage.means[:bodies]]
            asked[id(rates)] = rates, stage
            return rates

        def rates(states: Sequence[Array], passed: float) -> Values:
            return known(increment.at(states, passed))

        first, parts = known(increment.start), increment.slid.plan.parts
        if increment.along:
            done = retraced(
                rates, increment.begin, first, length, increment.limits, increment.sums, parts
            )
        else:
            spans = dict.fromkeys(increment.model.laws.wear, length)
            done = [Part([], [], [[[Stretch([], first, length, spans, {})]]], [], [], [])]
        used = {id(rates): asked[id(rates)][1] for part in done for rates in part.stages}
        return done, dict(zip(used, increment.sloped([*used.values()]), strict=True))

    def _back(self, depth: Sequence[Field], after: Sequence[Field]) -> _Back:
        """Go back from derivatives in the depths and the states after."""
        total: list[Field] = [0.0] * (3 + len(depth))
        along, count = list[_Seeded](), len(after)
        parts, slopes = self._retraced

        def behind(rates: Values, seeds: list[Field]) -> Sequence[Field]:
            seeded = slopes[id(rates)], [*seeds[count:], *seeds[:count]]
            along.append(seeded)
            found, states = self.stages.behind(*seeded)
            total[:] = _added(total, found)
            return states

        sums = [*zip(self.stages.sums, depth, strict=True)]
        before = transposed(parts, after, sums, behind)
        pressure, load, square, *factors = total
        found = _Along(along, before.breaks, self.stages)
        return _Back(pressure, load, square, factors, before.states, found)

    def _after(self, states: Memory) -> Sequence[Field]:
        """Return derivatives in what is remembered after, from those in `states`.

        What a depth comes to within the increment counts as wear alone.
        """
        laws = self.stages.slid.before.laws.items()
        of_laws = [states.laws[name].get(key, 0.0) for name, of in laws for key in of]
        return [*of_laws, *states.between.values()]


@dataclass(frozen=True)
class Together(Remembering):
    """An increment of bodies that follow what lies between them."""

    def back(self, wear: Mapping[str, Array], states: Memory) -> Before:
        """Return derivatives before it from those in the depths and what is remembered after."""
        laws = self.stages.model.laws.wear
        found = self._back([wear[name] for name in laws], self._after(states))
        return self._before(wear, found, lambda: found.along)

    @cached_property
    def is_pointwise(self) -> bool:
        """Whether a point's depth follows the pressures of its own cells alone.

        Then `bodies` say all that the wear adds to the system of a step.
        """
        model = self.stages.model
        if len(model.cycle) > 1 or model.laws.filling or held_effects(model):
            return False
        if any(kept.weights is not None for kept in self.stages.kept):
            return False
        if self.stages.loads_change:
            return False
        reach = self.stages.reach
        return all(each == ALONE for each in (reach.pressure, *reach.states))

    @cached_property
    def bodies(self) -> Sequence[tuple[Carrier, Array]]:
        """Of each body its carrier and the derivative of a point's depth in its cells' pressures.

        Where more follows those, that as the increment begins, to precondition with.
        """
        if self.is_pointwise:
            shape, none = self.stages.pressure.shape, [0.0] * len(self.stages.begin)
            found = []
            for at, own in enumerate(self.stages.own):
                seeds: list[Field] = [0.0] * len(self.stages.own)
                seeds[at] = np.ones((own.rows, self.stages.box.window[1]))
                by = self._back(seeds, none).pressure
                found.append((own, self.stages.embedded(np.broadcast_to(by, shape))))
            return found
        parts, slopes = self._retraced
        start, window = slopes[id(parts[0].first)], np.ones(self.stages.pressure.shape)
        return [
            (own, self.stages.slid.interval.length * own.part(self.stages.box) * by.own * window)
            for own, by in zip(self.stages.own, start.by_pressure, strict=False)
        ]


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
        (carrier,) = self.stages.own
        return [(carrier, self.stages.embedded(np.asarray(self._of_depth.pressure)))]

    def back(self, wear: Mapping[str, Array]) -> Before:
        """Return derivatives before it from those in the depths after."""
        (name,), (carrier,) = self.stages.model.laws.wear, self.stages.own
        one, other, by = self._of_states, self._of_depth, wear[name]
        cells = carrier.seen(by, self.stages.box)
        found = _Back(
            one.pressure + cells * other.pressure,
            one.load + cells * other.load,
            one.square + cells * other.square,
            _added(one.factors, _times(by, other.factors)),
            _added(one.states, _times(by, other.states)),
            one.along,
        )
        along = cache(lambda: one.along.plus(other.along, by))
        return self._before({name: by}, found, along)

    @cached_property
    def _of_depth(self) -> _Back:
        return self._back([np.ones(self._shape)], [0.0] * len(self.stages.begin))

    @cached_property
    def _of_states(self) -> _Back:
        return self._back([0.0], self._after(self.after))

    @property
    def _shape(self) -> tuple[int, int]:
        return self.stages.own[0].rows, self.stages.model.grid.cells[1]


def _times(by: Array, fields: Sequence[Field]) -> list[Field]:
    return [by * field for field in fields]


def _products(one: Sequence[Field], other: Sequence[Field]) -> list[Field]:
    return [a * b for a, b in zip(one, other, strict=True)]


def _added(one: Sequence[Field], other: Sequence[Field]) -> list[Field]:
    return [a + b for a, b in zip(one, other, strict=True)]


def _dot(seeds: Sequence[Field], now: Arrays, before: Arrays) -> float:
    """Return what changes make, from derivatives in what changes."""
    changes = zip(seeds, now, before, strict=True)
    return sum(float(np.sum(seed * (new - old))) for seed, new, old in changes)


def _summed(field: Field) -> Field:
    """Return the sum over each contact of what is known by cell."""
    return over(np.sum(field, CELLS)) if np.ndim(field) else field
