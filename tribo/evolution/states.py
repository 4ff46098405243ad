"""The states of laws and effects, and where they lie."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.errors import CaseError
from tribo.core.fields import WORN_DEPTH
from tribo.core.state import State

if TYPE_CHECKING:
    from tribo.guards.parts import GuardedEffect
    from tribo.model.model import Model


@dataclass(frozen=True)
class Memory:
    """State fields where they lie: of each body's law, by body, and of effects, as in `State`.

    The depth worn is among them for a law that depends on it.
    """

    laws: Mapping[str, Mapping[str, Array]]
    between: Mapping[str, Array]

    @cached_property
    def values(self) -> list[Array]:
        """All states, in a fixed order: the laws' first."""
        of_laws = [array for fields in self.laws.values() for array in fields.values()]
        return [*of_laws, *self.between.values()]

    @property
    def bodies(self) -> list[str | None]:
        """The body of each state, for states of laws; None for states of effects."""
        return [
            *(name for name, of in self.laws.items() for _ in of),
            *(None for _ in self.between),
        ]

    def with_values(self, values: Iterator[Array]) -> Memory:
        """Return a copy with other arrays, in the order of `values`."""
        laws = {name: {key: next(values) for key in of} for name, of in self.laws.items()}
        return replace(self, laws=laws, between={key: next(values) for key in self.between})


class OfLaws(dict[str, Array]):
    """A state of laws, by body; a body whose law lacks it raises `CaseError`."""

    def __init__(self, field: str) -> None:
        super().__init__()
        self.field = field

    def __missing__(self, body: str) -> Array:
        raise CaseError(
            f"an effect needs the state {self.field!r} of {body!r}, which its wear law lacks; the "
            f"law of {', '.join(self)} has it. Give {body!r} such a law, or leave out the effect",
            f"bodies.{body}.wear",
        )


def remembered(model: Model, state: State) -> Memory:
    """Return the states of laws and effects at `state`."""
    laws = {name: body.law for name, body in state.bodies.items()}
    for name, law in model.laws.wear.items():
        if WORN_DEPTH.name in law.initial_state:
            laws[name] = {**laws[name], WORN_DEPTH.name: state.bodies[name].wear}
    return Memory(laws, state.between)


def own(laws: Mapping[str, Array]) -> dict[str, Array]:
    """Return the state of a law without the depth worn."""
    return {key: values for key, values in laws.items() if key != WORN_DEPTH.name}


def first_memory(model: Model) -> dict[str, Array]:
    """Return the state fields of the effects before any sliding."""
    first = {}
    for key, (effect, field) in model.laws.between.items():
        rows, ny = model.grid.cells
        if effect.carrier is not None:
            rows = model.cycle.maps[effect.carrier].rows
        start = effect.initial_state[field.name]
        first[key] = np.full((1, 1) if field.uniform else (rows, ny), start)
    return first


def under(model: Model, memory: Memory, position: int) -> Memory:
    """Return the states in the window, at a position of the cycle."""
    laws = {
        name: {key: model.cycle.maps[name].see(values, position) for key, values in of.items()}
        for name, of in memory.laws.items()
    }
    between = dict(memory.between)
    for key, (effect, field) in model.laws.between.items():
        if (body := effect.body_of(field)) is not None:
            between[key] = model.cycle.maps[body].see(between[key], position)
    return Memory(laws, between)


def filling(model: Model, memory: Memory) -> Array:
    """Return how high the gap is filled, (positions, nx, ny) or of 1 cell if it is not, in m."""
    cells = model.grid.cells if model.laws.filling else (1, 1)
    heights = np.zeros((len(model.cycle), *cells))
    for position, height in enumerate(heights if model.laws.filling else ()):
        here = under(model, memory, position)
        for body, key in model.laws.filling:
            height += here.between[key] if body is None else here.laws[body][key]
    return heights


def place(model: Model, body: str | None) -> str:
    """Return the place of a state on a body, or between both; all stationary points share one.

    A step of the integrator ends for all states at a place where one reaches a break.
    """
    return body if body in model.cycle.swept else "the contact"


def laid(model: Model, key: str, rate: Array, position: int) -> Array:
    """Return the rate of an effect's state from a rate in the window, by the position's share."""
    effect, field = model.laws.between[key]
    if field.uniform:
        return np.asarray(np.mean(rate, keepdims=True))
    return (
        rate if effect.carrier is None else model.cycle.maps[effect.carrier].gather(rate, position)
    )


def fields_of(model: Model, memory: Memory) -> dict[str, dict[str, Array]]:
    """Return the required states in the window, by field and body, shape (nx, ny).

    A state of laws has the bodies with such a law; a state of effects has all bodies, each with the
    state on its own surface where the effects of a name lie on bodies.
    """
    fields: dict[str, dict[str, Array]] = {}
    for name, of_law in memory.laws.items():
        for key in of_law.keys() & model.laws.required:
            of_body = np.broadcast_to(of_law[key], model.grid.cells)
            fields.setdefault(key, OfLaws(key))[name] = of_body
    for key, (effect, field) in model.laws.between.items():
        if field.name in model.laws.required:
            values = np.broadcast_to(memory.between[key], model.grid.cells)
            of_bodies = fields.setdefault(field.name, dict.fromkeys(model.case.bodies, values))
            if (body := effect.body_of(field)) is not None:
                of_bodies[body] = values
    return fields


def own_state(model: Model, effect: GuardedEffect, memory: Memory) -> dict[str, Array]:
    """Return the state of an effect as its input: (nx, ny), or (1, 1) if uniform."""
    told = {}
    for field in effect.state_fields:
        values = memory.between[effect.key_of(field)]
        window = values if field.uniform else np.broadcast_to(values, model.grid.cells)
        told[field.name] = readonly(window)
    return told
