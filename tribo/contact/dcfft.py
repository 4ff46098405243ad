"""The `dcfft` contact solver: two half-spaces in free space, elastic up to the hardness."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from tribo.contact.bounded_cg import solve_together
from tribo.contact.elastic import ElasticSolver
from tribo.contact.love import nyquist_compliance
from tribo.contact.operator import Operator, WornOperator
from tribo.contact.padded_half_space import HalfSpace
from tribo.contact.projection import CELLS, over
from tribo.contact.residuals import check_finite
from tribo.core.arrays import Array, Mask
from tribo.core.box import Box, around, whole
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    ContactSystem,
    CycleCompliance,
    WearCompliance,
)

_MARGIN = 2
# Relative error of a first approach: from the exact one solves took two iterations fewer at most.
_ROUGHLY = 0.1


class DcFft(ElasticSolver):
    """Contact of two elastic half-spaces, yielding where the pressure reaches the hardness.

    They may be coated. Each cell is under uniform pressure (Love 1929); the convolution is exact in
    free space (DC-FFT: Liu, Wang & Liu 2000, Wear 243, 101-111). With a hardness 0 <= p <= H, and
    what still overlaps at p = H is permanent (Almqvist et al. 2007): no volume is conserved, and
    real onset of yield, beneath the surface, comes at a lower load.

    The solve runs on a box around the contact. In free space that is exact
    as long as no cell outside the box overlaps, which is checked.

    Examples
    --------
    >>> grid = tribo.Grid("0.4 mm", 64)
    >>> system = tribo.ContactSystem(grid, modulus=115e9, load=10.0)
    >>> gap = -tribo.Sphere(radius="5 mm").height(grid)
    >>> contact = tribo.DcFft().solve(tribo.ContactProblem(system, gap, load=10.0))
    >>> round(float(contact.pressure.max()) / 1e9, 2)  # GPa, as Hertz's
    1.01
    """

    type = "dcfft"

    def smallest_compliance(self, system: ContactSystem) -> float:
        """Return the compliance of the chequerboard mode, or the least on coatings, in m/Pa."""
        if system.coatings:
            return float(np.min(_half_space(system.grid.cells, system).symbol()))
        return nyquist_compliance(system.grid.spacing) / system.modulus

    def operator(self, system: ContactSystem, touching: Mask) -> tuple[Box, Operator]:
        """Return the half-spaces on a box around what touches; see `ContactSolver.operator`."""
        box = around(touching, _MARGIN)
        return box, _half_space(box.shape, system)

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
            box = _wide_enough(around(_anywhere(guess > 0), _MARGIN), needed)
        iterations = 0
        while True:
            here = (..., *box.slices)
            solutions = solve_together(
                _half_space(box.shape, system),
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
            missed = _overlapping_outside(system, gap, wear, box, guess, approach)
            if not missed.any():
                return solutions
            box = _grown(box, around(missed | _anywhere(guess > 0), _MARGIN))

    def _guess(self, problem: ContactProblem) -> Array | None:
        """Return Hertz's pressure of a ball with the same gap; None where it is even."""
        check_finite(problem.gap)
        system, gap = problem.system, problem.gap - problem.gap.min()
        low, approach = 0.0, float(gap.max())
        while approach - low > _ROUGHLY * approach:
            middle = 0.5 * (low + approach)
            area = system.grid.cell_area * np.count_nonzero(gap < middle)
            # What a ball bears that would overlap by so much over this area, undeformed.
            if 2**1.5 / 3 * system.surface_modulus * middle * np.sqrt(area / np.pi) < problem.load:
                low = middle
            else:
                approach = middle
        # It touches where the gap is less than half of the approach.
        guess: Array = np.sqrt(np.maximum(0.5 * approach - gap, 0.0))
        return guess if guess.any() else None


def _half_space(shape: tuple[int, int], system: ContactSystem) -> HalfSpace:
    coatings = tuple(system.coatings.values())
    return _cached(shape, system.grid.spacing, system.surface_modulus, coatings)


_cached = lru_cache(maxsize=32)(HalfSpace)


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


def _overlapping_outside(
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
    doubtful: Mask = gap < (2 * approach - over(gap.min(CELLS)) if system.coatings else approach)
    doubtful[(..., *box.slices)] = False
    if doubtful.any():
        near = _grown(box, around(_anywhere(doubtful), 0))
        here = (..., *near.slices)
        operator: Operator = _half_space(near.shape, system)
        if wear is not None:
            operator = WornOperator(operator, wear.on(near))
        doubtful[here] &= gap[here] + operator.apply(pressure[here]) < approach
    return _anywhere(doubtful)
