"""What every contact solver must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    CycleCompliance,
    WearCompliance,
)
from tribo.core.grid import Grid
from tribo.guards.parts import GuardedSolver
from tribo.testing import samples
from tribo.testing.checks import Checks
from tribo.testing.compare import apply_if, expect_close, locked, require
from tribo.testing.samples import GRID, LOAD, ball, problem

TOLERANCE = 1e-4
"""A tenth of what the step control allows as error of the wear depth."""

FINER = 0.1
"""What cells half as large may change; 0.02 is usual with ten cells across the contact."""


class ContactSolverChecks(Checks):
    """Checks of a contact solver."""

    _exactness = TOLERANCE

    def _inputs(self, component: Any, number: int) -> dict[str, Any]:
        asked = problem(load=LOAD * (1 + number))
        # Copies, so that they can be written to.
        asked = replace(asked, gap=asked.gap.copy())
        return {"problem": asked, "start": None if number else self._solve(load=0.9 * LOAD)}

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        return {"solution": component.solve(inputs["problem"], inputs["start"])}

    def _solve(self, start: ContactSolution | None = None, **of_the_problem: Any) -> Any:
        """Return the solution of a sample problem by a new, guarded solver, checked first."""
        solver, asked = GuardedSolver(self._make()), problem(**of_the_problem)
        solver.component.check(asked.system)
        return solver.solve(asked, start)

    @cached_property
    def _plain(self) -> ContactSolution:
        solution: ContactSolution = locked(self._solve())
        return solution

    def answers_fit_a_run(self) -> None:
        """Pressures are finite and not negative, and carry the load."""
        for load in (0.5 * LOAD, LOAD):
            self._solve(load=load)
        GuardedSolver(self._make()).smallest_compliance(problem().system)

    def residuals_are_small(self) -> None:
        """By its own residuals a solution fulfils the conditions of contact."""
        for name in ("force", "complementarity", "penetration"):
            value = getattr(self._plain.residuals, name)
            small = 0 <= value <= TOLERANCE
            require(small, f"the {name} residual is {value:.3g}; up to {TOLERANCE:g} is allowed")

    def mirrored_gap_mirrors_the_pressure(self) -> None:
        """The mirror image of a gap, along x or y, has the mirror image of its pressure."""
        for axis, name in enumerate("xy"):
            mirrored = self._solve(gap=np.flip(ball(GRID), axis).copy()).pressure
            needed = np.flip(self._plain.pressure, axis)
            expect_close(f"pressure mirrored along {name}", mirrored, needed, TOLERANCE)

    def moved_gap_moves_the_pressure(self) -> None:
        """A gap moved by whole cells has the same pressure, moved as far."""
        moved = self._solve(gap=ball(GRID, cells=(2, -3))).pressure[4:, :-6]
        needed = self._plain.pressure[2:-2, 3:-3]
        expect_close("pressure moved by (2, -3) cells", moved, needed, TOLERANCE)

    def approach_counts_from_the_gaps_zero(self) -> None:
        """A constant added to the gap adds to the approach and leaves the pressure as it is."""
        lift = 3e-6
        lifted = self._solve(gap=ball(GRID) + lift)
        expect_close("pressure on a lifted gap", lifted.pressure, self._plain.pressure, TOLERANCE)
        rise = lifted.approach - self._plain.approach
        require(
            abs(rise - lift) <= TOLERANCE * lift,
            f"with {lift:g} m added to the gap the approach grew by {rise:.6g} m",
        )

    def bodies_may_have_any_names(self) -> None:
        """Nothing depends on what the bodies are called."""
        asked = problem()
        materials = dict(zip(("upper", "lower"), asked.system.materials.values(), strict=True))
        asked = replace(asked, system=replace(asked.system, materials=materials))
        found = self._make().solve(asked).pressure
        expect_close("pressure under other names", found, self._plain.pressure, TOLERANCE)

    def finer_cells_change_little(self) -> None:
        """On cells half as long and wide the same contact has its peak pressure and approach."""
        finer = Grid(GRID.size, (2 * GRID.cells[0], 2 * GRID.cells[1]))
        asked = problem(gap=ball(finer))
        asked = replace(asked, system=replace(asked.system, grid=finer))
        found, plain = GuardedSolver(self._make()).solve(asked), self._plain
        for what, here, there in (
            ("peak pressure", np.max(plain.pressure), np.max(found.pressure)),
            ("approach", plain.approach, found.approach),
        ):
            require(
                abs(there / here - 1) <= FINER,
                f"on cells half as large the {what} is {there / here:.3g} times as large",
            )

    def more_load_goes_deeper(self) -> None:
        """With the load grow approach, contact and the pressure in every cell."""
        less = self._solve(load=0.25 * LOAD)
        for part in (0.5, 1.0):
            more = self._solve(load=part * LOAD)
            deeper = more.approach - less.approach
            require(deeper > 0, f"the approach changes by {deeper:.6g} m as the load is doubled")
            fall = float(np.max(less.pressure - more.pressure))
            require(
                fall <= TOLERANCE * float(np.max(more.pressure)),
                f"doubling the load lowered the pressure by up to {fall:.3g} Pa",
            )
            less = more

    def warm_start_changes_nothing(self) -> None:
        """From whatever solution it starts, a solve ends at the same one."""
        elsewhere = ball(GRID, cells=(3, 2))
        for what, start in (
            ("its own solution", self._plain),
            ("that of a heavier load", self._solve(load=2 * LOAD)),
            ("that of another place", self._solve(gap=elsewhere, load=0.3 * LOAD)),
        ):
            warm = self._solve(locked(start)).pressure
            expect_close(f"pressure from {what}", warm, self._plain.pressure, TOLERANCE)

    def wear_compliance_adds_its_depth(self) -> None:
        """A wear compliance acts as its depth in the gap would, on either kind of body."""
        apply_if(self._cls.accepts_wear_compliance, "accepts_wear_compliance is False")
        soft = 0.5 * abs(self._plain.approach) / float(np.max(self._plain.pressure))
        (nx, ny), dx = GRID.cells, GRID.spacing[0]
        local = soft * (0.5 + samples.pattern((nx, ny)))
        swept = soft / GRID.size[0] * (0.5 + samples.pattern((ny,)))
        for what, wear in (
            ("a local", WearCompliance(local, np.zeros(ny))),
            ("a swept", WearCompliance(np.zeros((nx, ny)), swept)),
            ("a local and a swept", WearCompliance(local, swept)),
        ):
            worn = self._solve(wear=wear).pressure
            again = self._solve(gap=ball(GRID) + wear.depth(worn, dx)).pressure
            what = f"pressure under {what} compliance, and that with its depth in the gap"
            expect_close(what, worn, again, 10 * TOLERANCE)

    def positions_share_their_wear(self) -> None:
        """Solved as one, each position of a cycle is in contact with what all of them wear."""
        solver = self._make()
        apply_if(solver.couples, "couples is False")
        soft = 0.5 * abs(self._plain.approach) / float(np.max(self._plain.pressure))
        (nx, ny), starts = GRID.cells, [4, 2, 0]
        stays, passes = samples.pattern((nx, ny)), samples.pattern((nx + 4, ny))
        shares = np.array([0.2, 0.3, 0.5])
        bodies = [(soft * (0.5 + stays), [0, 0, 0]), (soft * (0.5 + passes), starts)]
        coupling = CycleCompliance(shares, bodies, slice(0, nx))
        gaps = [ball(GRID, cells=(row, 0)) for row in (0, 1, 2)]
        problems = [problem(gap=gap) for gap in gaps]
        guarded = GuardedSolver(solver)
        contacts = guarded.solve_cycle(problems, [self._plain] * 3, coupling)
        worn = coupling.depth(np.stack([each.pressure for each in contacts]), GRID.spacing[0])
        for position, (gap, contact) in enumerate(zip(gaps, contacts, strict=True)):
            again = self._solve(gap=gap + worn[position]).pressure
            what = f"pressure at position {position} of three, and that with its depth in the gap"
            expect_close(what, contact.pressure, again, 10 * TOLERANCE)

    def pressure_stays_below_the_cap(self) -> None:
        """The cap limits the pressure, the load is carried, and overlap is where the cap acts."""
        apply_if(self._make().honours_cap, "honours_cap is False")
        cap = 0.6 * float(np.max(self._plain.pressure))
        solution = self._solve(cap=cap)
        require(np.max(solution.overlap) > 0, "nothing overlaps although the cap acts")
        below = solution.pressure < cap * (1 - TOLERANCE)
        idle = np.any(solution.overlap[below])
        require(not idle, "there is overlap where the cap does not act")

    def cap_out_of_reach_does_nothing(self) -> None:
        """A cap above the elastic pressure changes nothing, and nothing overlaps."""
        apply_if(self._make().honours_cap, "honours_cap is False")
        needed = self._plain.pressure
        solution = self._solve(cap=2 * float(np.max(needed)))
        expect_close("pressure under a high cap", solution.pressure, needed, TOLERANCE)
        overlaps = np.any(solution.overlap)
        require(not overlaps, "there is overlap although the cap is not reached")

    def cap_of_each_point_is_kept(self) -> None:
        """A map of one cap is that cap, and each point bears no more than its own."""
        apply_if(self._make().takes_cap_map, "takes_cap_map is False")
        cap = 0.6 * float(np.max(self._plain.pressure))
        needed, even = self._solve(cap=cap), self._solve(cap=cap, caps=np.full(GRID.cells, cap))
        expect_close("pressure under an even cap", even.pressure, needed.pressure, TOLERANCE)
        left = GRID.mesh[0] + np.zeros(GRID.cells) < 0
        halves = self._solve(cap=cap, caps=np.where(left, 0.8 * cap, cap))
        require(np.max(halves.pressure) > 0.9 * cap, "no point bears more than the lowest cap")

    def no_mode_is_stiffer_than_stated(self) -> None:
        """The smallest compliance is no more than the contact shows to a chequerboard."""
        asked: ContactProblem = problem()
        stated = self._make().smallest_compliance(asked.system)
        apply_if(stated is not None, "smallest_compliance is None")
        plain = self._plain
        core = plain.pressure > 0.3 * np.max(plain.pressure)
        signs = (-1.0) ** np.add.outer(*map(np.arange, GRID.cells))
        change = np.where(core, 1e-4 * abs(plain.approach) * signs, 0.0)
        other = self._solve(gap=asked.gap + change)
        both = (plain.pressure > 0) & (other.pressure > 0)
        response = np.where(both, other.pressure - plain.pressure, 0.0)
        # Where both touch, K (p2 - p1) is the change of the approach less that of the gap.
        work = float(np.sum(response * (other.approach - plain.approach - change)))
        shown = work / float(np.sum(response**2))
        require(
            stated <= 1.02 * shown,
            f"smallest_compliance is {stated:.4g} m/Pa, but the contact answers a chequerboard in "
            f"the gap with {shown:.4g} m/Pa: explicit steps would be allowed too long",
        )
