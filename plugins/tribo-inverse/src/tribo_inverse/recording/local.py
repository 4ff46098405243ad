"""Wear laws with a factor at each cell of their body's surface, and the inputs that they read."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ParamSpec, TypeVar

import numpy as np
from tribo import (
    Array,
    CaseError,
    ContactConditions,
    ContactSystem,
    LocalConditions,
    Material,
    WearRate,
)
from tribo.kernel_api import PLACE_X, PLACE_Y, GuardedEffect, GuardedLaw, Model, times

OF_MOTION = frozenset({"speed", "time", "distance", "track"})
"""Inputs of laws and effects from the motion."""
OF_CONTACT = frozenset({"modulus", "load", "cap", "curvature", "coatings"})
"""Inputs of effects from the contact, beside its materials."""

P = ParamSpec("P")
T = TypeVar("T")


class LocalLaw(GuardedLaw):
    """A law of a body, times a factor at each cell of the body's own surface.

    Parameters
    ----------
    law : GuardedLaw
        The law.
    factor : ndarray, shape (rows, ny)
        Its factor, not negative.
    spacing : tuple of float
        Edge lengths of a cell along x and y, in m.
    """

    def __init__(self, law: GuardedLaw, factor: Array, spacing: tuple[float, float]) -> None:
        vars(self).update(vars(law))
        self._law = law
        self._factor, self._is_even = factor, bool(np.ptp(factor) == 0)
        if not self._is_even:
            self.requires = tuple(dict.fromkeys((*law.requires, PLACE_X.name, PLACE_Y.name)))
        self._spacing = spacing

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the law's rate and its derivative, times the factor of the place."""
        if self._is_even:
            return times(self._factor[0, 0], self._law.rate(local))
        cells = tuple(
            np.rint(local.fields[place.name] / spacing + 0.5 * (count - 1)).astype(int)
            for place, spacing, count in zip(
                (PLACE_X, PLACE_Y), self._spacing, self._factor.shape, strict=True
            )
        )
        return times(self._factor[cells], self._law.rate(local))


class WatchedLaw(GuardedLaw):
    """A law of a body that notes in `seen` which inputs it read: names of numbers that may change.

    Copying its input counts as reading all of it.
    """

    def __init__(self, law: GuardedLaw, seen: set[str]) -> None:
        vars(self).update(vars(law))
        self._law, self._seen = law, seen
        if law.bottoms:
            # The law of each layer gets a material of its own.
            seen.update(Material.model_fields)

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the law's rate."""
        material: Any = _WatchedMaterial(local.material, self._seen)
        told = {**vars(local), "material": material}
        return self._law.rate(_WatchedLocal(**told, seen=self._seen))


class WatchedEffect(GuardedEffect):
    """An effect that notes in `seen` which inputs it read, as a `WatchedLaw`."""

    def __init__(self, effect: GuardedEffect, seen: set[str]) -> None:
        vars(self).update(vars(effect))
        self._seen = seen

    def ask(self, method: Callable[P, T], *given: P.args, **named: P.kwargs) -> T:
        """Call a method of the effect."""
        told: Any = [self._watched(of) if isinstance(of, ContactConditions) else of for of in given]
        return super().ask(method, *told, **named)

    def _watched(self, contact: ContactConditions) -> ContactConditions:
        seen, system = self._seen, contact.system
        materials: Any = {
            name: _WatchedMaterial(material, seen) for name, material in system.materials.items()
        }
        parts = {**vars(system), "materials": materials}
        told = {**vars(contact), "system": _WatchedSystem(**parts, seen=seen)}
        return _WatchedContact(**told, seen=seen)


@dataclass(frozen=True, kw_only=True)
class _Watched:
    seen: set[str]

    def __getattribute__(self, name: str) -> Any:
        if name in (*OF_MOTION, *OF_CONTACT):
            self.seen.add(name)
        return super().__getattribute__(name)


@dataclass(frozen=True, kw_only=True)
class _WatchedLocal(_Watched, LocalConditions):
    pass


@dataclass(frozen=True, kw_only=True)
class _WatchedContact(_Watched, ContactConditions):
    pass


@dataclass(frozen=True, kw_only=True)
class _WatchedSystem(_Watched, ContactSystem):
    pass


class _WatchedMaterial:
    def __init__(self, material: Material, seen: set[str]) -> None:
        self._material, self._seen = material, seen

    def __getattr__(self, name: str) -> Any:
        fields = Material.model_fields
        self._seen.update([name] if name in fields else fields)
        return getattr(self._material, name)


def watched(model: Model, seen: set[str]) -> Model:
    """Return a model whose laws and effects note in `seen` which of their inputs they read."""
    laws = {name: WatchedLaw(law, seen) for name, law in model.laws.wear.items()}
    effects = tuple(WatchedEffect(effect, seen) for effect in model.laws.effects)
    model = model.with_laws(laws)
    return replace(model, laws=replace(model.laws, effects=effects))


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
        laws[name] = LocalLaw(laws[name], factor, model.grid.spacing)
    return model.with_laws(laws)


def factor_shape(model: Model, name: str) -> tuple[int, int]:
    """Return the shape of the factors on the wear rate of a body; `CaseError` if it has none."""
    if name not in model.laws.wear:
        raise CaseError(f"there is no body {name!r} that wears: {', '.join(model.laws.wear)}")
    return model.cycle.maps[name].rows, model.grid.cells[1]
