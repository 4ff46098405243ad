"""The whole input of a simulation."""

from __future__ import annotations

from typing import Annotated, Any

from packaging.requirements import InvalidRequirement, Requirement
from pydantic import Field, field_validator

from tribo.config.slot import Slot
from tribo.config.stepping import ImplicitConfig, Stepping
from tribo.config.stop import StopConfig
from tribo.config.table import Table
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.units import Quantity
from tribo.interfaces.contact import ContactSolverConfig
from tribo.interfaces.effect import EffectConfig
from tribo.interfaces.kinematics import KinematicsConfig
from tribo.interfaces.observer import ObserverConfig
from tribo.interfaces.surface import SurfaceConfig
from tribo.interfaces.wear import WearLawConfig

Length = Annotated[float, Quantity("m", above=0, usual=(1e-9, 0.1))]
Cells = Annotated[int, Field(ge=4, le=16384)]


def _or_one(schema: dict[str, Any]) -> None:
    """Let a schema for a pair also take one value for both."""
    pair = {key: schema.pop(key) for key in list(schema) if key != "description"}
    schema["anyOf"] = [pair["prefixItems"][0], pair]


class GridConfig(Table):
    """The window on the contact; one number stands for both axes."""

    size: tuple[Length, Length] = Field(json_schema_extra=_or_one)
    """Edge lengths along x, the sliding direction, and y."""
    cells: tuple[Cells, Cells] = Field(json_schema_extra=_or_one)
    """Number of cells along x and y."""
    ends_at_window: bool = False
    """Whether a body ends at the window's edge, as a flat pin does: contact may then reach it."""

    @field_validator("size", "cells", mode="before")
    @classmethod
    def _both_axes(cls, value: Any) -> Any:
        return (value, value) if isinstance(value, int | float | str) else value

    def to_grid(self) -> Grid:
        """Return the grid."""
        return Grid(self.size, self.cells)


class LoadConfig(Table):
    """The load on the contact."""

    normal: Annotated[float, Quantity("N", above=0, usual=(1e-12, 1e6))]
    """Normal load, constant in time."""


class BodyConfig(Table):
    """One of the two bodies."""

    surface: Annotated[SurfaceConfig, Slot("surface")]
    """Shape before it wears."""
    material: Material
    """What it is made of."""
    wear: Annotated[WearLawConfig, Slot("wear_law")] | None = None
    """How it wears; it does not if left out."""


class FrictionConfig(Table):
    """Friction, for the laws and effects that ask for it; it does not act on the contact."""

    coefficient: Annotated[float, Quantity("1", at_least=0)]
    """Coefficient of friction, uniform and constant."""


class OutputConfig(Table):
    """What is kept."""

    save_times: tuple[Annotated[float, Quantity("s", at_least=0)], ...] = ()
    """Times at which all fields are saved; t = 0 and the end always are."""


class Case(Table):
    """A case: two bodies, a load, a motion, and how to compute."""

    requires: tuple[str, ...] = ()
    """Distributions that must be installed, as ``"acme-tribo>=1.2"``."""
    grid: GridConfig
    load: LoadConfig
    bodies: dict[str, BodyConfig]
    """The two bodies, by name."""
    contact: Annotated[ContactSolverConfig, Slot("contact_solver")] = Field(
        default="dcfft", validate_default=True
    )
    """How the normal contact is solved."""
    kinematics: Annotated[KinematicsConfig, Slot("kinematics")]
    """How the bodies move."""
    stepping: Stepping = ImplicitConfig()
    """How the run moves on in time."""
    friction: FrictionConfig | None = None
    effects: tuple[Annotated[EffectConfig, Slot("effect")], ...] = ()
    """What else the contact produces."""
    observers: tuple[Annotated[ObserverConfig, Slot("observer")], ...] = ()
    """Who watches the run."""
    output: OutputConfig = OutputConfig()
    stop: StopConfig = StopConfig()

    @field_validator("requires")
    @classmethod
    def _requirements(cls, requires: tuple[str, ...]) -> tuple[str, ...]:
        for text in requires:
            try:
                Requirement(text)
            except InvalidRequirement:
                raise ValueError(
                    f"{text!r} is not a requirement; write one as 'acme-tribo>=1.2'"
                ) from None
        return requires

    @field_validator("bodies")
    @classmethod
    def _two_bodies(cls, bodies: dict[str, BodyConfig]) -> dict[str, BodyConfig]:
        if len(bodies) != 2:
            raise ValueError(
                f"a contact needs two bodies, as [bodies.ball] and [bodies.disk]; "
                f"{len(bodies)} given"
            )
        for name in bodies:
            if not name.replace("_", "").replace("-", "").isalnum():
                raise ValueError(
                    f"{name!r} is no good as a body's name; use letters, digits, - and _"
                )
        return bodies
