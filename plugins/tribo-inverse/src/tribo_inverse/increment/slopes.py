"""The rates of an increment at its stages, and their derivatives in all inputs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, zip_longest
from typing import NamedTuple

import numpy as np
from tribo import WORN_DEPTH, Array, CaseError
from tribo import Field as FieldDeclaration
from tribo.kernel_api import CELLS, over

from tribo_inverse.increment.across import EffectFields, held, held_effects
from tribo_inverse.increment.carriers import Carrier
from tribo_inverse.increment.response import (
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
from tribo_inverse.increment.stages import RateStage, Stages, together
from tribo_inverse.recording.local import localised


class Reach(NamedTuple):
    """Distance, in cells, over which points depend on the pressure, and on each state.

    None for the pressure: points depend on their own pressure, the load and the area.
    """

    pressure: Offset | None
    states: Sequence[Offset]


@dataclass(frozen=True)
class Slopes(RateStage):
    """A stage with the derivatives of its rates in each cell."""

    by_pressure: Sequence[Response]
    by_state: Sequence[Sequence[Response]]
    by_factor: Sequence[Sequence[Response]]
    by_field: Sequence[Mapping[str, Mapping[str, Sequence[Response]]]]


@dataclass(frozen=True)
class Sloping(Stages):
    """Stages with the derivatives of their rates."""

    @cached_property
    def start(self) -> RateStage:
        """The stage with which the increment begins."""
        return self.at(self.begin, 0.0 if self.along else 1.0)

    @cached_property
    def reach(self) -> Reach:
        """The reach that the effects declare."""
        across = held_effects(self.model)
        if across and len(self.model.cycle) > 1:
            raise CaseError(
                f"{across[0]} reaches across the contact, which has no gradient at several "
                'positions; set kinematics.positions = "average"',
                "kinematics.positions",
            )
        # Of effects with a `pull_back` only the rates of their states depend on cells nearby.
        asked = (e for e in self.model.laws.effects if e not in across or e.state_fields)
        effects = [effect.component for effect in asked]
        declared = [effect.reach for effect in effects]
        cells = [reach for reach in declared if isinstance(reach, tuple)]
        alone, whole = [ALONE] * len(self.begin), "contact" in declared
        if silent := [repr(effect.type) for effect in effects if effect.reach is None]:
            raise CaseError(
                f"{', '.join(silent)} does not declare its reach, which a gradient needs; let its "
                'class say reach = "point", reach = "contact", or cells along x and y as (1, 1); '
                "or let it state pull_back",
                "effects",
            )
        if not cells:
            return Reach(None if whole else ALONE, alone)
        along, across = (max(far) for far in zip(*cells, strict=True))
        if whole or (2 * along + 1) * (2 * across + 1) > MOST:
            who = ", ".join(repr(effect.type) for effect in effects)
            raise CaseError(
                f"the fields of {who} at a point depend on neighbours and on the load or the area, "
                f"or on more than {MOST} points, which has no gradient; leave it out",
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
        return [self.holding(stage)._sloped([stage], self.reach)[0] for stage in stages]

    def seen(self, slopes: Slopes, seeds: Sequence[Field]) -> list[Field]:
        """Return derivatives in the rates of each cell from derivatives in their means over points.

        After them come derivatives in the inputs of effects, computed from the last effect back.
        """
        found = [
            carrier.part(self.box) * carrier.seen(seed, self.box)
            if isinstance(seed, np.ndarray)
            else seed
            for carrier, seed in zip((*self.own, *self.kept), seeds, strict=True)
        ]
        end = len(slopes.rates)
        found += [0.0] * (end - len(found))
        answers, zero = chain(*slopes.answers), np.zeros((1, *self.box.shape))
        for answer, by_field in reversed([*zip(answers, slopes.by_field, strict=True)]):
            cotangents = {
                name: {body: (zero + back(found, by))[0] for body, by in of_bodies.items()}
                for name, of_bodies in by_field.items()
            }
            told = answer.back(cotangents)
            found[end - len(told) : end] = told
            end -= len(told)
        return found

    def behind(self, slopes: Slopes, seeds: Sequence[Field]) -> tuple[list[Field], list[Field]]:
        """Return derivatives in the inputs of the rates of depths and states.

        The first are in the pressure of each cell, the load and Σp²/2 of each position, not yet
        summed over cells, and factors on the bodies' rates; the second in the states.
        """
        seen = self.seen(slopes, seeds)

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
        return [back(seen, slopes.by_pressure), load, square, *factors], states

    def _gathered(
        self, carrier: Carrier, seen: Sequence[Field], responses: Sequence[Response]
    ) -> Field:
        """Return derivatives at the points of a carrier from derivatives in rates of each cell."""
        found = back(seen, responses)
        if not np.ndim(found):
            return found
        return carrier.gathered(over(self.shares) * found, self.box)

    def _sloped(self, stages: Sequence[RateStage], reach: Reach) -> list[Slopes]:
        """Return stages with their derivatives, all at once, for a reach of points."""
        states, rates = (together([vars(s)[of] for s in stages]) for of in ("states", "rates"))
        passed = [stage.passed for stage in stages]
        by_state = [
            self._by_state(at, states, nudge, passed, rates, reach.states[at])
            for at, nudge in enumerate(self.nudges(states, rates, passed))
        ]
        by_pressure = self._by_pressure(states, passed, rates, reach.pressure)
        by_factor = self._by_factor(states, passed, rates, reach.pressure or ALONE)
        answers = stages[0].answers
        by_field = [
            self._by_field(answer, answers, states, passed, rates) for answer in chain(*answers)
        ]
        return [
            Slopes(
                **vars(stage),
                by_pressure=_at(i, by_pressure),
                by_state=[_at(i, responses) for responses in by_state],
                by_factor=[_at(i, responses) for responses in by_factor],
                by_field=by_field,
            )
            for i, stage in enumerate(stages)
        ]

    def _by_pressure(
        self, states: Arrays, passed: Sequence[float], found: Arrays, reach: Offset | None
    ) -> Sequence[Response]:
        def rates(pressure: Array) -> Arrays:
            return self.rates(states, passed, self.told(passed, pressure))

        if reach is None:
            return shared(
                rates, np.broadcast_to(self.pressure, (len(passed), *self.pressure.shape))
            )
        told = self.told(passed)
        responses = local(lambda told: self.rates(states, passed, told), found, told, reach)
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
        passed: Sequence[float],
        found: Arrays,
        reach: Offset,
    ) -> Sequence[Response]:
        def rates(state: Array) -> Arrays:
            return self.rates([*states[:at], state, *states[at + 1 :]], passed)

        return near(rates, found, states[at], nudge, reach, self._seen_by(self.kept[at]))

    def _by_factor(
        self, states: Arrays, passed: Sequence[float], found: Arrays, reach: Offset
    ) -> Sequence[Sequence[Response]]:
        names = list(self.model.laws.wear)
        if not self.slid.before.between:
            laws = self.slid.before.laws.items()
            follows = [name if key == WORN_DEPTH.name else "" for name, of in laws for key in of]
            bodies = [*names, *follows]
            return [
                [
                    Response(rate if body == name else 0.0)
                    for body, rate in zip_longest(bodies, found)
                ]
                for name in names
            ]
        of_bodies = []
        for name, carrier in zip(names, self.own, strict=True):

            def rates(factor: Array, name: str = name) -> Arrays:
                return self.rates(states, passed, model=localised(self.model, {name: factor[0]}))

            ones = np.ones((1, carrier.rows, self.model.grid.cells[1]))
            seen = self._seen_by(carrier)
            far = _on(carrier, reach)
            of_bodies.append(near(rates, found, ones, ASIDE * ones, far, seen))
        return of_bodies

    def _by_field(
        self,
        answer: EffectFields,
        answers: Sequence[Sequence[EffectFields]],
        states: Arrays,
        passed: Sequence[float],
        found: Arrays,
    ) -> dict[str, dict[str, Sequence[Response]]]:
        """Return the responses to the fields of an answer, by field and body."""

        def response(field: FieldDeclaration, body: str) -> Sequence[Response]:
            of_bodies = answer.fields[field.name]

            def rates(values: Array) -> Arrays:
                fields = {**answer.fields, field.name: {**of_bodies, body: values[0]}}
                other = replace(answer, fields=fields)
                given = [[other if each is answer else each for each in of] for of in answers]
                return self.rates(states, passed, model=held(self.model, given))

            values = of_bodies[body][None]
            step = ASIDE * (float(np.max(np.abs(values))) or 1.0)
            most = np.inf if field.at_most is None else field.at_most
            nudge = np.where(values + step > most, -step, step)
            return _at(0, near(rates, found, values, nudge, ALONE))

        return {
            field.name: {body: response(field, body) for body in answer.fields[field.name]}
            for field in answer.effect.provides
        }

    def _seen_by(self, carrier: Carrier) -> Callable[[Array], Array]:
        return lambda own: carrier.seen(own, self.box)


def _on(carrier: Carrier, reach: Offset) -> Offset:
    """Return a reach on a body: 0 along the track where it is averaged along it."""
    return reach if carrier.weights is None else (0, reach[1])


def _at(stage: int, responses: Sequence[Response]) -> list[Response]:
    """Return the responses of one of several stages."""
    return [each.at(stage) for each in responses]
