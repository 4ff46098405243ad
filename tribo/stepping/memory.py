"""What laws and effects remember, and where it lies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from dataclasses import field as in_dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.errors import CaseError
from tribo.core.state import State

if TYPE_CHECKING:
    from tribo.stepping.model import Model


@dataclass(frozen=True)
class Memory:
    """State fields where they lie: of each body's law, by body, and of the effects, by name.

    `worn` has the depth that each body has lost, and `shares` for how much of an increment each
    layer of a body is what wears (`tribo.stepping.layers`).
    """

    laws: Mapping[str, Mapping[str, Array]]
    between: Mapping[str, Array]
    worn: Mapping[str, Array] = in_dataclass(default_factory=dict)
    shares: Mapping[str, Mapping[str, Array]] = in_dataclass(default_factory=dict)

    @cached_property
    def values(self) -> list[Array]:
        """All of them, in a fixed order: those of the laws first."""
        of_laws = [array for fields in self.laws.values() for array in fields.values()]
        return [*of_laws, *self.between.values()]

    def with_values(self, values: Iterator[Array]) -> Memory:
        """Return the same with other arrays, in the order of `values`."""
        laws = {name: {key: next(values) for key in of} for name, of in self.laws.items()}
        return replace(self, laws=laws, between={key: next(values) for key in self.between})


class OfLaws(dict[str, Array]):
    """What laws remember under a name, by body; a body whose law does not raises `CaseError`."""

    def __init__(self, field: str) -> None:
        super().__init__()
        self.field = field

    def __missing__(self, body: str) -> Array:
        raise CaseError(
            f"an effect asks for {self.field!r} of {body!r}, whose wear law does not remember it; "
            f"that of {', '.join(self)} does. Give {body!r} such a law, or leave out the effect",
            f"bodies.{body}.wear",
        )


def remembered(state: State) -> Memory:
    """Return what laws and effects remember at `state`."""
    laws = {name: body.law for name, body in state.bodies.items()}
    return Memory(laws, state.between, {name: body.wear for name, body in state.bodies.items()})


def first_memory(model: Model) -> dict[str, Array]:
    """Return the state fields of the effects before anything slides."""
    first = {}
    for key, (effect, field) in model.laws.between.items():
        rows, ny = model.grid.cells
        if effect.carrier is not None:
            rows = model.cycle.maps[effect.carrier].rows
        first[key] = np.full((1, 1) if field.uniform else (rows, ny), effect.initial_state[key])
    return first


def under(model: Model, memory: Memory, position: int) -> Memory:
    """Return what is remembered where the window is, at a position of the cycle."""
    laws, shares = (
        {
            name: {key: model.cycle.maps[name].see(values, position) for key, values in of.items()}
            for name, of in each.items()
        }
        for each in (memory.laws, memory.shares)
    )
    worn = {
        name: model.cycle.maps[name].see(depth, position) for name, depth in memory.worn.items()
    }
    between = dict(memory.between)
    for key, (effect, field) in model.laws.between.items():
        if effect.carrier is not None and not field.uniform:
            between[key] = model.cycle.maps[effect.carrier].see(between[key], position)
    return Memory(laws, between, worn, shares)


def filling(model: Model, memory: Memory) -> Array:
    """Return the height of what fills the gap at each position, (positions, nx, ny), in m."""
    heights = np.zeros((len(model.cycle), *model.grid.cells))
    for position, height in enumerate(heights if model.laws.filling else ()):
        here = under(model, memory, position)
        for body, key in model.laws.filling:
            height += here.between[key] if body is None else here.laws[body][key]
    return heights


def state_of(model: Model, memory: Memory, name: str) -> dict[str, Array]:
    """Return what the law of a body is told of its state where the window is, at a position.

    Of a body in layers without shares of an increment that is the layer at the surface.
    """
    shares = memory.shares.get(name, {})
    if not shares and model.laws.wear[name].bottoms:
        shares = at_surface(model.laws.wear[name].bottoms, memory.worn[name])
    return {**memory.laws.get(name, {}), **shares}


def at_surface(bottoms: Sequence[float], worn: Array) -> dict[str, Array]:
    """Return the shares of each layer where points stay in the layer that is at the surface."""
    here = np.searchsorted(bottoms, worn, side="right")
    layers = {layer: np.asarray(here == layer, dtype=float) for layer in range(1 + len(bottoms))}
    rates = {f"rate {layer}": share for layer, share in layers.items()}
    return rates | {f"slope {layer}": share for layer, share in layers.items()}


def laid(model: Model, key: str, rate: Array, position: int) -> Array:
    """Return what a rate in the window adds, by its share, to that of the state of an effect."""
    effect, field = model.laws.between[key]
    if field.uniform:
        return np.asarray(np.mean(rate, keepdims=True))
    return (
        rate if effect.carrier is None else model.cycle.maps[effect.carrier].gather(rate, position)
    )


def fields_of(model: Model, memory: Memory) -> dict[str, dict[str, Array]]:
    """Return what of it is required, where the window is, by field and body, shape (nx, ny).

    What laws remember is there for the bodies whose law does.
    """
    fields: dict[str, dict[str, Array]] = {}
    for name, of_law in memory.laws.items():
        for key in of_law.keys() & model.laws.required:
            of_body = np.broadcast_to(of_law[key], model.grid.cells)
            fields.setdefault(key, OfLaws(key))[name] = of_body
    for key in memory.between.keys() & model.laws.required:
        everywhere = np.broadcast_to(memory.between[key], model.grid.cells)
        fields[key] = dict.fromkeys(model.case.bodies, everywhere)
    return fields


def in_window(model: Model, key: str, values: Array) -> Array:
    """Return the state of an effect as it is told of it: (nx, ny), or (1, 1) if uniform."""
    _, field = model.laws.between[key]
    return readonly(values if field.uniform else np.broadcast_to(values, model.grid.cells))
