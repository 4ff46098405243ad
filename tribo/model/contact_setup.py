"""The unworn contact of a case: solver, bodies and loads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from tribo.core.arrays import Array
from tribo.core.contact import ContactSystem
from tribo.core.loads import Loads
from tribo.core.measures import between_cells
from tribo.guards.parts import GuardedSolver


@dataclass(frozen=True)
class ContactSetup:
    """The constants of every contact of a run.

    Parameters
    ----------
    solver : GuardedSolver
        The contact solver.
    system : ContactSystem
        The two bodies, under the load of the first contact.
    loads : Loads
        Normal load over time.
    gaps : tuple of ndarray
        Initial gap at each position, shape (nx, ny), in m, with minimum 0 in the middle.
    plastic_share : Mapping of float
        Part of the plastic overlap that each body takes, by body.
    hardness : Mapping of tuple of float
        Hardness of layers and of the body below, in Pa, by body, where it changes with the depth.
    """

    solver: GuardedSolver
    system: ContactSystem
    loads: Loads
    gaps: tuple[Array, ...]
    plastic_share: Mapping[str, float]
    hardness: Mapping[str, tuple[float, ...]] = field(default_factory=dict)

    @property
    def gap(self) -> Array:
        """Initial gap in the middle of the cycle, shape (nx, ny), in m."""
        return self.gaps[len(self.gaps) // 2]

    @cached_property
    def closest(self) -> float:
        """Gap at the closest point, in m: below 0 where that lies between cells.

        Surfaces that state no curvature, as rough ones, are taken as they are sampled.
        """
        return 0.0 if self.system.curvature is None else -between_cells(-self.gap)

    @property
    def may_reach_edge(self) -> bool:
        """Whether the contact may reach the edge of the window."""
        return self.system.grid.ends_at_window or self.solver.component.periodic
