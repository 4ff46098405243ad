"""What a run needs of a case, derived from it once: arrays, exposures, guards."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from tribo.case import Body, Case
from tribo.component import components
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array, add_from, readonly, rows_from
from tribo.core.contact import ContactSystem
from tribo.core.fields import FRICTION_COEFFICIENT, LOAD_SHARE, PLACE_X, PLACE_Y, Field
from tribo.core.grid import Grid
from tribo.core.loads import Loads
from tribo.core.measures import between_cells
from tribo.lab.roughness import is_rough
from tribo.motion.cycle import Position, missed_shares
from tribo.motion.exposure import Exposure
from tribo.simulation.guard import Guard
from tribo.simulation.guarded_motion import GuardedMotion
from tribo.simulation.guards import (
    GuardedEffect,
    GuardedLaw,
    GuardedSolver,
    GuardedSurface,
)
from tribo.stepping.events import Listener, unheard
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit


@dataclass(frozen=True)
class Model:
    """A case, and what a run derives from it once; made by `assemble`.

    The parts of the case are guarded: what goes wrong in one names it, and what it answers is
    checked. Mappings are by the name of the body; `laws` has those that wear, `plastic_share` the
    part of the plastic overlap that each takes, `effects` come after those that provide what they
    require. `hardness` is that of layers and of what lies below, where it changes with the depth
    worn; `chosen` says which positions were taken where the case left them open. `tell` hears what
    happens in each step, rejected ones too.
    """

    case: Case
    solver: GuardedSolver
    motion: GuardedMotion
    surfaces: Mapping[str, GuardedSurface]
    laws: Mapping[str, GuardedLaw]
    effects: tuple[GuardedEffect, ...]
    exposures: Mapping[str, Exposure]
    plastic_share: Mapping[str, float]
    system: ContactSystem
    loads: Loads
    cycle: tuple[Position, ...]
    gaps: tuple[Array, ...]
    """Initial gap at each position, shape (nx, ny), in m, with minimum 0 in the middle."""
    end_time: float
    hardness: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    chosen: str | None = None
    tell: Listener = unheard

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
    def gap(self) -> Array:
        """Initial gap in the middle of the cycle, shape (nx, ny), in m."""
        return self.gaps[len(self.gaps) // 2]

    @cached_property
    def between(self) -> Mapping[str, tuple[GuardedEffect, Field]]:
        """The state fields of the effects, by name, each with its effect."""
        return {f.name: (effect, f) for effect in self.effects for f in effect.state_fields}

    @cached_property
    def advances(self) -> bool:
        """Whether all that remember know the mean of their rates over an increment.

        At points that stay (one that is swept sees many pressures, of which a closed form knows
        one) and where nothing follows an effect, as a closed form does not see what that comes to
        within the increment.
        """
        if not self._leaves_means:
            return False
        known = [self.knows_mean(name) for name, law in self.laws.items() if law.initial_state] + [
            effect.advances and effect.carrier not in self.swept
            for effect in self.effects
            if effect.initial_state
        ]
        return bool(known) and all(known) and not any(body is None for body, _ in self.filling)

    @cached_property
    def tells_length(self) -> bool:
        """Whether laws that know the mean of their rate are asked for that over a part.

        Where not all know it that spares parts only if points of one that does pass layers.
        """
        if self.advances or self.between or not self._leaves_means:
            return self.advances
        return any(
            bool(law.bottoms and law.initial_state) and self.knows_mean(name)
            for name, law in self.laws.items()
        )

    def knows_mean(self, name: str) -> bool:
        """Whether the law of a body knows the mean of its rate at points that stay, as all do."""
        return self.laws[name].advances and name not in self.swept

    @cached_property
    def _leaves_means(self) -> bool:
        """Whether closed forms are right at points that stay, as far as effects go."""
        given = {f.name for each in self.effects for f in (*each.state_fields, *each.provides)}
        followed = {LOAD_SHARE.name, FRICTION_COEFFICIENT.name}
        followed.update(*(law.requires for law in self.laws.values()))
        followed.update(*(effect.requires for effect in self.effects))
        return len(self.cycle) == 1 and not given & followed

    @cached_property
    def filling(self) -> tuple[tuple[str | None, str], ...]:
        """The state fields that fill the gap, with the body whose law has them; None of effects."""
        of_laws = ((name, f) for name, law in self.laws.items() for f in law.state_fields)
        of_effects = ((None, f) for effect in self.effects for f in effect.state_fields)
        return tuple((body, f.name) for body, f in (*of_laws, *of_effects) if f.fills)

    @cached_property
    def required(self) -> frozenset[str]:
        """Names of the fields that laws and effects need."""
        of_laws = (name for law in self.laws.values() for name in law.requires)
        return frozenset((*of_laws, *(n for effect in self.effects for n in effect.requires)))

    def kept_on(self, body: str | None) -> tuple[Field, ...]:
        """Return the state fields on a body's surface; None for those of the contact as a whole."""
        law = self.laws.get(body) if body is not None else None
        carried = (
            field
            for effect, field in self.between.values()
            if (None if field.uniform else effect.carrier) == body
        )
        return (*(law.state_fields if law else ()), *carried)

    @property
    def load(self) -> float:
        """Normal load of the first contact, in N."""
        return self.system.load

    @cached_property
    def bodies(self) -> Mapping[str, Body]:
        """The bodies, by name."""
        return self.case.bodies

    @cached_property
    def contact(self) -> ContactSolver:
        """How the contact is solved, unguarded."""
        return self.case.contact

    @cached_property
    def stepping(self) -> Implicit | Explicit:
        """How the run moves on."""
        return self.case.stepping

    @cached_property
    def friction_coefficient(self) -> float | None:
        """Coefficient of friction, if the case has one."""
        return None if self.case.friction is None else self.case.friction.coefficient

    @cached_property
    def friction_varies(self) -> bool:
        """Whether an effect provides the coefficient of friction."""
        provided = (field.name for effect in self.effects for field in effect.provides)
        return FRICTION_COEFFICIENT.name in provided

    @cached_property
    def friction_remembers(self) -> bool:
        """Whether the coefficient of friction follows what laws or effects remember."""
        following = {field.name for law in self.laws.values() for field in law.state_fields}
        following.update(self.between)
        # In the order in which they are asked.
        for effect in self.effects:
            if effect.state_fields or following & set(effect.requires):
                following.update(field.name for field in effect.provides)
        return FRICTION_COEFFICIENT.name in following

    @cached_property
    def may_reach_edge(self) -> bool:
        """Whether the contact may reach the edge of the window."""
        return self.grid.ends_at_window or self.contact.periodic

    @cached_property
    def swept(self) -> frozenset[str]:
        """Names of the bodies whose points pass through the contact."""
        return frozenset(name for name, exposure in self.exposures.items() if exposure.swept)

    @cached_property
    def changing(self) -> tuple[str, ...]:
        """Names of the swept bodies that change their shape."""
        alter = {*self.laws, *(name for name, share in self.plastic_share.items() if share > 0)}
        return tuple(name for name in self.bodies if name in self.swept & alter)

    @cached_property
    def couples(self) -> bool:
        """Whether the positions of the cycle are solved together, with the wear they share."""
        along = self.grid.cells[0]
        own_rows = all(e.starts is not None or e.rows == along for e in self.exposures.values())
        return len(self.cycle) > 1 and self.contact.couples and own_rows

    @cached_property
    def rough(self) -> frozenset[str]:
        """Names of the bodies that are more than a smooth form at first."""
        middle = len(self.cycle) // 2
        unsure = {n: s for n, s in self.surfaces.items() if not self.case.bodies[n].surface.smooth}
        heights = {n: self.under(n, s.height, middle) for n, s in unsure.items()}
        return frozenset(name for name, height in heights.items() if is_rough(height))

    @cached_property
    def apart(self) -> float:
        """Largest distance between neighbouring positions of the cycle, in m; 0 of an average."""
        steps = [np.diff(e.starts) for e in self.exposures.values() if e.starts is not None]
        widest = max((float(np.max(np.abs(s), initial=0)) for s in steps), default=0.0)
        return widest * self.grid.spacing[0]

    @cached_property
    def saves(self) -> frozenset[float]:
        """Times after t = 0 at which all fields are saved, in s."""
        times = self.case.output.save_times
        return frozenset({*(t for t in times if 0 < t < self.end_time), self.end_time})

    @cached_property
    def missed_shares(self) -> Array | None:
        """Shares by which rates at the positions add up to what is estimated to lie between them.

        None where the cycle is not resolved, or into every cell.
        """
        starts = [e.starts for e in self.exposures.values() if e.starts is not None]
        if not starts or self.apart <= self.grid.spacing[0]:
            return None
        nodes = -np.array(starts[0], dtype=float)
        shares = np.array([position.share for position in self.cycle])
        return missed_shares(nodes, shares)

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

    def average(self, name: str, rate: Array, position: int) -> Array:
        """Return what the rate (nx, ny) at a position adds, by its share, to a body's mean rate."""
        return self.spread(name, self.exposures[name].average(rate), position)

    def add_average(
        self, name: str, total: Array | None, rate: Array, position: int, part: float
    ) -> Array:
        """Return a part of `average` added to `total`, in place where the body has rows of its own.

        Without a total it is that part, as a new array.
        """
        exposure = self.exposures[name]
        mean = part * exposure.average(rate)
        if exposure.starts is None:
            return mean if total is None else total + mean
        if total is None:
            return self.spread(name, mean, position)
        add_from(total, mean, exposure.starts[position])
        return total

    def under(self, name: str, field: Array, position: int) -> Array:
        """Return what lies in the window of a field on a body's own surface, at a position.

        Shape (nx, ny), or (1, ny) of a field that is the same all along a track.
        """
        starts = self.exposures[name].starts
        return field if starts is None else rows_from(field, starts[position], self.grid.cells[0])

    def places(self, position: int) -> dict[str, dict[str, Array]]:
        """Return where each body's own surface lies in the window at a position, in m.

        x is 0 on a body of which every point of a track is the same.
        """
        dx, cells = self.grid.spacing[0], self.grid.cells
        along, across = {}, {}
        for name, exposure in self.exposures.items():
            own = dx * (np.arange(float(exposure.rows))[:, None] - 0.5 * (exposure.rows - 1))
            x = self.under(name, own, position)
            along[name] = readonly(np.broadcast_to(x, cells))
            across[name] = readonly(np.broadcast_to(self.grid.y, cells))
        return {PLACE_X.name: along, PLACE_Y.name: across}

    def spread(self, name: str, field: Array, position: int) -> Array:
        """Return a field of the window where it lies on a body's own surface, at a position.

        Fields of a track that is the same all along stay in the window.
        """
        exposure = self.exposures[name]
        if exposure.starts is None:
            return field
        own = np.zeros((exposure.rows, *field.shape[1:]))
        add_from(own, field, exposure.starts[position])
        return own
