"""The rates of an increment at its stages, and their derivatives in all inputs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, zip_longest

import numpy as np
from tribo import WORN_DEPTH, Array, CaseError
from tribo import Field as FieldDeclaration
from tribo.kernel_api import CELLS, over

from tribo_inverse.increment.across import EffectFields, held, held_effects
from tribo_inverse.increment.carriers import Carrier
from tribo_inverse.increment.response import (
    ASIDE,
    Arrays,
    Field,
    Response,
    aside,
    back,
    shared,
)
from tribo_inverse.increment.stages import RateStage, Stages
from tribo_inverse.recording.local import localised


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
        return self.at(self.slid.before.values, 0.0 if self.along else 1.0)

    @cached_property
    def shares_load(self) -> bool:
        """Whether effects declare that points depend on the load and the area of the contact."""
        across = held_effects(self.model)
        if across and len(self.model.cycle) > 1:
            raise CaseError(
                f"{across[0]} reaches across the contact, which has no gradient at several "
                'positions; set kinematics.positions = "average"',
                "kinematics.positions",
            )
        # Of effects with a `pull_back` only the rates of their states are asked for.
        asked = (e for e in self.model.laws.effects if e not in across or e.state_fields)
        effects = [effect.component for effect in asked]
        if silent := [repr(e.type) for e in effects if e.reach not in ("point", "contact")]:
            raise CaseError(
                f"{', '.join(silent)} does not declare its reach, which a gradient needs; let its "
                'class say reach = "point" or reach = "contact", or let it state pull_back',
                "effects",
            )
        return any(effect.reach == "contact" for effect in effects)

    def sloped(self, stage: RateStage) -> Slopes:
        """Return a stage with its derivatives, those in the fields of its answers apart."""
        here = self.holding(stage)
        return Slopes(
            **vars(stage),
            by_pressure=here._by_pressure(stage),
            by_state=[
                here._by_state(at, stage, nudge) for at, nudge in enumerate(here.nudges(stage))
            ],
            by_factor=here._by_factor(stage),
            by_field=[here._by_field(answer, stage) for answer in chain(*stage.answers)],
        )

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

    def behind(self, slopes: Slopes, seen: Sequence[Field]) -> tuple[list[Field], list[Field]]:
        """Return derivatives in the inputs of rates from derivatives in the rates of each cell.

        The first are in the pressure of each cell, the load and Σp²/2 of each position, not yet
        summed over cells, and factors on the bodies' rates; the second in the states.
        """

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

    def _by_pressure(self, stage: RateStage) -> Sequence[Response]:
        if not (self.along or self.model.laws.effects):
            return [Response(slope) for slope in stage.slopes]

        def rates(pressure: Array) -> Arrays:
            return self.rates(stage, told=self.told(stage.passed, pressure))

        if self.shares_load:
            return shared(rates, self.pressure)
        told = self.told(stage.passed)
        responses = aside(
            lambda told: self.rates(stage, told=told),
            stage.rates,
            told,
            ASIDE * told,
        )
        if not self.loads_change:
            return responses
        # Along the increment pressures are told in proportion to the load.
        total = over(np.sum(self.pressure, CELLS))
        longer = over(np.sum(told, CELLS)) / total
        return [
            Response(longer * each.own, -longer * each.change(self.pressure, self.pressure) / total)
            for each in responses
        ]

    def _by_state(self, at: int, stage: RateStage, nudge: Array) -> Sequence[Response]:
        states, body = stage.states, self.slid.before.bodies[at]
        model = self.of_bodies(self.model, [body]) if body else self.model

        def rates(state: Array) -> Arrays:
            return self.rates(stage, [*states[:at], state, *states[at + 1 :]], model=model)

        return aside(rates, stage.rates, states[at], nudge, self._seen_by(self.kept[at]))

    def _by_factor(self, stage: RateStage) -> Sequence[Sequence[Response]]:
        names = list(self.model.laws.wear)
        if not self.slid.before.between:
            laws = self.slid.before.laws.items()
            follows = [name if key == WORN_DEPTH.name else "" for name, of in laws for key in of]
            bodies = [*names, *follows]
            return [
                [
                    Response(rate if body == name else 0.0)
                    for body, rate in zip_longest(bodies, stage.rates)
                ]
                for name in names
            ]
        of_bodies = []
        for name, carrier in zip(names, self.own, strict=True):

            def rates(factor: Array, name: str = name) -> Arrays:
                changed = localised(self.model, {name: factor})
                return self.rates(stage, model=changed)

            ones = np.ones(carrier.shape)
            seen = self._seen_by(carrier)
            of_bodies.append(aside(rates, stage.rates, ones, ASIDE * ones, seen))
        return of_bodies

    def _by_field(
        self, answer: EffectFields, stage: RateStage
    ) -> dict[str, dict[str, Sequence[Response]]]:
        """Return the responses to the fields of an answer, by field and body."""

        def response(field: FieldDeclaration, body: str) -> Sequence[Response]:
            of_bodies = answer.fields[field.name]

            def rates(values: Array) -> Arrays:
                fields = {**answer.fields, field.name: {**of_bodies, body: values}}
                other = replace(answer, fields=fields)
                given = [[other if each is answer else each for each in of] for of in stage.answers]
                return self.rates(stage, model=held(self.model, given))

            values = of_bodies[body]
            step = ASIDE * (float(np.max(np.abs(values))) or 1.0)
            most = np.inf if field.at_most is None else field.at_most
            nudge = np.where(values + step > most, -step, step)
            return aside(rates, stage.rates, values, nudge)

        return {
            field.name: {body: response(field, body) for body in answer.fields[field.name]}
            for field in answer.effect.provides
        }

    def _seen_by(self, carrier: Carrier) -> Callable[[Array], Array]:
        return lambda own: carrier.seen(own, self.box)
