"""The `dcfft` contact solver: two half-spaces in free space, elastic up to the hardness."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from tribo.contact.bounded_cg import solve_bounded
from tribo.contact.love import nyquist_compliance
from tribo.contact.nested_start import coarsen, prolong
from tribo.contact.operator import HalfSpace, Operator, WornOperator
from tribo.contact.residuals import check_window
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array, Mask
from tribo.core.box import Box, around, whole
from tribo.core.contact import ContactProblem, ContactSolution, ContactSystem, WearCompliance
from tribo.core.errors import NumericalError
from tribo.core.units import Quantity

_MARGIN = 2
_COARSEST = 64
_COARSE_TOLERANCE = 1e-3


class DcFft(ContactSolver):
    """Contact of two elastic half-spaces, yielding where the pressure reaches the hardness.

    Each cell is under uniform pressure (Love 1929); the convolution is exact
    in free space (DC-FFT: Liu, Wang & Liu 2000, Wear 243, 101-111). With a
    hardness 0 <= p <= H, and what still overlaps at p = H is permanent
    (Almqvist et al. 2007): no volume is conserved, and real onset of yield,
    beneath the surface, comes at a lower load.

    The solve runs on a box around the contact. In free space that is exact
    as long as no cell outside the box overlaps, which is checked.
    """

    type = "dcfft"

    tolerance: Annotated[float, Quantity("1", above=1e-14, below=1e-2)] = 1e-8
    """Largest residual of the contact conditions, relative to load and approach."""

    max_iterations: int = Field(default=500, gt=0)
    """Iterations after which a solve is given up."""

    accepts_wear_compliance: ClassVar[bool] = True
    honours_cap: ClassVar[bool] = True
    mirrors: ClassVar[bool] = True

    def check(self, system: ContactSystem) -> None:
        """Raise `CaseError` if the window cannot bear the load at the pressure cap."""
        check_window(system.grid, system.load, system.cap)

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve one contact problem; see `ContactSolver.solve`.

        Without `start`, grids of half the cells are solved first.
        """
        guess = None if start is None else start.pressure
        return self._solve(problem, guess, self.tolerance)

    def smallest_compliance(self, system: ContactSystem) -> float:
        """Return the compliance of the chequerboard mode, in m/Pa."""
        return nyquist_compliance(system.grid.spacing) / system.modulus

    def _solve(
        self, problem: ContactProblem, guess: Array | None, tolerance: float
    ) -> ContactSolution:
        if guess is None:
            guess = self._nested_guess(problem)
        cap = problem.system.cap
        window = problem.system.grid.cells
        box = whole(window)
        if guess is not None:
            needed = 0.0 if cap is None else problem.load / cap / problem.system.grid.cell_area
            box = _wide_enough(around(guess > 0, _MARGIN), needed)
        iterations = 0
        while True:
            solution = solve_bounded(
                _half_space(box.shape, problem.system.grid.spacing, problem.system.modulus),
                problem.gap[box.slices],
                problem.load,
                cap,
                _wear_on(box, problem.wear),
                start=None if guess is None else guess[box.slices],
                tolerance=tolerance,
                max_iterations=self.max_iterations,
            )
            iterations += solution.iterations
            if not box.is_window:
                solution = replace(
                    solution,
                    pressure=box.embed(solution.pressure),
                    overlap=box.embed(solution.overlap),
                )
            missed = _overlapping_outside(problem, box, solution)
            if not missed.any():
                return replace(solution, iterations=iterations)
            guess = solution.pressure
            box = _grown(box, around(missed | (guess > 0), _MARGIN))

    def _nested_guess(self, problem: ContactProblem) -> Array | None:
        cells = problem.system.grid.cells
        if min(cells) < _COARSEST:
            return None
        try:
            coarse = self._solve(coarsen(problem), None, max(_COARSE_TOLERANCE, self.tolerance))
        except NumericalError:
            # Without a start the solve takes longer, but may succeed.
            return None
        return prolong(coarse.pressure, cells)


@lru_cache(maxsize=16)
def _half_space(shape: tuple[int, int], spacing: tuple[float, float], modulus: float) -> HalfSpace:
    return HalfSpace(shape, spacing, modulus)


def _wear_on(box: Box, wear: WearCompliance | None) -> WearCompliance | None:
    if wear is None:
        return None
    return WearCompliance(local=wear.local[box.slices], swept=wear.swept[box.slices[1]])


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


def _overlapping_outside(problem: ContactProblem, box: Box, solution: ContactSolution) -> Mask:
    """Find cells outside `box` at which the bodies overlap, shape of the window."""
    approach = solution.approach
    # All displacements are positive: an undeformed gap above the approach stays open.
    doubtful: Mask = problem.gap < approach
    doubtful[box.slices] = False
    if box.is_window or not doubtful.any():
        return doubtful
    near = _grown(box, around(doubtful, 0))
    suspects, gap = doubtful[near.slices], problem.gap[near.slices]
    pressure = solution.pressure[near.slices]
    grid = problem.system.grid
    operator: Operator = _half_space(near.shape, grid.spacing, problem.system.modulus)
    bound = _displacement_bound(pressure, grid.spacing, problem.load / problem.system.modulus)
    if (gap + bound < approach)[suspects].any():
        wear = _wear_on(near, problem.wear)
        if wear is not None:
            operator = WornOperator(operator, wear)
        suspects &= gap + operator.apply(pressure) < approach
    else:
        suspects[:] = False
    return doubtful


def _displacement_bound(pressure: Array, spacing: tuple[float, float], strength: float) -> Array:
    """Return a lower bound of the displacement, of which `strength` is load over modulus."""
    # As if all of the load stood at the farthest corner of the contact's bounding box. A load
    # spread over a cell displaces more than a point force at the root mean square of its
    # distances, since 1/√ is convex.
    touching = pressure > 0
    reach = []
    for axis in (0, 1):
        line = np.arange(pressure.shape[axis]) * spacing[axis]
        loaded = line[touching.any(axis=1 - axis)]
        reach.append(np.maximum(np.abs(line - loaded[0]), np.abs(line - loaded[-1])))
    distance = np.hypot(np.hypot(reach[0][:, None], reach[1]), np.hypot(*spacing) / np.sqrt(12))
    bound: Array = strength / (np.pi * distance)
    return bound
