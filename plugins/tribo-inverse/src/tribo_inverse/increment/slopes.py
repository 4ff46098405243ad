"""The derivatives of the rates of an increment in all their inputs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial
from itertools import chain, zip_longest

import numpy as np
from tribo import WORN_DEPTH, Array
from tribo import Field as FieldDeclaration
from tribo.kernel_api import CELLS, over

from tribo_inverse.increment.across import EffectFields, held
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


class Slopes:
    """The derivatives of the rates of a stage of an increment, in each cell.

    The derivatives in the fields of effects with a `pull_back` are apart, `by_field`.
    """

    def __init__(self, increment: Stages, stage: RateStage) -> None:
        if stage.answers:
            increment = replace(increment, model=held(increment.model, stage.answers))
        self.increment, self.stage = increment, stage

    def seen(self, seeds: Sequence[Field]) -> list[Field]:
        """Return derivatives in the rates of each cell from derivatives in their means over points.

        After them come derivatives in the inputs of effects, computed from the last effect back.
        """
        found = [
            carrier.part(self.increment.box) * carrier.seen(seed, self.increment.box)
            if isinstance(seed, np.ndarray)
            else seed
            for carrier, seed in zip(
                (*self.increment.own, *self.increment.kept), seeds, strict=True
            )
        ]
        end = len(self.stage.rates)
        found += [0.0] * (end - len(found))
        answers, zero = chain(*self.stage.answers), np.zeros((1, *self.increment.box.shape))
        for answer, by_field in reversed([*zip(answers, self.by_field, strict=True)]):
            cotangents = {
                name: {body: (zero + back(found, by))[0] for body, by in of_bodies.items()}
                for name, of_bodies in by_field.items()
            }
            told = answer.back(cotangents)
            found[end - len(told) : end] = told
            end -= len(told)
        return found

    def behind(self, seen: Sequence[Field]) -> tuple[list[Field], list[Field]]:
        """Return derivatives in the inputs of rates from derivatives in the rates of each cell.

        The first are in the pressure of each cell, the load and Σp²/2 of each position, not yet
        summed over cells, and factors on the bodies' rates; the second in the states.
        """

        def through(slopes: Sequence[Field]) -> Field:
            pairs = zip(seen, slopes, strict=True)
            return sum(seed * slope for seed, slope in pairs if np.ndim(slope))

        load = through([each.load for each in self.by_pressure])
        square = through([each.square for each in self.by_pressure])
        factors = (
            self._gathered(carrier, seen, responses)
            for carrier, responses in zip(self.increment.own, self.by_factor, strict=True)
        )
        states: list[Field] = [
            inside * self._gathered(kept, seen, responses)
            for kept, inside, responses in zip(
                self.increment.kept, self.stage.inside, self.by_state, strict=True
            )
        ]
        return [back(seen, self.by_pressure), load, square, *factors], states

    def _gathered(
        self, carrier: Carrier, seen: Sequence[Field], responses: Sequence[Response]
    ) -> Field:
        """Return derivatives at the points of a carrier from derivatives in rates of each cell."""
        found = back(seen, responses)
        if not np.ndim(found):
            return found
        return carrier.gathered(over(self.increment.shares) * found, self.increment.box)

    @cached_property
    def by_pressure(self) -> Sequence[Response]:
        """The derivatives in the pressures."""
        increment, stage = self.increment, self.stage
        if not (increment.along or increment.model.laws.effects):
            return [Response(slope) for slope in stage.slopes]

        def rates(pressure: Array) -> Arrays:
            return increment.rates(stage, told=increment.told(stage.passed, pressure))

        if increment.shares_load:
            return shared(rates, increment.pressure)
        told = increment.told(stage.passed)
        responses = aside(
            lambda told: increment.rates(stage, told=told),
            stage.rates,
            told,
            ASIDE * told,
        )
        if not increment.loads_change:
            return responses
        # Along the increment pressures are told in proportion to the load.
        total = over(np.sum(increment.pressure, CELLS))
        longer = over(np.sum(told, CELLS)) / total
        return [
            Response(
                longer * each.own,
                -longer * each.change(increment.pressure, increment.pressure) / total,
            )
            for each in responses
        ]

    @cached_property
    def by_state(self) -> Sequence[Sequence[Response]]:
        """The derivatives in each state."""
        nudges = self.increment.nudges(self.stage)
        return [self._by_state(at, nudge) for at, nudge in enumerate(nudges)]

    def _by_state(self, at: int, nudge: Array) -> Sequence[Response]:
        increment, states = self.increment, self.stage.states
        body = increment.slid.before.bodies[at]
        model = increment.of_bodies(increment.model, [body]) if body else increment.model

        def rates(state: Array) -> Arrays:
            changed = [*states[:at], state, *states[at + 1 :]]
            return increment.rates(self.stage, changed, model=model)

        return self._aside(rates, states[at], nudge, increment.kept[at])

    @cached_property
    def by_factor(self) -> Sequence[Sequence[Response]]:
        """The derivatives in a factor, 1 here, on the wear rate of each body."""
        increment, stage = self.increment, self.stage
        names = list(increment.model.laws.wear)
        if not increment.slid.before.between:
            laws = increment.slid.before.laws.items()
            follows = [name if key == WORN_DEPTH.name else "" for name, of in laws for key in of]
            bodies = [*names, *follows]
            return [
                [
                    Response(rate if body == name else 0.0)
                    for body, rate in zip_longest(bodies, stage.rates)
                ]
                for name in names
            ]

        def rates(factor: Array, name: str) -> Arrays:
            return increment.rates(stage, model=localised(increment.model, {name: factor}))

        ones = [np.ones(carrier.shape) for carrier in increment.own]
        return [
            self._aside(partial(rates, name=name), one, ASIDE * one, carrier)
            for name, one, carrier in zip(names, ones, increment.own, strict=True)
        ]

    @cached_property
    def by_field(self) -> Sequence[Mapping[str, Mapping[str, Sequence[Response]]]]:
        """The derivatives in the fields of each answer, by field and body."""
        return [self._by_field(answer) for answer in chain(*self.stage.answers)]

    def _by_field(self, answer: EffectFields) -> dict[str, dict[str, Sequence[Response]]]:
        stage = self.stage

        def response(field: FieldDeclaration, body: str) -> Sequence[Response]:
            of_bodies = answer.fields[field.name]

            def rates(values: Array) -> Arrays:
                fields = {**answer.fields, field.name: {**of_bodies, body: values}}
                other = replace(answer, fields=fields)
                given = [[other if each is answer else each for each in of] for of in stage.answers]
                return self.increment.rates(stage, model=held(self.increment.model, given))

            values = of_bodies[body]
            step = ASIDE * (float(np.max(np.abs(values))) or 1.0)
            most = np.inf if field.at_most is None else field.at_most
            nudge = np.where(values + step > most, -step, step)
            return aside(rates, stage.rates, values, nudge)

        return {
            field.name: {body: response(field, body) for body in answer.fields[field.name]}
            for field in answer.effect.provides
        }

    def _aside(
        self, rates: Callable[[Array], Arrays], values: Array, nudge: Array, carrier: Carrier
    ) -> Sequence[Response]:
        """Return the responses of rates in values at the points of a carrier."""
        seen = partial(carrier.seen, box=self.increment.box)
        return aside(rates, self.stage.rates, values, nudge, seen)
