"""Small components, and a model with slots for them."""

from __future__ import annotations

from types import ModuleType
from typing import Annotated, Literal

from pydantic import Field, model_validator

from tribo.core.arrays import Array
from tribo.core.fields import LocalConditions, WearRate
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.table import Table
from tribo.core.units import Quantity
from tribo.observers.observer import Observer
from tribo.registry.hookspecs import hookimpl
from tribo.registry.plugins import given
from tribo.registry.registry import Registry
from tribo.surfaces.surface import Surface
from tribo.wear.law import WearLaw


class Linear(WearLaw):
    type = "linear"
    k: Annotated[float, Quantity("1/Pa", above=0)]
    """Coefficient."""
    passes: int = 3

    def rate(self, local: LocalConditions) -> WearRate:
        raise NotImplementedError


class NoWear(WearLaw):
    type = "none"

    def rate(self, local: LocalConditions) -> WearRate:
        raise NotImplementedError


class Blend(WearLaw):
    type = "blend"
    parts: tuple[WearLaw, ...]
    weight: float | Literal["auto"] = "auto"

    @model_validator(mode="after")
    def _not_empty(self) -> Blend:
        if not self.parts:
            raise ValueError("give at least one part")
        return self

    def rate(self, local: LocalConditions) -> WearRate:
        raise NotImplementedError


class Plane(Surface):
    type = "plane"

    def height(self, grid: Grid) -> Array:
        raise NotImplementedError


class Counter(Observer):
    type = "counter"
    every: int = Field(default=1, ge=1)


def registry(*laws: type[WearLaw]) -> Registry:
    """The registry of these dummies, with other wear laws if any are given."""
    module = ModuleType("dummies")
    module.__version__ = "1.0"  # type: ignore[attr-defined]
    classes = (*(laws or (Linear, NoWear, Blend)), Plane, Counter)
    module.tribo_components = hookimpl(specname="tribo_components")(lambda: classes)  # type: ignore[attr-defined]
    return Registry([given(module)])


class Body(Table):
    material: Material
    surface: Surface = Plane()
    wear: WearLaw | None = None


class Slow(Table):
    type: Literal["slow"] = "slow"
    step: Annotated[float, Quantity("s", above=0)]


class Fast(Table):
    type: Literal["fast"] = "fast"
    limit: int = 3


class Rig(Table):
    bodies: dict[str, Body]
    cells: tuple[int, int] = (8, 8)
    verbose: bool = False
    stepping: Annotated[Slow | Fast, Field(discriminator="type")] = Fast()
    observers: tuple[Observer, ...] = ()
