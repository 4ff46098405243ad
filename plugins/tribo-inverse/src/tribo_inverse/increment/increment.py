"""The adjoint of the wear and the states of an increment under given contacts."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from tribo import WORN_DEPTH, Array, Box
from tribo.kernel_api import (
    CELLS,
    Interval,
    Model,
    Part,
    Stretch,
    Values,
    kept_in,
    over,
    retraced,
    transposed,
    whole,
)

from tribo_inverse.increment.across import held_effects
from tribo_inverse.increment.breaks import with_breaks
from tribo_inverse.increment.carriers import Carrier
from tribo_inverse.increment.response import Arrays, Field
from tribo_inverse.increment.slopes import Slopes, sloped
from tribo_inverse.increment.stages import RateStage, Stages
from tribo_inverse.recording.tape import Pressed, Slid

Place = tuple[str | None, str]
"""A state: the body whose law has it, None for effects, and its key."""
States = dict[Place, Array]


@dataclass(frozen=True)
class Seeded:
    """A stage, and derivatives in its rates: in their `means` at points, and at each cell."""

    stage: RateStage
    means: Sequence[Field]
    cells: Sequence[Field]


@dataclass(frozen=True)
class Before:
    """The derivatives of an objective in the inputs of an increment.

    In the pressures, shape (positions, nx, ny), by the share of each position: `by_cell` at a given
    load, and in all; in the depths worn and the states before; in a factor, 1 here, on the wear
    rate of each body; in the rates at its stages; and in the breaks of states, by number, at each
    point.
    """

    by_cell: Array
    pressure: Array
    wear: Mapping[str, Array]
    states: States
    factor: Mapping[str, Array]
    rates: Sequence[Seeded]
    breaks: Mapping[int, Array]

    @cached_property
    def by_length(self) -> float:
        """The derivative in the logarithm of its length at constant rates."""
        return sum(_dot(each.means, each.stage.means) for each in self.rates)


@dataclass(frozen=True)
class Increment(Stages):
    """An increment of the wearing bodies of a model, and its adjoint."""

    @cached_property
    def is_pointwise(self) -> bool:
        """Whether a point's depth depends on the pressures of its own cells and the load alone.

        Then `bodies` are the full contribution of wear to the system of a step.
        """
        model = self.model
        if not (model.laws.effects or model.laws.filling):
            return True
        if len(model.cycle) > 1 or model.laws.filling or held_effects(model):
            return False
        if self.loads_change or any(kept.weights is not None for kept in self.kept):
            return False
        return not self.shares_load

    @cached_property
    def bodies(self) -> Sequence[tuple[Carrier, Array]]:
        """Of each body its carrier and the derivative of a point's depth in its cells' pressures.

        Unless it `is_pointwise`, the derivative at the beginning of the increment, to precondition.
        """
        if not (self.along and self.is_pointwise):
            parts, slopes = self._retraced
            start, length = slopes[id(parts[0].first)], self.slid.interval.length
            each = zip(self.own, start.by_pressure, strict=False)
            steep = [(of, length * of.part(self.box) * by.own) for of, by in each]
            return [(of, self._in_window(by)) for of, by in steep]
        return [
            (of, self.back({name: np.ones(of.shape)}, {}).by_cell)
            for name, of in zip(self.model.laws.wear, self.own, strict=True)
        ]

    def through(
        self,
        found: Before,
        model: Model,
        carriers: Mapping[str, Carrier],
        interval: Interval,
        *,
        asks: Collection[str],
    ) -> float:
        """Return the change of the objective with the increment of a model with another number.

        It has the same contacts. It `asks` again for the rates of these bodies, which may differ.
        """
        own = self.slid
        total = (interval.length / own.interval.length - 1) * found.by_length
        for at, by in found.breaks.items():
            was, now = (kept_in(each, own.before)[at].breaks for each in (self.model, model))
            deeper = np.subtract(now, was)
            total += sum(float(np.sum(of)) * far for of, far in zip(by, deeper, strict=True))
        # Rates depend on the length where loads change along it.
        asks = asks or (model.laws.wear if self.loads_change else ())
        moves = carriers is not self.carriers
        if not (asks or moves):
            return total
        others = replace(
            self,
            model=with_breaks(model, self.model),
            carriers=carriers,
            slid=replace(own, interval=interval),
        )
        asked, shares = self.of_bodies(others.model, asks), over(self.shares)
        stages = [each.stage for each in found.rates]
        new_rates = others.rates(stages, model=asked) if asks else [of.rates for of in stages]
        for each, rates in zip(found.rates, new_rates, strict=True):
            stage = each.stage
            own_frame = len(each.means) if moves else 0
            if moves:
                total += _dot(each.means, others.means(rates)) - _dot(each.means, stage.means)
            triples = [*zip(each.cells, rates, stage.rates, strict=True)][own_frame:]
            changes = [(by, new - old) for by, new, old in triples if new is not old]
            total += sum(float(np.sum(shares * by * change)) for by, change in changes)
        return total

    def _in_window(self, values: Field) -> Array:
        """Return values on the box, by position, in a window of zeros."""
        return self.box.embed(values + np.zeros_like(self.pressure))

    @cached_property
    def _retraced(self) -> tuple[Sequence[Part], Mapping[int, Slopes]]:
        """The parts of the increment, and the derivatives of their rates by identity."""
        length, before = self.slid.interval.length, self.slid.before.values
        # Of a copy, as a cycle of references would keep all of a run.
        stages, asked = replace(self), dict[int, tuple[Values, RateStage]]()

        def rates(states: Sequence[Array], passed: float) -> Values:
            stage, bodies = stages.at(states, passed), len(self.own)
            found = [*stage.means[bodies:], *stage.means[:bodies]]
            asked[id(found)] = found, stage
            return found

        first = rates(before, 0.0 if self.along else 1.0)
        if self.along:
            limits, sums, parts = self.limits, self.sums, self.slid.plan
            done = retraced(rates, before, first, length, limits, sums, parts)
        else:
            spans = dict.fromkeys(self.model.laws.wear, length)
            done = [Part([], [], [[[Stretch([], first, length, spans, {})]]], [], [])]
        used = list({id(rates): None for part in done for rates in part.stages})
        slopes = sloped(stages, [asked[at][1] for at in used])
        return done, dict(zip(used, slopes, strict=True))

    def back(self, wear: Mapping[str, Array], states: States) -> Before:
        """Return derivatives before it from derivatives in the depths and states after."""
        memory = self.slid.before
        own = [(name, key) for name, of in memory.laws.items() for key in of]
        places: list[Place] = [*own, *((None, key) for key in memory.between)]
        # The depth worn at the end of the increment counts as wear alone.
        after: list[Field] = [states.get(of, 0.0) for of in places]
        depth: list[Field] = [wear.get(name, 0.0) for name in self.model.laws.wear]
        total: list[Field] = [0.0] * (3 + len(depth))
        seeded, count = list[Seeded](), len(after)
        parts, slopes = self._retraced

        def behind(rates: Values, seeds: list[Field]) -> Sequence[Field]:
            here, means = slopes[id(rates)], [*seeds[count:], *seeds[:count]]
            seeded.append(Seeded(here.stage, means, here.seen(means)))
            found, states = here.behind(seeded[-1].cells)
            total[:] = [a + b for a, b in zip(total, found, strict=True)]
            return states

        sums = [*zip(self.sums, depth, strict=True)]
        earlier, breaks = transposed(parts, after, sums, behind)
        pressure, load, square, *factors = total
        load = _summed(load) + _summed(square) * self.pressure
        before = dict(zip(places, map(np.asarray, earlier), strict=True))
        through = {
            name: wear.get(name, 0.0) + before.pop((name, key))
            for name, key in own
            if key == WORN_DEPTH.name
        }
        return Before(
            self._in_window(pressure),
            self._in_window(pressure + load),
            {**wear, **through},
            before,
            dict(zip(self.model.laws.wear, map(np.asarray, factors), strict=True)),
            seeded,
            breaks,
        )


def _dot(seeds: Sequence[Field], values: Arrays) -> float:
    """Return the sum of the products of derivatives in fields, and fields."""
    return sum(float(np.sum(by * of)) for by, of in zip(seeds, values, strict=True))


def _summed(field: Field) -> Field:
    """Return the sum of a field over the cells of each contact."""
    return over(np.sum(field, CELLS)) if np.ndim(field) else field


def increment(
    model: Model, carriers: Mapping[str, Carrier], touched: Box, record: Pressed, slid: Slid
) -> Increment:
    """Return the increment of a record; `touched` holds all contacts of the run."""
    cells = model.grid.cells
    window, along = record.in_window(record.pressure, cells), bool(slid.before.values)

    def on(box: Box) -> Increment:
        here = window[(slice(None), *box.slices)]
        return Increment(model, carriers, box, here, slid, along)

    if not (model.laws.effects or model.laws.filling):
        return on(Box.of(record.region, cells))
    # A state elsewhere may return into the contact.
    return near if (near := on(touched)).is_pointwise else on(whole(cells))
