"""A case with what follows from it: everything checked, nothing solved yet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from tribo.case import Body, Case
from tribo.config.stepping import Explicit, Implicit
from tribo.config.stop import Stop
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array
from tribo.core.contact import ContactSystem
from tribo.core.grid import Grid
from tribo.core.measures import between_cells
from tribo.effects.effect import Effect
from tribo.motion.exposure import Exposure
from tribo.motion.kinematics import Kinematics
from tribo.simulation import motion
from tribo.simulation.calling import calling
from tribo.wear.law import WearLaw


@dataclass(frozen=True)
class Model:
    """A case, and what a run derives from it once; made by `assemble`.

    Parameters
    ----------
    case : Case
        The case.
    effects : tuple of Effect
        Its effects, each after those that provide what it requires.
    exposures : Mapping[str, Exposure]
        How each body, by name, meets the contact.
    plastic_share : Mapping[str, float]
        Part of the plastic overlap that each body, by name, takes.
    system : ContactSystem
        The constants of the contact.
    gap : ndarray, shape (nx, ny)
        Initial gap, in m, with minimum 0.
    """

    case: Case
    effects: tuple[Effect, ...]
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

    @cached_property
    def grid(self) -> Grid:
        """The window."""
        return self.case.grid

    @cached_property
    def load(self) -> float:
        """Normal load, in N."""
        return self.case.load.normal

    @cached_property
    def bodies(self) -> Mapping[str, Body]:
        """The bodies, by name."""
        return self.case.bodies

    @cached_property
    def contact(self) -> ContactSolver:
        """How the contact is solved."""
        return self.case.contact

    @cached_property
    def kinematics(self) -> Kinematics:
        """How the bodies move."""
        return self.case.kinematics

    @cached_property
    def stepping(self) -> Implicit | Explicit:
        """How the run moves on."""
        return self.case.stepping

    @cached_property
    def stop(self) -> Stop:
        """What ends the run early."""
        return self.case.stop

    @cached_property
    def friction_coefficient(self) -> float | None:
        """Coefficient of friction, if the case has one."""
        return None if self.case.friction is None else self.case.friction.coefficient

    @cached_property
    def may_reach_edge(self) -> bool:
        """Whether the contact may reach the edge of the window."""
        return self.grid.ends_at_window or self.contact.periodic

    @cached_property
    def end_time(self) -> float:
        """When the run ends if no depth stops it earlier, in s."""
        return motion.end_time(self.kinematics, self.stop.distance)

    @property
    def data(self) -> dict[str, Any]:
        """The case as plain data, in SI units, ready for JSON."""
        for _, component in self.case.components():
            with calling(component):
                component.model_dump(mode="json")
        return self.case.model_dump(mode="json")

    @cached_property
    def laws(self) -> list[WearLaw]:
        """The wear laws of the bodies that wear."""
        return [body.wear for body in self.bodies.values() if body.wear is not None]

    def is_swept(self, name: str) -> bool:
        """Whether the body's points pass through the contact."""
        return self.exposures[name].swept
