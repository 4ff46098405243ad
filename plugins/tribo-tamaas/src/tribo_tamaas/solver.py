"""The `tamaas.half_space` contact solver."""

from __future__ import annotations

from functools import lru_cache
from importlib.util import find_spec
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field
from tribo import (
    Array,
    CaseError,
    ContactProblem,
    ContactSolution,
    ContactSolver,
    ContactSystem,
    HalfSpace,
    Mask,
    NumericalError,
    Quantity,
    nyquist_compliance,
    residuals,
)
from tribo.kernel_api import check_bearable, check_finite

from tribo_tamaas.drive import pressure

# tamaas's error is not quite tribo's residual; where it stops too soon, it continues.
_ATTEMPTS = 4
# Of the tolerance, at each further attempt: a thousandth at the last.
_SHARPER = 0.1


class Tamaas(ContactSolver):
    """Contact of two half-spaces in free space, each cell under uniform pressure.

    tamaas finds the pressure; tribo's operator judges it. It runs on the whole
    window, in units in which E* is 1. It takes no wear compliance, so only
    explicit stepping is open to it.

    References
    ----------
    L. Frérot, G. Anciaux, V. Rey, S. Pham-Ba, J.-F. Molinari, "Tamaas: a
    library for elastic-plastic contact of periodic rough surfaces", J. Open
    Source Softw. 5 (2020) 2121.

    Examples
    --------
    >>> from tribo_tamaas import Tamaas
    >>> system = tribo.ContactSystem(tribo.Grid("0.4 mm", 64), modulus=115e9, load=10.0)
    >>> ours, theirs = tribo.DcFft(), Tamaas()
    >>> ours.smallest_compliance(system) == theirs.smallest_compliance(system)
    True
    """

    type = "tamaas.half_space"

    tolerance: Annotated[float, Quantity("1", above=1e-13, below=1e-2)] = 1e-8
    """Largest residual of the contact conditions, relative to load and approach."""

    max_iterations: Annotated[int, Field(gt=0)] = 2000
    """Iterations after which tamaas is stopped."""

    accepts_wear_compliance: ClassVar[bool] = False
    honours_cap: ClassVar[bool] = True

    def check(self, system: ContactSystem) -> None:
        """Raise `CaseError` if tamaas is missing or the window cannot bear the load."""
        if find_spec("tamaas") is None:
            raise CaseError(
                f"{self.type!r} needs tamaas, which is not installed: pip install tamaas "
                "(there are wheels for Linux on x86-64 only), or use type = 'dcfft'"
            )
        _check_bearable(system, system.load)

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve one contact problem; see `ContactSolver.solve`."""
        if problem.wear is not None:
            raise CaseError(
                f"{self.type!r} takes no wear compliance; use stepping.type = 'explicit'"
            )
        cap = problem.system.cap
        _check_bearable(problem.system, problem.load)
        check_finite(problem.gap)
        guess = None if start is None else start.pressure
        if cap is not None and guess is not None and float(np.max(guess)) >= cap:
            return self._reach(problem, cap, guess)
        # The elastic solver is several times as fast, and right where nothing yields.
        elastic = self._reach(problem, None, guess)
        if cap is None or float(np.max(elastic.pressure)) <= cap:
            return elastic
        return self._reach(problem, cap, np.minimum(elastic.pressure, cap), elastic.iterations)

    def smallest_compliance(self, system: ContactSystem) -> float:
        """Return the compliance of the chequerboard mode, in m/Pa."""
        return nyquist_compliance(system.grid.spacing) / system.modulus

    def _reach(
        self, problem: ContactProblem, cap: float | None, guess: Array | None, iterations: int = 0
    ) -> ContactSolution:
        """Ask tamaas until its answer meets the tolerance."""
        grid, modulus = problem.system.grid, problem.system.modulus
        tolerance = self.tolerance
        for _ in range(_ATTEMPTS):
            guess, used = pressure(
                problem.gap,
                grid.size,
                modulus,
                problem.load,
                cap,
                start=guess,
                tolerance=tolerance,
                max_iterations=self.max_iterations,
            )
            iterations += used
            solution = _judged(problem, guess, cap, iterations)
            if solution.residuals.worst <= self.tolerance:
                return solution
            if used >= self.max_iterations:
                break
            tolerance *= _SHARPER
        raise NumericalError(
            f"tamaas did not converge in {iterations} iterations: the residual is "
            f"{solution.residuals.worst:.1e}, the tolerance {self.tolerance:.1e}. Raise "
            "contact.max_iterations or contact.tolerance"
        )


# A case and its coarser trial have a window each.
_half_space = lru_cache(maxsize=4)(HalfSpace)


def _judged(
    problem: ContactProblem, found: Array, cap: float | None, iterations: int
) -> ContactSolution:
    grid = problem.system.grid
    limit = np.inf if cap is None else cap
    displacement = _half_space(grid.cells, grid.spacing, problem.system.modulus).apply(found)
    gap = problem.gap + displacement
    full = found >= limit
    approach = _approach(gap, found <= 0, full)
    total = problem.load / grid.cell_area
    return ContactSolution(
        pressure=found,
        approach=approach,
        overlap=np.where(full, np.maximum(approach - gap, 0.0), 0.0),
        iterations=iterations,
        residuals=residuals(found, problem.gap, displacement, approach, total, limit),
    )


def _approach(gap: Array, zero: Mask, full: Mask) -> float:
    free = ~(zero | full)
    if free.any():
        return float(np.mean(gap[free]))
    highest = float(np.max(gap[full]))
    return 0.5 * (highest + float(np.min(gap[zero]))) if zero.any() else highest


def _check_bearable(system: ContactSystem, load: float) -> None:
    area = system.grid.size[0] * system.grid.size[1]
    check_bearable(load, area, np.inf if system.cap is None else system.cap)
