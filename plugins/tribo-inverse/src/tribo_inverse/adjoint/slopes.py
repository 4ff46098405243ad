"""The rates of an increment at its stages, and their derivatives in all that they follow."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from tribo import Array, CaseError
from tribo.kernel_api import CELLS, only, over

from tribo_inverse.adjoint.linear import Carrier
from tribo_inverse.adjoint.local import localised
from tribo_inverse.adjoint.passing import Layered
from tribo_inverse.adjoint.rate_stage import RatePlace, RateStage
from tribo_inverse.adjoint.response import (
    ALONE,
    ASIDE,
    MOST,
    Arrays,
    Field,
    Offset,
    Response,
    back,
    local,
    near,
    shared,
)
from tribo_inverse.adjoint.stages import Stages, together


class Reach(NamedTuple):
    """How many cells apart points are that follow each other's pressure, and each state.

    Without one for the pressure they follow their own, the load and the area.
    """

    pressure: Offset | None
    states: Sequence[Offset]


@dataclass(frozen=True)
class Slopes(RateStage):
    """A stage with the derivatives of its rates in each cell.

    They are those at given shares of the layers; `passing` has how these follow all else.
    """

    by_pressure: Sequence[Response]
    by_state: Sequence[Sequence[Response]]
    by_factor: Sequence[Sequence[Response]]
    passing: PassedLayers | None


@dataclass(frozen=True)
class PassedLayers:
    """Bodies of which points pass from layer to layer, by name.

    `by_share` has what the rates follow of the share of each layer, and `of_layers` the slopes
    where points are in that layer alone.
    """

    bodies: Mapping[str, Layered]
    by_share: Mapping[str, Sequence[Sequence[Response]]]
    of_layers: Sequence[Slopes]


@dataclass(frozen=True)
class Sloping(Stages):
    """Stages with the derivatives of their rates."""

    @cached_property
    def start(self) -> RateStage:
        """The stage with which the increment begins."""
        increment, (share, _) = self.slid.increment, self.slid.plan.parts[0]
        place = RatePlace(0.0, share * increment) if self.along else RatePlace(1.0, increment)
        return self.at([self.begin], [place])[0]

    @cached_property
    def reach(self) -> Reach:
        """How far points follow each other, as the effects declare it."""
        effects = [effect.component for effect in self.model.laws.effects]
        declared = [effect.reach for effect in effects]
        cells = [reach for reach in declared if isinstance(reach, tuple)]
        alone, whole = [ALONE] * len(self.begin), "contact" in declared
        if silent := [repr(effect.type) for effect in effects if effect.reach is None]:
            raise CaseError(
                f"{', '.join(silent)} does not declare its reach, which a gradient needs; let its "
                'class say reach = "point", reach = "contact", or cells along x and y as (1, 1)',
                "effects",
            )
        if not cells:
            return Reach(None if whole else ALONE, alone)
        along, across = (max(far) for far in zip(*cells, strict=True))
        if whole or (2 * along + 1) * (2 * across + 1) > MOST:
            who = ", ".join(repr(effect.type) for effect in effects)
            raise CaseError(
                f"what {who} makes of a point follows points beside it and the load or the area "
                f"too, or more than {MOST} points, through which no gradient goes",
                "effects",
            )
        return Reach(
            (along, across),
            [
                ALONE if state.size == 1 else _on(kept, (along, across))
                for kept, state in zip(self.kept, self.begin, strict=True)
            ],
        )

    def sloped(self, stages: Sequence[RateStage]) -> list[Slopes]:
        """Return stages with their derivatives."""
        if not self.model.laws.effects:
            return self._sloped(stages, self.reach)
        return [self._sloped([stage], self.reach)[0] for stage in stages]

    def seen(self, seeds: Sequence[Field]) -> list[Field]:
        """Return derivatives in the rates of each cell from those in their means over points."""
        return [
            carrier.part(self.box) * carrier.seen(seed, self.box)
            if isinstance(seed, np.ndarray)
            else seed
            for carrier, seed in zip((*self.own, *self.kept), seeds, strict=True)
        ]

    def behind(self, slopes: Slopes, seeds: Sequence[Field]) -> tuple[list[Field], list[Field]]:
        """Return derivatives in what rates follow, from those in the rates of depths and states.

        The first are in the pressure of each cell, the load and Σp²/2 of each position, still by
        cell, and factors on the bodies' rates; the second in the states.
        """
        seen = self.seen(seeds)

        def through(slopes: Sequence[Field]) -> Field:
            pairs = zip(seen, slopes, strict=True)
            return sum(seed * slope for seed, slope in pairs if np.ndim(slope))

        load = through([each.load for each in slopes.by_pressure])
        square = through([each.square for each in slopes.by_pressure])
        factors = (
            self._gathered(carrier, seen, responses)
            for carrier, responses in zip(self.own, slopes.by_factor, strict=True)
        )
        states: list[Field] = [
            inside * self._gathered(kept, seen, responses)
            for kept, inside, responses in zip(
                self.kept, slopes.inside, slopes.by_state, strict=True
            )
        ]
        total = [back(seen, slopes.by_pressure), load, square, *factors]
        passing = slopes.passing
        if passing is None:
            return total, states
        of_layers: list[list[Field]] = [[0.0] * len(seeds) for _ in passing.of_layers]
        for at, name in enumerate(self.model.laws.wear):
            if name in passing.bodies:
                shares = [
                    self._gathered(self.own[at], seen, each) for each in passing.by_share[name]
                ]
                worn, rates, _ = passing.bodies[name].back(shares)
                depth = self.layered.index(name) - len(self.layered)
                states[depth] = states[depth] + worn
                for each, rate in zip(of_layers, rates, strict=False):
                    each[at] = rate
        for layer, of_layer in zip(passing.of_layers, of_layers, strict=True):
            more, others = self.behind(layer, of_layer)
            total = [a + b for a, b in zip(total, more, strict=True)]
            states = [a + b for a, b in zip(states, others, strict=True)]
        return total, states

    def by_bottoms(self, slopes: Slopes, seeds: Sequence[Field]) -> dict[str, list[float]]:
        """Return derivatives in the bottoms of layers of each body, as `behind` those in states."""
        passing = slopes.passing
        if passing is None:
            return {}
        seen, found = self.seen(seeds), {}
        for at, name in enumerate(self.model.laws.wear):
            if name in passing.bodies:
                shares = [
                    self._gathered(self.own[at], seen, each) for each in passing.by_share[name]
                ]
                *_, bottoms = passing.bodies[name].back(shares)
                found[name] = [float(np.sum(each)) for each in bottoms]
        return found

    def _gathered(
        self, carrier: Carrier, seen: Sequence[Field], responses: Sequence[Response]
    ) -> Field:
        """Return derivatives at the points of a carrier from those in the rates of each cell."""
        found = back(seen, responses)
        if not np.ndim(found):
            return found
        return carrier.gathered(over(self.shares) * found, self.box)

    def _sloped(self, stages: Sequence[RateStage], reach: Reach) -> list[Slopes]:
        """Return stages with their derivatives, of all at once, where points reach so far."""
        states, rates = (together([vars(s)[of] for s in stages]) for of in ("states", "rates"))
        places = [stage.place for stage in stages]
        lengths = over(np.array([place.over for place in places]))
        by_state = [
            self._by_state(at, states, nudge, places, rates, reach.states[at])
            for at, nudge in enumerate(self.nudges(states, rates, lengths))
        ]
        by_pressure = self._by_pressure(states, places, rates, reach.pressure)
        by_factor = self._by_factor(states, places, rates, reach.pressure or ALONE)
        return [
            Slopes(
                **vars(stage),
                by_pressure=_at(i, by_pressure),
                by_state=[_at(i, responses) for responses in by_state],
                by_factor=[_at(i, responses) for responses in by_factor],
                passing=self._passing(stage, reach),
            )
            for i, stage in enumerate(stages)
        ]

    def _passing(self, stage: RateStage, reach: Reach) -> PassedLayers | None:
        """Return how points pass from layer to layer; None where all stay in theirs."""
        place, states = stage.place, stage.states
        shares = [share for of_body in place.shares.values() for share in of_body.values()]
        if not any(np.any((share > 0) & (share < 1)) for share in shares):
            return None
        bottoms = {name: self.model.laws.wear[name].bottoms for name in self.layered}
        worn = self.memory(states).worn
        alone = [
            place._replace(shares=only(layer, bottoms, worn))
            for layer in range(1 + max(map(len, bottoms.values())))
        ]
        of_layers = self._sloped(self.at_shares([states] * len(alone), alone), reach)
        bodies, by_share = {}, {}
        for at, name in enumerate(self.model.laws.wear):
            if name not in bottoms:
                continue
            rates = [each.means[at] for each in of_layers[: 1 + len(bottoms[name])]]
            bodies[name] = Layered(bottoms[name], worn[name], rates, place.over)
            by_share[name] = [
                self._by_share(name, self.own[at], layer, stage, reach.pressure or ALONE)
                for layer in range(len(rates))
            ]
        return PassedLayers(bodies, by_share, of_layers)

    def _by_share(
        self, name: str, carrier: Carrier, layer: int, stage: RateStage, reach: Offset
    ) -> Sequence[Response]:
        place, key = stage.place, f"rate {layer}"
        of_body, states = place.shares[name], [state[None] for state in stage.states]

        def rates(share: Array) -> Arrays:
            shares = {**place.shares, name: {**of_body, key: share[0]}}
            return self.rates(states, [place._replace(shares=shares)])

        share, found = of_body[key][None], [rate[None] for rate in stage.rates]
        nudge = np.full_like(share, ASIDE)
        return _at(0, near(rates, found, share, nudge, reach, self._seen_by(carrier)))

    def _by_pressure(
        self, states: Arrays, places: Sequence[RatePlace], found: Arrays, reach: Offset | None
    ) -> Sequence[Response]:
        def rates(pressure: Array) -> Arrays:
            return self.rates(states, places, self.told(places, pressure))

        if reach is None:
            return shared(
                rates, np.broadcast_to(self.pressure, (len(places), *self.pressure.shape))
            )
        told = self.told(places)
        responses = local(lambda told: self.rates(states, places, told), found, told, reach)
        if not self.loads_change:
            return responses
        # Along the increment pressures are told in proportion to the load.
        total = over(np.sum(self.pressure, CELLS))
        longer = over(np.sum(told, CELLS)) / total
        return [
            Response(
                longer * each.own,
                -longer * each.change(self.pressure, self.pressure) / total,
                beside={offset: longer * slope for offset, slope in each.beside.items()},
            )
            for each in responses
        ]

    def _by_state(
        self,
        at: int,
        states: Arrays,
        nudge: Array,
        places: Sequence[RatePlace],
        found: Arrays,
        reach: Offset,
    ) -> Sequence[Response]:
        if at >= len(self.slid.before.values):
            # The depth counts through the shares of the layers alone.
            return [Response(0.0)] * (len(self.own) + len(self.kept))

        def rates(state: Array) -> Arrays:
            return self.rates([*states[:at], state, *states[at + 1 :]], places)

        return near(rates, found, states[at], nudge, reach, self._seen_by(self.kept[at]))

    def _by_factor(
        self, states: Arrays, places: Sequence[RatePlace], found: Arrays, reach: Offset
    ) -> Sequence[Sequence[Response]]:
        names = list(self.model.laws.wear)
        if not self.slid.before.between:
            # The depths of bodies in layers come once more at the end.
            bodies = [*names, *[""] * (len(found) - len(names) - len(self.layered)), *self.layered]
            return [
                [
                    Response(rate if body == name else 0.0)
                    for body, rate in zip(bodies, found, strict=True)
                ]
                for name in names
            ]
        of_bodies = []
        for name, carrier in zip(names, self.own, strict=True):

            def rates(factor: Array, name: str = name) -> Arrays:
                return self.rates(states, places, model=localised(self.model, {name: factor[0]}))

            ones = np.ones((1, carrier.rows, self.model.grid.cells[1]))
            seen = self._seen_by(carrier)
            far = _on(carrier, reach)
            of_bodies.append(near(rates, found, ones, ASIDE * ones, far, seen))
        return of_bodies

    def _seen_by(self, carrier: Carrier) -> Callable[[Array], Array]:
        return lambda own: carrier.seen(own, self.box)


def _on(carrier: Carrier, reach: Offset) -> Offset:
    """Return how far that is on a body: what is one along a track reaches no further along it."""
    return reach if carrier.weights is None else (0, reach[1])


def _at(stage: int, responses: Sequence[Response]) -> list[Response]:
    """Return the responses of one of several stages."""
    return [each.at(stage) for each in responses]
