"""The adjoint of the wear and the states of an increment under given contacts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import compress

import numpy as np
from tribo import WORN_DEPTH, Array, Box
from tribo.kernel_api import (
    CELLS,
    Memory,
    Model,
    Part,
    Stretch,
    Values,
    over,
    own,
    retraced,
    transposed,
    whole,
)

from tribo_inverse.increment.across import held_effects
from tribo_inverse.increment.breaks import moved_breaks, with_breaks
from tribo_inverse.increment.carriers import Carrier
from tribo_inverse.increment.response import ALONE, Arrays, Field
from tribo_inverse.increment.slopes import Slopes, Sloping
from tribo_inverse.increment.stages import RateStage, together
from tribo_inverse.recording.tape import Pressed, Slid

_Seeded = tuple[Slopes, Sequence[Field]]
"""Rates, and derivatives in them."""


@dataclass(frozen=True)
class Before:
    """The derivatives of an objective in the inputs of an increment.

    In the pressures, shape (positions, nx, ny), by the share of each position; in the depths worn
    and the states before; and in a factor, 1 here, on the wear rate of each body. `through` returns
    the change of the objective with an increment of another model.
    """

    pressure: Array
    wear: Mapping[str, Array]
    states: Memory
    factor: Mapping[str, Array]
    through: Callable[[Other], float]


@dataclass(frozen=True)
class Other:
    """An increment under the same contacts, of a model with another number.

    `wears` are the bodies whose wear may differ, and `asks` the bodies whose rates may differ.
    """

    model: Model
    carriers: Mapping[str, Carrier]
    slid: Slid
    wears: Set[str]
    asks: Set[str]


@dataclass(frozen=True)
class _Back:
    """Derivatives of an objective in the inputs of an increment.

    In the pressure of each cell, and separately in the `load` and Σp² of its contact; in factors on
    the rates of bodies; and in the `states` before.
    `rates` has derivatives in the `means` of the rates at its stages, and `breaks` derivatives in
    the breaks of states, by number, at each point.
    """

    pressure: Field
    load: Field
    factors: Sequence[Field]
    states: Sequence[Field]
    rates: Sequence[_Seeded]
    breaks: Mapping[int, Array]
    stages: Sloping

    @cached_property
    def by_cell(self) -> Sequence[Sequence[Field]]:
        """The derivatives in the rates at each cell, by stage."""
        return [self.stages.seen(*seeded) for seeded in self.rates]

    @property
    def by_length(self) -> float:
        """The derivative in the logarithm of its length at constant rates."""
        return sum(
            float(np.sum(seed * mean))
            for stage, seeds in self.rates
            for seed, mean in zip(seeds, stage.means, strict=True)
        )


@dataclass(frozen=True)
class Increment:
    """An increment of the wearing bodies of a model, and the rates at its stages."""

    stages: Sloping

    def back(self, wear: Mapping[str, Array], states: Memory) -> Before:
        """Return derivatives before it from derivatives in the depths and states after."""
        increment, laws = self.stages, self.stages.slid.before.laws
        # The depth worn at the end of the increment counts as wear alone.
        of_laws = [states.laws[name].get(key, 0.0) for name, of in laws.items() for key in of]
        depths = [wear[name] for name in increment.model.laws.wear]
        found = self._back(depths, [*of_laws, *states.between.values()])
        before = increment.slid.before.with_values(map(np.asarray, found.states))
        through = {
            name: wear[name] + of[WORN_DEPTH.name]
            for name, of in before.laws.items()
            if WORN_DEPTH.name in of
        }
        factors = zip(increment.model.laws.wear, map(np.asarray, found.factors), strict=True)
        return Before(
            increment.embedded(found.pressure + found.load + np.zeros_like(increment.pressure)),
            {**wear, **through},
            Memory({name: own(of) for name, of in before.laws.items()}, before.between),
            dict(factors),
            partial(self._through, found),
        )

    @cached_property
    def is_pointwise(self) -> bool:
        """Whether a point's depth depends on the pressures of its own cells and the load alone.

        Then `bodies` are the full contribution of wear to the system of a step.
        """
        model, reach = self.stages.model, self.stages.reach
        if not (model.laws.effects or model.laws.filling):
            return True
        if len(model.cycle) > 1 or model.laws.filling or held_effects(model):
            return False
        if self.stages.loads_change or any(kept.weights is not None for kept in self.stages.kept):
            return False
        return all(each == ALONE for each in (reach.pressure, *reach.states))

    @cached_property
    def bodies(self) -> Sequence[tuple[Carrier, Array]]:
        """Of each body its carrier and the derivative of a point's depth in its cells' pressures.

        Unless it `is_pointwise`, the derivative at the beginning of the increment, to precondition.
        """
        increment, window = self.stages, np.ones_like(self.stages.pressure)
        if not self.is_pointwise:
            parts, slopes = self._retraced
            start, length = slopes[id(parts[0].first)], increment.slid.interval.length
            return [
                (carrier, length * carrier.part(increment.box) * by.own * window)
                for carrier, by in zip(increment.own, start.by_pressure, strict=False)
            ]
        found = []
        for at, carrier in enumerate(increment.own):
            seeds: list[Field] = [0.0] * len(increment.own)
            seeds[at] = np.ones((carrier.rows, increment.box.window[1]))
            by = self._back(seeds, [0.0] * len(increment.begin)).pressure
            found.append((carrier, increment.embedded(by * window)))
        return found

    def _through(self, found: _Back, other: Other) -> float:
        """Return the change of the objective with an increment of another model."""
        increment, laws = self.stages, self.stages.model.laws.wear
        if not other.wears & laws.keys():
            return 0.0
        others = replace(
            increment,
            model=other.model.with_laws(with_breaks(other.model, increment.model, [*laws])),
            carriers=other.carriers,
            slid=replace(other.slid, before=increment.slid.before),
        )
        longer = others.slid.interval.length / increment.slid.interval.length
        total = (longer - 1) * found.by_length
        for at, by in found.breaks.items():
            deeper = moved_breaks(other.model, increment.model, increment.slid.before, at)
            total += sum(float(np.sum(of)) * far for of, far in zip(by, deeper, strict=True))
        stages = [stage for stage, _ in found.rates]
        before = rates = together([stage.rates for stage in stages])
        # Rates depend on the length where loads change along it.
        asks, moves = other.asks & laws.keys(), other.carriers is not increment.carriers
        if not (asks or increment.loads_change or moves):
            return total
        if asks or increment.loads_change:
            rates = others.rates_at(stages)
        shares = over(increment.shares)
        for i, (stage, seeds) in enumerate(found.rates):
            by_cell, told = found.by_cell[i], 0
            if moves:
                told = len(others.counts)
                means = others.means([rate[i] for rate in rates])
                total += _dot(seeds, means, stage.means)
            changes = zip(by_cell[told:], rates[told:], before[told:], strict=True)
            total += sum(float(np.sum(shares * by * (r[i] - b[i]))) for by, r, b in changes)
        return total

    @cached_property
    def _retraced(self) -> tuple[Sequence[Part], Mapping[int, Slopes]]:
        """The parts of the increment, and the derivatives of their rates by identity."""
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
            done = [Part([], [], [[[Stretch([], first, length, spans, {})]]], [], [])]
        used = {id(rates): asked[id(rates)][1] for part in done for rates in part.stages}
        return done, dict(zip(used, increment.sloped([*used.values()]), strict=True))

    def _back(self, depth: Sequence[Field], after: Sequence[Field]) -> _Back:
        """Return derivatives before it from derivatives in the depths and states after."""
        total: list[Field] = [0.0] * (3 + len(depth))
        seeded, count = list[_Seeded](), len(after)
        parts, slopes = self._retraced

        def behind(rates: Values, seeds: list[Field]) -> Sequence[Field]:
            stage = slopes[id(rates)], [*seeds[count:], *seeds[:count]]
            seeded.append(stage)
            found, states = self.stages.behind(*stage)
            total[:] = [a + b for a, b in zip(total, found, strict=True)]
            return states

        sums = [*zip(self.stages.sums, depth, strict=True)]
        before = transposed(parts, after, sums, behind)
        pressure, load, square, *factors = total
        load = _summed(load) + _summed(square) * self.stages.pressure
        return _Back(pressure, load, factors, before.states, seeded, before.breaks, self.stages)


def _dot(seeds: Sequence[Field], now: Arrays, before: Arrays) -> float:
    """Return the change of the objective by changes of fields, from derivatives in them."""
    changes = zip(seeds, now, before, strict=True)
    return sum(float(np.sum(seed * (new - old))) for seed, new, old in changes)


def _summed(field: Field) -> Field:
    """Return the sum of a field over the cells of each contact."""
    return over(np.sum(field, CELLS)) if np.ndim(field) else field


def increments(
    model: Model, carriers: Mapping[str, Carrier], touched: Box, record: Pressed
) -> list[Increment]:
    """Return the increment of a record in independent parts.

    There is one for each body, unless interfacial effects couple them. `touched` holds all contacts
    of the run.
    """
    slid, cells = record.slid, model.grid.cells
    assert slid is not None
    window, along = record.in_window(record.pressure, cells), bool(slid.before.values)

    def part(box: Box, *names: str) -> Increment:
        own = {name: slid.before.laws[name] for name in names}
        its = [body in (None, *names) for body in slid.before.bodies]
        shares = (
            replace(share, relaxes=[*compress(share.relaxes or (), its)])
            for share in slid.plan.parts
        )
        return Increment(
            Sloping(
                model.with_laws({name: model.laws.wear[name] for name in names}),
                carriers,
                box,
                window[(slice(None), *box.slices)],
                replace(
                    slid,
                    before=replace(slid.before, laws=own),
                    plan=replace(slid.plan, parts=tuple(shares)),
                ),
                along,
            )
        )

    names = model.laws.wear
    if not (model.laws.effects or model.laws.filling):
        return [part(Box.of(record.region, cells), name) for name in names]
    together = part(touched, *names)
    # A state elsewhere may return into the contact.
    return [together if together.is_pointwise else part(whole(cells), *names)]
