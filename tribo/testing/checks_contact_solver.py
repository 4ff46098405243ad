"""What every contact solver must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution, CycleCompliance, WearCompliance
from tribo.core.grid import Grid
from tribo.guards.parts import GuardedSolver
from tribo.stepping.explicit import Explicit
from tribo.testing import samples
from tribo.testing.checks import Checks
from tribo.testing.compare import apply_if, expect_close, locked, require
from tribo.testing.samples import GRID, LOAD, ball, problem

_SHORT = 0.1
"""Sliding distance of a run, in m: the samples' law wears 20 nm at their largest pressure."""
_TOUCH = 1e-6
"""Part of the load under which bodies just touch."""
TOLERANCE = 1e-4
"""A tenth of what the step control allows as error of the wear depth."""

FINER = 0.1
"""What cells half as large may change; 0.02 is usual with ten cells across the contact."""


class ContactSolverChecks(Checks):
    """Checks of a contact solver."""

    _exactness = TOLERANCE

    def _inputs(self, component: Any, number: int) -> dict[str, Any]:
        asked = problem(names=self._bodies, solver=self._config)
        asked = replace(asked, load=LOAD * (1 + number))
        return {"problem": asked, "start": None if number else self._solve(load=0.9 * LOAD)}

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        solution = component.solve(inputs["problem"], inputs["start"])
        return {name: getattr(solution, name) for name in ("pressure", "approach", "overlap")}

    def _solve(
        self,
        start: ContactSolution | None = None,
        *,
        hardness: float | None = None,
        grid: Grid = GRID,
        **other: Any,
    ) -> ContactSolution:
        """Return the solution of a sample problem by a new, guarded solver, checked first."""
        solver, asked = GuardedSolver(self._make()), problem(hardness, grid, solver=self._config)
        solver.component.check(asked.system)
        return locked(solver.solve(locked(replace(asked, **other)), start))

    @cached_property
    def _plain(self) -> ContactSolution:
        return self._solve()

    @cached_property
    def _peak(self) -> float:
        return float(np.max(self._plain.pressure))

    @cached_property
    def _soft(self) -> float:
        """A compliance that moves the surface as far as the contact does, in m/Pa."""
        return 0.5 * abs(self._plain.approach) / self._peak

    def _expect_pressure(self, what: str, needed: Array, **other: Any) -> None:
        pressure = self._solve(**other).pressure
        expect_close(f"pressure {what}", pressure, needed, TOLERANCE)

    def _expect_as_in_gap(self, what: str, found: ContactSolution, depth: Array) -> None:
        """Fail unless a solution has the pressure and approach of one with a depth in its gap."""
        again = self._solve(gap=ball(GRID) + depth)
        for name in ("pressure", "approach"):
            where = f"{name} {what}, and that with the depth in the gap"
            expect_close(where, getattr(found, name), getattr(again, name), 10 * TOLERANCE)

    def answers_fit_a_run(self) -> None:
        """Pressures are finite, not negative, carry the load, and leave small residuals."""
        for load in (0.5 * LOAD, LOAD):
            for name, value in vars(self._solve(load=load).residuals).items():
                small = 0 <= value <= TOLERANCE
                limit = f"up to {TOLERANCE:g} is allowed"
                require(small, f"the {name} residual is {value:.3g}; {limit}")
        GuardedSolver(self._make()).smallest_compliance(problem(solver=self._config).system)

    def pressure_goes_with_the_gap(self) -> None:
        """A gap that is mirrored or moved has such a pressure, and one lifted such an approach."""
        gap, usual = ball(GRID), self._plain.pressure
        for axis, name in enumerate("xy"):
            mirrored = np.flip(usual, axis)
            self._expect_pressure(f"mirrored along {name}", mirrored, gap=np.flip(gap, axis))
        moved = self._solve(gap=ball(GRID, cells=(2, -3))).pressure
        expect_close(
            "pressure moved by (2, -3) cells", moved[4:, :-6], usual[2:-2, 3:-3], TOLERANCE
        )
        lift = 3e-6
        lifted = self._solve(gap=gap + lift)
        expect_close("pressure on a lifted gap", lifted.pressure, usual, TOLERANCE)
        rise = lifted.approach - self._plain.approach
        expect_close("approach by what is added to the gap", rise, lift, TOLERANCE)

    def finer_cells_change_little(self) -> None:
        """On cells half as long and wide the same contact has its peak pressure and approach."""
        grid = samples.finer(GRID)
        found = self._solve(grid=grid)
        peak = float(np.max(found.pressure))
        expect_close("peak pressure on cells half as large", peak, self._peak, FINER)
        approach = self._plain.approach
        expect_close("approach on cells half as large", found.approach, approach, FINER)

    def more_load_goes_deeper(self) -> None:
        """The approach grows with the load, from the lowest gap at a first touch."""
        touch, lowest = self._solve(load=_TOUCH * LOAD).approach, float(np.min(ball(GRID)))
        require(
            abs(touch - lowest) <= 10 * TOLERANCE * (self._plain.approach - lowest),
            f"the approach of a first touch, by {_TOUCH:g} of the load, is {touch:.6g} m, but the "
            f"lowest gap {lowest:.6g} m",
        )

    def warm_start_changes_nothing(self) -> None:
        """From whatever solution it starts, a solve ends at the same one."""
        for what, start in (
            ("the solution of a heavier load", self._solve(load=2 * LOAD)),
            ("the solution at another place", self._solve(gap=ball(GRID, (3, 2)), load=0.3 * LOAD)),
        ):
            self._expect_pressure(f"from {what}", self._plain.pressure, start=start)

    def wear_compliance_adds_its_depth(self) -> None:
        """A wear compliance acts as its depth in the gap would, on both kinds of body."""
        apply_if(self._cls.accepts_wear_compliance, "accepts_wear_compliance is False")
        (nx, ny), dx = GRID.cells, GRID.spacing[0]
        local = self._soft * (0.5 + samples.pattern((nx, ny)))
        swept = self._soft / GRID.size[0] * (0.5 + samples.pattern((ny,)))
        wear = WearCompliance(local, swept)
        worn = self._solve(wear=wear)
        self._expect_as_in_gap("under a wear compliance", worn, wear.depth(worn.pressure, dx))

    def positions_share_their_wear(self) -> None:
        """Solved as one, each position of a cycle is in contact with what all of them wear."""
        solver = self._make()
        apply_if(solver.couples, "couples is False")
        (nx, ny), cells = GRID.cells, [(4, 0), (2, 1), (0, 0)]
        stays, passes = (self._soft * (0.5 + samples.pattern((n, ny))) for n in (nx, nx + 4))
        shares = np.array([0.2, 0.3, 0.5])
        coupling = CycleCompliance(shares, [(stays, [(0, 0)] * 3), (passes, cells)], slice(0, nx))
        gaps = [ball(GRID, cells=(row, 0)) for row in (0, 1, 2)]
        problems = [replace(problem(solver=self._config), gap=gap) for gap in gaps]
        contacts = GuardedSolver(solver).solve_cycle(problems, [self._plain] * 3, coupling)
        worn = coupling.depth(np.stack([each.pressure for each in contacts]), GRID.spacing[0])
        for position, (gap, contact) in enumerate(zip(gaps, contacts, strict=True)):
            depth = gap + worn[position] - ball(GRID)
            self._expect_as_in_gap(f"at position {position} of three", contact, depth)

    def cap_acts_where_it_is_reached(self) -> None:
        """Overlap is where the pressure is at the cap; one out of reach changes nothing."""
        apply_if(self._make().honours_cap, "honours_cap is False")
        for cap in (0.6 * self._peak, 2 * self._peak):
            solution = self._solve(hardness=cap)
            below = solution.pressure < cap * (1 - TOLERANCE)
            idle = np.any(solution.overlap[below])
            require(not idle, "there is overlap where the cap does not act")
            acts = np.any(solution.overlap) or cap > self._peak
            require(acts, "nothing overlaps although the cap acts")
            self._expect_as_in_gap("under a cap", solution, solution.overlap)
        expect_close(
            "pressure under a high cap", solution.pressure, self._plain.pressure, TOLERANCE
        )

    def cap_of_each_point_is_kept(self) -> None:
        """A map of one cap is that cap, and each point bears no more than its own."""
        apply_if(self._make().takes_cap_map, "takes_cap_map is False")
        cap = 0.6 * self._peak
        needed, even = self._solve(hardness=cap).pressure, np.full(GRID.cells, cap)
        self._expect_pressure("under an even cap", needed, hardness=cap, cap=even)
        halves = np.where(GRID.mesh[0] < 0, 0.8 * even, even)
        highest = np.max(self._solve(hardness=cap, cap=halves).pressure)
        require(highest > 0.9 * cap, "no point bears more than the lowest cap")

    def no_mode_is_stiffer_than_stated(self) -> None:
        """The smallest compliance is no more than the contact shows to a chequerboard."""
        stated = self._make().smallest_compliance(problem(solver=self._config).system)
        apply_if(stated is not None, "smallest_compliance is None")
        plain = self._plain
        core = plain.pressure > 0.3 * self._peak
        signs = (-1.0) ** np.add.outer(*map(np.arange, GRID.cells))
        change = np.where(core, 1e-4 * abs(plain.approach) * signs, 0.0)
        other = self._solve(gap=ball(GRID) + change)
        both = (plain.pressure > 0) & (other.pressure > 0)
        response = np.where(both, other.pressure - plain.pressure, 0.0)
        # Where both touch, K (p2 - p1) is the change of the approach less the change of the gap.
        work = float(np.sum(response * (other.approach - plain.approach - change)))
        shown = work / float(np.sum(response**2))
        require(
            stated <= 1.02 * shown,
            f"smallest_compliance is {stated:.4g} m/Pa, but the contact answers a chequerboard in "
            f"the gap with {shown:.4g} m/Pa: explicit steps would be allowed too long",
        )

    def runs_a_case(self) -> None:
        """In a small case each step has a contact that carries the load."""
        motion = samples.sliding(_SHORT)
        steps = Explicit(time_step=0.1 * motion.end_time)
        stepping = samples.LONG_STEPS if self._cls.accepts_wear_compliance else steps
        parts: dict[str, Any] = {"kinematics": motion, "stepping": stepping}
        samples.run(lambda: {"contact": self._make(), **parts})
