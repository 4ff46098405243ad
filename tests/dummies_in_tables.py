"""Small components, and a model with slots for them."""

from __future__ import annotations

from types import ModuleType
from typing import Annotated, Literal

from pydantic import Field, model_validator

from tribo import Material, Observer, Quantity, Registry, Surface, WearLaw, hookimpl
from tribo.core.table import Table
from tribo.registry.plugins import given


class Law(WearLaw):
    def rate(self, local):
        raise NotImplementedError


class Linear(Law):
    type = "linear"
    k: Annotated[float, Quantity("1/Pa", above=0)]
    """Coefficient."""
    passes: int = 3


class NoWear(Law):
    type = "none"


class Blend(Law):
    type = "blend"
    parts: tuple[WearLaw, ...]
    weight: float | Literal["auto"] = "auto"

    @model_validator(mode="after")
    def _not_empty(self) -> Blend:
        if not self.parts:
            raise ValueError("give at least one part")
        return self


class Plane(Surface):
    type = "plane"

    def height(self, grid):
        raise NotImplementedError


class Counter(Observer):
    type = "counter"
    every: int = Field(default=1, ge=1)


def registry(*laws):
    """The registry of these dummies, with other wear laws if any are given."""
    module = ModuleType("dummies")
    module.__version__ = "1.0"
    classes = (*(laws or (Linear, NoWear, Blend)), Plane, Counter)
    module.tribo_components = hookimpl(specname="tribo_components")(lambda: classes)
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
