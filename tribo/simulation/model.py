"""A case made of objects: everything checked, nothing solved yet."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from tribo.config.stepping import ExplicitConfig, ImplicitConfig
from tribo.config.stop import StopConfig
from tribo.core.arrays import Array
from tribo.core.contact import ContactSystem
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.measures import between_cells
from tribo.interfaces.component import Component, ComponentConfig
from tribo.interfaces.contact import ContactSolver, ContactSolverConfig
from tribo.interfaces.effect import Effect, EffectConfig
from tribo.interfaces.exposure import Exposure
from tribo.interfaces.kinematics import Kinematics, KinematicsConfig
from tribo.interfaces.observer import Observer, ObserverConfig
from tribo.interfaces.surface import Surface, SurfaceConfig
from tribo.interfaces.wear import WearLaw, WearLawConfig
from tribo.simulation import motion


@dataclass(frozen=True)
class Body:
    """One of the two bodies.

    Parameters
    ----------
    name : str
        Its name.
    surface : Surface
        Its shape before it wears.
    material : Material
        What it is made of.
    wear : WearLaw, optional
        How it wears; it does not if left out.
    """

    name: str
    surface: Surface[SurfaceConfig]
    material: Material
    wear: WearLaw[WearLawConfig] | None = None


@dataclass(frozen=True)
class Model:
    """The composed case; make one with `assemble`.

    Besides what `assemble` takes, it holds what follows from it: `exposures`
    and `plastic_share` by body name, the constants of the contact `system`,
    and the initial `gap` in m, shape (nx, ny), with minimum 0.
    """

    grid: Grid
    load: float
    bodies: tuple[Body, ...]
    contact: ContactSolver[ContactSolverConfig]
    kinematics: Kinematics[KinematicsConfig]
    stepping: ImplicitConfig | ExplicitConfig
    friction_coefficient: float | None
    effects: tuple[Effect[EffectConfig], ...]
    observers: tuple[Observer[ObserverConfig], ...]
    save_times: tuple[float, ...]
    stop: StopConfig
    requires: tuple[str, ...]
    ends_at_window: bool
    exposures: Mapping[str, Exposure]
    plastic_share: Mapping[str, float]
    system: ContactSystem
    gap: Array

    @cached_property
    def closest(self) -> float:
        """Gap at the closest point, in m: below 0 where that lies between cells.

        Surfaces that state no curvature, as rough ones, are taken as they are sampled.
        """
        return 0.0 if self.system.curvature is None else -between_cells(-self.gap)

    @property
    def may_reach_edge(self) -> bool:
        """Whether the contact may reach the edge of the window."""
        return self.ends_at_window or self.contact.periodic

    @property
    def end_time(self) -> float:
        """When the run ends if no depth stops it earlier, in s."""
        return motion.end_time(self.kinematics, self.stop.distance)

    def is_swept(self, name: str) -> bool:
        """Whether the body's points pass through the contact."""
        return self.exposures[name].swept

    def components(self) -> Iterator[tuple[str, Component[ComponentConfig]]]:
        """Yield every component with its place in a case."""
        for body in self.bodies:
            yield f"bodies.{body.name}.surface", body.surface
            if body.wear is not None:
                yield f"bodies.{body.name}.wear", body.wear
        yield "contact", self.contact
        yield "kinematics", self.kinematics
        for i, effect in enumerate(self.effects):
            yield f"effects[{i}]", effect
        for i, observer in enumerate(self.observers):
            yield f"observers[{i}]", observer
