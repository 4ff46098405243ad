"""The derivatives of the rates of an increment in all their inputs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import chain, zip_longest

import numpy as np
from tribo import WORN_DEPTH, Array
from tribo import Field as FieldDeclaration
from tribo.kernel_api import CELLS, over

from tribo_inverse.increment.across import EffectFields
from tribo_inverse.increment.carriers import Carrier
from tribo_inverse.increment.response import (
    ASIDE,
    Arrays,
    Field,
    Response,
    back,
    responses,
    shared,
)
from tribo_inverse.increment.stages import RateStage, Stages
from tribo_inverse.recording.local import localised


@dataclass(frozen=True)
class Slopes:
    """The derivatives of the rates of a stage of an increment, in each cell.

    They are by the pressures, by each state, and by a factor, 1 here, on the wear rate of each
    body; the derivatives in the fields of effects with a `pull_back` are apart, `by_field`.
    """

    increment: Stages
    stage: RateStage
    by_pressure: Sequence[Response]
    by_state: Sequence[Sequence[Response]]
    by_factor: Sequence[Sequence[Response]]

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
            return sum(seed * slope for seed, slope in pairs if isinstance(slope, np.ndarray))

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
    def by_field(self) -> Sequence[Mapping[str, Mapping[str, Sequence[Response]]]]:
        """The derivatives in the fields of each answer, by field and body."""
        return [self._by_field(answer) for answer in chain(*self.stage.answers)]

    def _by_field(self, answer: EffectFields) -> dict[str, dict[str, Sequence[Response]]]:
        stage = self.stage

        def response(field: FieldDeclaration, body: str) -> Sequence[Response]:
            of_bodies = answer.fields[field.name]

            values = of_bodies[body]
            step = ASIDE * (float(np.max(np.abs(values))) or 1.0)
            most = np.inf if field.at_most is None else field.at_most
            moved = np.where(values + step > most, values - step, values + step)
            fields = {**answer.fields, field.name: {**of_bodies, body: moved}}
            other = replace(answer, fields=fields)
            given = [[other if each is answer else each for each in of] for of in stage.answers]
            (rates,) = self.increment.rates([replace(stage, answers=given)])
            return responses(stage.rates, rates, moved - values)

        return {
            field.name: {body: response(field, body) for body in answer.fields[field.name]}
            for field in answer.effect.provides
        }


def sloped(increment: Stages, stages: Sequence[RateStage]) -> list[Slopes]:
    """Return the derivatives at some stages of an increment."""
    states = range(len(increment.kept))
    by_state = [_by_state(increment, stages, at) for at in states]
    parts = zip(stages, _by_pressure(increment, stages), _by_factor(increment, stages), strict=True)
    return [
        Slopes(increment, stage, by_pressure, [of[at] for of in by_state], by_factor)
        for at, (stage, by_pressure, by_factor) in enumerate(parts)
    ]


def _by_pressure(increment: Stages, stages: Sequence[RateStage]) -> Sequence[Sequence[Response]]:
    if not (increment.along or increment.model.laws.effects):
        return [[Response(slope) for slope in stage.slopes] for stage in stages]

    def pressed(stage: RateStage, pressure: Array) -> Arrays:
        (rates,) = increment.rates([stage], told=[increment.told(stage.passed, pressure)])
        return rates

    if increment.shares_load:
        return [shared(partial(pressed, stage), increment.pressure) for stage in stages]
    told = [increment.told(stage.passed) for stage in stages]
    moved = [each + ASIDE * each for each in told]
    rates = increment.rates(stages, told=moved)
    found = [
        responses(stage.rates, now, after - before)
        for stage, now, after, before in zip(stages, rates, moved, told, strict=True)
    ]
    if not increment.loads_change:
        return found
    # Along the increment pressures are given in proportion to the load.
    pressure = increment.pressure
    total = over(np.sum(pressure, CELLS))
    longer = [over(np.sum(each, CELLS)) / total for each in told]
    return [
        [Response(by * of.own, -by * of.change(pressure, pressure) / total) for of in of_stage]
        for by, of_stage in zip(longer, found, strict=True)
    ]


def _by_state(
    increment: Stages, stages: Sequence[RateStage], at: int
) -> Sequence[Sequence[Response]]:
    body, model = increment.slid.before.bodies[at], increment.model
    if body is not None:
        model = increment.of_bodies(model, [body])
    moved = [stage.states[at] + increment.nudge(stage, at) for stage in stages]
    pairs = [*zip(stages, moved, strict=True)]
    states = [[*of.states[:at], state, *of.states[at + 1 :]] for of, state in pairs]
    rates = increment.rates(stages, states, model=model)
    spans = [increment.kept[at].seen(now - of.states[at], increment.box) for of, now in pairs]
    triples = zip(stages, rates, spans, strict=True)
    return [responses(stage.rates, now, span) for stage, now, span in triples]


def _by_factor(
    increment: Stages, stages: Sequence[RateStage]
) -> Sequence[Sequence[Sequence[Response]]]:
    before, names = increment.slid.before, list(increment.model.laws.wear)
    if not before.between:
        laws = before.laws.items()
        follows = [name if key == WORN_DEPTH.name else "" for name, of in laws for key in of]

        def of_body(name: str, stage: RateStage) -> Sequence[Response]:
            bodies = zip_longest([*names, *follows], stage.rates)
            return [Response(rate if body == name else 0.0) for body, rate in bodies]

        return [[of_body(name, stage) for name in names] for stage in stages]
    of_bodies = []
    for name, carrier in zip(names, increment.own, strict=True):
        factor = np.full(carrier.shape, 1 + ASIDE)
        rates = increment.rates(stages, model=localised(increment.model, {name: factor}))
        span = carrier.seen(factor - 1, increment.box)
        pairs = zip(stages, rates, strict=True)
        of_bodies.append([responses(stage.rates, now, span) for stage, now in pairs])
    return [*zip(*of_bodies, strict=True)]
