"""What the solvers of two elastic half-spaces have in common."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from tribo.contact.residuals import check_bearable
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    ContactSystem,
    CycleCompliance,
    WearCompliance,
)
from tribo.core.units import Quantity


class ElasticSolver(ContactSolver):
    """Contact of two elastic half-spaces, coated or not, yielding at the hardness."""

    tolerance: Annotated[float, Quantity("1", above=1e-14, below=1e-2)] = 1e-8
    """Largest residual of the contact conditions, relative to load and displacement."""

    max_iterations: int = Field(default=500, gt=0)
    """Iterations after which a solve is given up."""

    accepts_wear_compliance: ClassVar[bool] = True
    honours_cap: ClassVar[bool] = True
    takes_cap_map: ClassVar[bool] = True
    takes_coatings: ClassVar[bool] = True
    couples: ClassVar[bool] = True

    def check(self, system: ContactSystem) -> None:
        """Raise `CaseError` if the window cannot bear the load at the pressure cap."""
        area = system.grid.size[0] * system.grid.size[1]
        check_bearable(system.load, area, np.inf if system.cap is None else system.cap)

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve one contact problem; see `ContactSolver.solve`."""
        guess = self._guess(problem) if start is None else start.pressure
        system = problem.system
        cap = system.cap if problem.cap is None else problem.cap
        return self._solve(system, problem.gap, problem.load, problem.wear, cap, guess)[0]

    def solve_cycle(
        self,
        problems: Sequence[ContactProblem],
        starts: Sequence[ContactSolution],
        coupling: CycleCompliance | None = None,
    ) -> list[ContactSolution]:
        """Solve all positions of a cycle as one problem; see `ContactSolver.solve_cycle`."""
        if len(problems) == 1 or any(problem.wear is not None for problem in problems):
            return super().solve_cycle(problems, starts)
        gaps = np.stack([problem.gap for problem in problems])
        loads = np.array([problem.load for problem in problems])
        guess = np.stack([start.pressure for start in starts])
        caps = [problem.cap for problem in problems if problem.cap is not None]
        cap = np.stack(caps) if caps else problems[0].system.cap
        return self._solve(problems[0].system, gaps, loads, coupling, cap, guess)

    def _guess(self, problem: ContactProblem) -> Array | None:
        """Return a pressure to start from where none is known, in Pa."""
        return None

    @abstractmethod
    def _solve(
        self,
        system: ContactSystem,
        gap: Array,
        load: Array | float,
        wear: WearCompliance | CycleCompliance | None,
        cap: Array | float | None,
        guess: Array | None,
    ) -> list[ContactSolution]:
        """Solve one position, or several whose gaps, loads and starts are stacked."""
