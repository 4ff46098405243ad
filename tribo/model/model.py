"""The data of a run, derived from its case once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from tribo.case import Case
from tribo.component import components
from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.grid import Grid
from tribo.core.loads import Loads
from tribo.core.measures import reaches_border
from tribo.core.state import State
from tribo.guards.guard import Guard
from tribo.guards.motion import GuardedMotion
from tribo.guards.parts import GuardedLaw, GuardedSurface
from tribo.model.contact_setup import ContactSetup
from tribo.model.cycle import Cycle
from tribo.model.events import Listener
from tribo.model.laws import Laws


@dataclass(frozen=True)
class Model:
    """A case, and the data that a run derives from it once; made by `assemble`.

    The parts of the case are guarded: errors name the part, and its answers are checked.
    """

    case: Case
    motion: GuardedMotion
    surfaces: Mapping[str, GuardedSurface]
    cycle: Cycle
    contact: ContactSetup
    laws: Laws
    end_time: float
    listener: Listener = field(default_factory=Listener)

    @property
    def grid(self) -> Grid:
        """The window."""
        return self.cycle.grid

    @cached_property
    def changing(self) -> tuple[str, ...]:
        """Names of the swept bodies that change their shape."""
        yielding = (name for name, share in self.contact.plastic_share.items() if share > 0)
        alter = {*self.laws.wear, *yielding}
        return tuple(name for name in self.case.bodies if name in self.cycle.swept & alter)

    def loads(self, state: State) -> Loads:
        """Return the normal load at a state, and over the step from there."""
        loads, by = self.contact.loads, state.load_factor
        return loads if by == 1 else replace(loads, factor=by)

    @property
    def couples(self) -> bool:
        """Whether the positions of the cycle are solved together, with the wear they share."""
        return self.case.contact.couples and self.cycle.shares_points

    def leaves_window(self, contact: ContactSolution) -> bool:
        """Whether a contact reaches the border of a window, or has no room across.

        A window at which a body ends has no such border. The path across must fit next to the
        contact, as columns of a body are counted round.
        """
        columns = contact.extent[1]
        if self.case.contact.periodic:
            return False
        if columns.stop - columns.start + self.cycle.across > self.grid.cells[1]:
            return True
        return not self.contact.may_reach_edge and reaches_border(contact.pressure)

    @property
    def rough(self) -> bool:
        """Whether a surface has relief that a coarse grid cannot show."""
        surfaces = [body.surface for body in self.case.bodies.values()]
        return any(surface.smoothed() is not surface for surface in surfaces)

    def with_laws(self, wear: Mapping[str, GuardedLaw]) -> Model:
        """Return the same with other wear laws, by body."""
        return replace(self, laws=replace(self.laws, wear=wear))

    def height(self, name: str) -> Array:
        """Return a body's initial height in the window, in the middle of the cycle."""
        return self.cycle.maps[name].see(self.surfaces[name].height, self.cycle.middle)

    @cached_property
    def save_times(self) -> tuple[float, ...]:
        """Times at which the case has all fields saved, in s."""
        return tuple(map(self.motion.moment, self.case.output.save_times))

    @cached_property
    def saves(self) -> frozenset[float]:
        """Times after t = 0 at which all fields are saved, in s."""
        times = self.save_times
        return frozenset({*(t for t in times if 0 < t < self.end_time), self.end_time})

    @cached_property
    def end_distance(self) -> float:
        """Sliding distance at the end of the run, in m."""
        return self.motion.distance_at(self.end_time)

    @property
    def data(self) -> dict[str, Any]:
        """The case as plain data, in SI units, ready for JSON."""
        for _, component in components(self.case):
            # Of the whole case an error would not tell which component it is from.
            Guard(component).ask(component.model_dump, mode="json")
        return self.case.model_dump(mode="json")
