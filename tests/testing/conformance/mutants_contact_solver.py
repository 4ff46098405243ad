"""Wrong contact solvers."""

from dataclasses import replace

import numpy as np
from testing.conformance.caught import caught_by
from testing.conformance.honest import Solver

from tribo.plugin import Residuals


@caught_by("solutions_are_finite_arrays")
class FlatPressure(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        return replace(solution, pressure=solution.pressure.ravel())


@caught_by("solutions_own_their_arrays")
class ReturnsTheStart(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        return solution if start is None else replace(solution, overlap=start.overlap)


@caught_by("pressure_carries_the_load")
class ForgetsCellArea(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        dx, dy = problem.system.grid.spacing
        return replace(solution, pressure=solution.pressure * dx / dy)


@caught_by("contact_never_pulls")
class Sticks(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        p = solution.pressure.copy()
        p[p == 0] = -1.0
        return replace(solution, pressure=p)


@caught_by("residuals_are_small")
class StopsEarly(Solver):
    def solve(self, problem, start=None):
        return replace(super().solve(problem, start), residuals=Residuals(0.0, 0.01, 0.0))


@caught_by("mirrored_gap_mirrors_the_pressure")
class OffByOneCell(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        return replace(solution, pressure=np.roll(solution.pressure, 1, axis=0))


@caught_by("moved_gap_moves_the_pressure")
class SofterAtTheEdge(Solver):
    def solve(self, problem, start=None):
        x, y = problem.system.grid.mesh
        edge = 2e-6 * (x / 0.36e-3) ** 2 * np.ones_like(y)
        return super().solve(replace(problem, gap=problem.gap + edge), start)


@caught_by("approach_counts_from_the_gaps_zero")
class ShiftsTheGap(Solver):
    def solve(self, problem, start=None):
        lowest = np.min(problem.gap)
        return super().solve(replace(problem, gap=problem.gap - lowest), start)


@caught_by("scaled_contact_scales_the_pressure")
class FixedModulus(Solver):
    def solve(self, problem, start=None):
        system = replace(problem.system, modulus=1.1e11)
        return super().solve(replace(problem, system=system), start)


@caught_by("more_load_goes_deeper")
class IgnoresTheLoad(Solver):
    def solve(self, problem, start=None):
        return super().solve(replace(problem, load=problem.system.load), start)


@caught_by("warm_start_changes_nothing")
class TrustsTheStart(Solver):
    def solve(self, problem, start=None):
        return super().solve(problem) if start is None else replace(start)


@caught_by("wear_compliance_adds_its_depth")
class IgnoresWear(Solver):
    def solve(self, problem, start=None):
        return super().solve(replace(problem, wear=None), start)


@caught_by("wear_compliance_adds_its_depth")
class ForgetsTheSweptBody(Solver):
    def solve(self, problem, start=None):
        if problem.wear is None:
            return super().solve(problem, start)
        wear = replace(problem.wear, swept=np.zeros_like(problem.wear.swept))
        return super().solve(replace(problem, wear=wear), start)


@caught_by("pressure_stays_below_the_cap")
class CutsOff(Solver):
    def solve(self, problem, start=None):
        system = replace(problem.system, cap=None)
        solution = super().solve(replace(problem, system=system), start)
        cap = problem.system.cap or np.inf
        return replace(solution, pressure=np.minimum(solution.pressure, cap))


@caught_by("cap_out_of_reach_does_nothing")
class YieldsTooEarly(Solver):
    def solve(self, problem, start=None):
        if problem.system.cap is None:
            return super().solve(problem, start)
        system = replace(problem.system, cap=0.4 * problem.system.cap)
        return super().solve(replace(problem, system=system), start)


@caught_by("no_mode_is_stiffer_than_stated")
class LongestWave(Solver):
    def smallest_compliance(self, system):
        return 2 * super().smallest_compliance(system)
