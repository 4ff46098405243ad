"""What the contact solvers by conjugate gradients with bounds have in common."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import Field

from tribo.contact.bounded_cg import solve_together
from tribo.contact.operator import Operator, WornOperator
from tribo.contact.projection import CELLS, over
from tribo.contact.residuals import check_bearable
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array, Mask
from tribo.core.box import Box, around, whole
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    ContactSystem,
    CycleCompliance,
    WearCompliance,
)
from tribo.core.units import Quantity

_MARGIN = 2
"""Cells of the first box on each side of the contact; a box that proves too small is enlarged."""


class ElasticSolver(ContactSolver):
    """Contact of elastic bodies, coated or not, yielding at the hardness.

    The solve runs on a box around the contact. In free space that is exact as long as no cell
    outside the box overlaps, which is checked.
    """

    tolerance: Annotated[float, Quantity("1", above=1e-14, below=1e-2)] = 1e-8
    """Largest residual of the contact conditions, relative to load and displacement."""

    max_iterations: int = Field(default=500, gt=0)
    """Iterations after which a solve is given up."""

    accepts_wear_compliance: ClassVar[bool] = True
    honours_cap: ClassVar[bool] = True
    takes_cap_map: ClassVar[bool] = True
    takes_coatings: ClassVar[bool] = True
    couples: ClassVar[bool] = True
    _half_space: ClassVar[Callable[..., Operator]]
    """Makes K from a box, its spacing, the modulus at the surface and the coatings."""

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

    def _operator(self, system: ContactSystem, shape: tuple[int, int]) -> Operator:
        """Return K on a box of cells."""
        coatings = tuple(system.coatings.values())
        return _kept(self._half_space, shape, system.grid.spacing, system.surface_modulus, coatings)

    def _around(self, touching: Mask) -> Box:
        """Return a box to solve on, around the cells that touch."""
        return around(touching, _MARGIN)

    def smallest_compliance(self, system: ContactSystem) -> float:
        """Return the smallest estimate of an eigenvalue on the window, in m/Pa."""
        return float(np.min(self._operator(system, system.grid.cells).symbol()))

    def operator(self, system: ContactSystem, touching: Mask) -> tuple[Box, Operator]:
        """Return K on a box around what touches; see `ContactSolver.operator`."""
        box = self._around(touching)
        return box, self._operator(system, box.shape)

    def _solve(
        self,
        system: ContactSystem,
        gap: Array,
        load: Array | float,
        wear: WearCompliance | CycleCompliance | None,
        cap: Array | float | None,
        guess: Array | None,
    ) -> list[ContactSolution]:
        """Solve one position or several on a box that grows until nothing overlaps beyond it."""
        load = np.asarray(load)
        box = whole(system.grid.cells)
        if guess is not None:
            softest = np.inf if cap is None else float(np.min(cap))
            needed = float(load.max()) / softest / system.grid.cell_area
            box = _wide_enough(self._around(_anywhere(guess > 0)), needed)
        iterations = 0
        while True:
            here = (..., *box.slices)
            solutions = solve_together(
                self._operator(system, box.shape),
                gap[here],
                load,
                cap[here] if isinstance(cap, np.ndarray) else cap,
                None if wear is None else wear.on(box),
                start=None if guess is None else guess[here],
                tolerance=self.tolerance,
                max_iterations=self.max_iterations,
            )
            iterations += solutions[0].iterations
            solutions = [
                replace(
                    each,
                    pressure=box.embed(each.pressure),
                    overlap=box.embed(each.overlap),
                    iterations=iterations,
                )
                for each in solutions
            ]
            guess = np.reshape([each.pressure for each in solutions], gap.shape)
            approach = over(np.reshape([each.approach for each in solutions], load.shape))
            missed = self._overlapping_outside(system, gap, wear, box, guess, approach)
            if not missed.any():
                return solutions
            box = _grown(box, self._around(missed | _anywhere(guess > 0)))

    def _overlapping_outside(
        self,
        system: ContactSystem,
        gap: Array,
        wear: WearCompliance | CycleCompliance | None,
        box: Box,
        pressure: Array,
        approach: Array,
    ) -> Mask:
        """Find cells of the window, outside `box`, at which the bodies overlap at any position."""
        # All displacements are positive: an undeformed gap above the approach stays open. Beside a
        # contact a soft layer may rise, but by less than it sinks below it.
        highest = 2 * approach - over(gap.min(CELLS)) if system.coatings else approach
        doubtful: Mask = gap < highest
        doubtful[(..., *box.slices)] = False
        if doubtful.any():
            near = _grown(box, around(_anywhere(doubtful), 0))
            here = (..., *near.slices)
            operator: Operator = self._operator(system, near.shape)
            if wear is not None:
                operator = WornOperator(operator, wear.on(near))
            doubtful[here] &= gap[here] + operator.apply(pressure[here]) < approach
        return _anywhere(doubtful)


# A run comes back to its boxes; the kernel of 256² cells takes 1 MiB.
@lru_cache(maxsize=32)
def _kept(half_space: Callable[..., Operator], *given: Any) -> Operator:
    return half_space(*given)


def _anywhere(cells: Mask) -> Mask:
    return np.asarray(cells.reshape(-1, *cells.shape[-2:]).any(axis=0))


def _wide_enough(box: Box, cells: float) -> Box:
    # A box that bears the load at the cap, with a quarter to spare to distribute it.
    while not box.is_window and box.shape[0] * box.shape[1] < 1.25 * cells:
        box = _grown(box, box)
    return box


def _grown(box: Box, wanted: Box) -> Box:
    lines = np.zeros(box.window, dtype=bool)
    lines[box.slices] = True
    lines[wanted.slices] = True
    larger = around(lines, 0)
    return larger if larger.shape != box.shape else around(lines, 1)
