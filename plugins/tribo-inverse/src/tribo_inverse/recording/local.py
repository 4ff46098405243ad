"""Wear laws with a factor at each cell of their body's surface, and the inputs that they read."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import make_dataclass, replace
from functools import cache
from typing import Any, ParamSpec, TypeVar

import numpy as np
from tribo import (
    Array,
    CaseError,
    ContactConditions,
    LocalConditions,
    Material,
    WearRate,
)
from tribo.kernel_api import PLACE_X, PLACE_Y, GuardedEffect, GuardedLaw, Model, times

OF_MOTION = frozenset({"speed", "time", "distance", "track"})
"""Inputs of laws and effects from the motion."""
OF_CONTACT = frozenset({"modulus", "load", "cap", "curvature", "coatings"})
"""Inputs of effects from the contact, beside its materials."""

G = TypeVar("G", GuardedLaw, GuardedEffect)
P = ParamSpec("P")
T = TypeVar("T")


def replaced(part: G, **changes: Any) -> G:
    """Return a copy of a law or an effect with other attributes or methods."""
    other = copy(part)
    vars(other).update(changes)
    return other


def _local(law: GuardedLaw, factor: Array, spacing: tuple[float, float]) -> GuardedLaw:
    """Return a law times a factor at each cell, of edges `spacing`, of its body's own surface."""
    even = bool(np.ptp(factor) == 0)

    def rate(local: LocalConditions) -> WearRate:
        if even:
            return times(factor[0, 0], law.rate(local))
        cells = tuple(
            np.rint(local.fields[place.name] / edge + 0.5 * (count - 1)).astype(int)
            for place, edge, count in zip((PLACE_X, PLACE_Y), spacing, factor.shape, strict=True)
        )
        return times(factor[cells], law.rate(local))

    places = () if even else (PLACE_X.name, PLACE_Y.name)
    return replaced(law, rate=rate, requires=tuple(dict.fromkeys((*law.requires, *places))))


def watched(model: Model, seen: set[str]) -> Model:
    """Return a model whose laws and effects note in `seen` which numbers they read.

    These are numbers of materials, `OF_MOTION` and `OF_CONTACT`. Copying reads all of them.
    """

    def material(of: Material) -> Any:
        return _WatchedMaterial(of, seen)

    def watched_law(law: GuardedLaw) -> GuardedLaw:
        if law.bottoms:
            # The law of each layer gets a material of its own.
            seen.update(Material.model_fields)

        def rate(local: LocalConditions) -> WearRate:
            return law.rate(_watched(local, seen, material=material(local.material)))

        return replaced(law, rate=rate)

    def watched_effect(effect: GuardedEffect) -> GuardedEffect:
        def ask(method: Callable[P, T], *given: P.args, **named: P.kwargs) -> T:
            told: Any = [
                conditions(of) if isinstance(of, ContactConditions) else of for of in given
            ]
            return effect.ask(method, *told, **named)

        return replaced(effect, ask=ask)

    def conditions(contact: ContactConditions) -> ContactConditions:
        materials = {name: material(of) for name, of in contact.system.materials.items()}
        system = _watched(contact.system, seen, materials=materials)
        return _watched(contact, seen, system=system)

    laws = {name: watched_law(law) for name, law in model.laws.wear.items()}
    effects = tuple(map(watched_effect, model.laws.effects))
    return replace(model, laws=replace(model.laws, wear=laws, effects=effects))


def _watched(inputs: T, seen: set[str], **changes: Any) -> T:
    """Return inputs with changes, of which reading a number is noted."""
    kind: Any = type(inputs)
    found: T = _watching(kind)(**{**vars(inputs), **changes}, seen=seen)
    return found


@cache
def _watching(kind: Any) -> Any:
    def read(self: Any, name: str) -> Any:
        if name in OF_MOTION or name in OF_CONTACT:
            self.seen.add(name)
        return object.__getattribute__(self, name)

    return make_dataclass(
        f"Watched{kind.__name__}",
        [("seen", set[str])],
        bases=(kind,),
        namespace={"__getattribute__": read},
        frozen=True,
        kw_only=True,
    )


class _WatchedMaterial:
    def __init__(self, material: Material, seen: set[str]) -> None:
        self._material, self._seen = material, seen

    def __getattr__(self, name: str) -> Any:
        fields = Material.model_fields
        self._seen.update([name] if name in fields else fields)
        return getattr(self._material, name)


def localised(model: Model, factors: Mapping[str, Array]) -> Model:
    """Return a model with a factor on the wear rate of bodies, at each cell of their surfaces.

    Parameters
    ----------
    model : Model
        The composed case.
    factors : Mapping[str, ndarray]
        By name of the body, of the shape of its wear.

    Raises
    ------
    CaseError
        If a body does not wear, or a map does not have that shape, or is negative or not finite.
    """
    laws = dict(model.laws.wear)
    for name, factor in factors.items():
        shape = factor_shape(model, name)
        if np.shape(factor) != shape:
            raise CaseError(f"the factors of {name} have the shape {np.shape(factor)}, not {shape}")
        if not np.all(np.isfinite(factor) & (factor >= 0)):
            raise CaseError(f"a factor on the wear rate of {name} is negative, NaN or infinite")
        laws[name] = _local(laws[name], factor, model.grid.spacing)
    return model.with_laws(laws)


def factor_shape(model: Model, name: str) -> tuple[int, int]:
    """Return the shape of the factors on the wear rate of a body; `CaseError` if it has none."""
    if name not in model.laws.wear:
        raise CaseError(f"there is no body {name!r} that wears: {', '.join(model.laws.wear)}")
    return model.cycle.maps[name].rows, model.grid.cells[1]
