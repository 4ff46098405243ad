"""A cycle of a result: its loop, its energy, and the stick zone of the contact."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from tribo import Array, Mask, Material, Result

from tribo_fretting.motion import Fretting

POINTS = 16
"""Of the first loading, from which a loop is drawn."""


def motion_of(result: Result) -> Fretting | None:
    """Return the motion of a result, if it is fretting."""
    given = dict(result.case_tables.get("kinematics", {}))
    return Fretting.model_validate(given) if given.pop("type", None) == Fretting.type else None


@dataclass(frozen=True)
class SavedCycle:
    """The cycle at a save of a result that frets; -1 is the last save."""

    result: Result
    motion: Fretting
    save: int

    @property
    def amplitude(self) -> float:
        """Amplitude to each side, in m."""
        return self.motion.amplitude_at(float(self.result.times[self.save]))

    @cached_property
    def pressure(self) -> Array:
        """Contact pressure, in Pa."""
        return self.result.field("pressure", self.save)

    @cached_property
    def slip(self) -> Array:
        """Slip of each point in the contact from one end of the stroke to the other, in m."""
        return np.where(self.pressure > 0, 2 * self.amplitude * self._kept("local_slip"), 0.0)

    @property
    def stuck(self) -> Mask:
        """Where the contact sticks."""
        return np.asarray((self.pressure > 0) & (self.slip == 0))

    @cached_property
    def friction(self) -> Array:
        """Coefficient of friction at each point."""
        if self.result.has("friction_coefficient"):
            return self._kept("friction_coefficient")
        return np.full_like(self.pressure, self.result.case_tables["friction"]["coefficient"])

    @cached_property
    def materials(self) -> dict[str, Material]:
        """The bodies' materials, by name."""
        bodies = self.result.case_tables["bodies"].items()
        return {name: Material.model_validate(body["material"]) for name, body in bodies}

    def loop(self) -> tuple[Array, Array]:
        """Return the displacement of the rig (m) and the tangential force (N) along the cycle.

        From the first loading, by Masing's rule: the branches are twice as large.
        """
        grid, limit = self.result.grid, self.friction * self.pressure
        first = np.zeros((POINTS + 1, 2))
        for point, amplitude in enumerate(np.linspace(0, self.amplitude, POINTS + 1)[1:], 1):
            drag = self.motion.first_loading(grid, self.materials, limit, float(amplitude))
            first[point] = drag.displacement, np.sum(drag.traction[0]) * grid.cell_area
        back = first[-1] - 2 * first
        moved, force = np.concatenate([back, -back]).T
        return moved, force

    def _kept(self, name: str) -> Array:
        return self.result.field(name, self.save, self.result.body_names[0])
