"""Solver for a foundation of independent springs, with the wear of a step and a pressure cap."""

from __future__ import annotations

import numpy as np

from tribo.contact.projection import balance
from tribo.contact.residuals import check_bearable, check_finite, residuals
from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution
from tribo.core.errors import NumericalError

_ROUND_OFF = 4 * float(np.finfo(np.float64).eps)
_MOST_PASSES = 200


def solve_foundation(
    problem: ContactProblem, modulus: float, cap: float | None, guess: float | None = None
) -> ContactSolution:
    """Solve contact on a foundation whose pressure is `modulus` times the depth.

    With C = 1/K_w + local the pressure is clip((δ − gap − swept P)/C, 0, cap), where
    P(y) is the line load of its row. P at a given δ, and δ at a given load, are
    roots of increasing piecewise linear functions; Newton's method within a
    bracket finds them in finitely many passes.

    Exact to round-off. `modulus` is K_w, in Pa/m, `cap` the largest pressure, in Pa, and `guess` an
    approach to start from, in m. Errors are those of `tribo.contact.bounded_cg.solve_together`.
    """
    gap, grid = problem.gap, problem.system.grid
    limit = np.inf if cap is None else cap
    total = problem.load / grid.cell_area
    check_bearable(problem.load, grid.cell_area * gap.size, limit)
    check_finite(gap)

    springs = _Springs(problem, modulus, limit)
    low = float(np.min(gap))
    # Where the lowest cell alone would carry the load, or all cells reach the limit.
    alone, full = low + total * springs.softest, float(np.max(gap)) + limit * springs.softest
    bound = alone if total < limit else full
    # Somewhat beyond, for Newton's method may land on the bound itself.
    high = low + 1.01 * (bound - low)
    approach = guess if guess is not None and low < guess < high else 0.5 * (low + high)
    for passes in range(1, _MOST_PASSES + 1):
        line_loads, slopes = springs.line_loads(approach)
        excess = float(np.sum(line_loads)) * grid.spacing[1] / problem.load - 1.0
        if abs(excess) <= _ROUND_OFF:
            return springs.solution(approach, line_loads, total, passes)
        if excess > 0:
            high = approach
        else:
            low = approach
        slope = float(np.sum(slopes)) * grid.spacing[1] / problem.load
        following = approach - excess / slope if slope > 0 else np.inf
        # The approach itself has a last bit; `balance` spreads what is left over.
        if abs(following - approach) <= 2 * np.spacing(abs(approach)):
            return springs.solution(approach, line_loads, total, passes)
        if not low < following < high:
            following = 0.5 * (low + high)
        approach = following
    raise NumericalError(
        f"the load of the foundation is still off by {excess:.1e} after {_MOST_PASSES} passes; "
        "check the gap and the wear of the step for extreme values"
    )


class _Springs:
    """A row of springs per y, coupled along x by the swept wear."""

    def __init__(self, problem: ContactProblem, modulus: float, limit: float) -> None:
        gap = problem.gap
        self.gap = gap
        self.limit = limit
        self.dx = problem.system.grid.spacing[0]
        self.softness = np.full(gap.shape, 1.0 / modulus)
        self.swept = np.zeros(gap.shape[1])
        if problem.wear is not None:
            self.softness += problem.wear.local
            self.swept = problem.wear.swept
        self.softest = float(np.max(self.softness)) + self.dx * gap.shape[0] * float(
            np.max(self.swept)
        )

    def pressure(self, approach: float, line_loads: Array) -> Array:
        depth = approach - self.gap - self.swept * line_loads
        return np.asarray(np.clip(depth / self.softness, 0.0, self.limit))

    def line_loads(self, approach: float) -> tuple[Array, Array]:
        """Return the line load per row, in N/m, and its derivative by the approach."""
        loads = np.zeros(self.gap.shape[1])
        low, high = loads, self.dx * np.sum(self.pressure(approach, loads), axis=0)
        loads = high
        for _ in range(_MOST_PASSES):
            pressure = self.pressure(approach, loads)
            stiffness = np.where((pressure > 0) & (pressure < self.limit), 1 / self.softness, 0.0)
            width = self.dx * np.sum(stiffness, axis=0)
            excess = loads - self.dx * np.sum(pressure, axis=0)
            settled = np.abs(excess) <= _ROUND_OFF * high
            low, high = np.where(excess < 0, loads, low), np.where(excess > 0, loads, high)
            following = loads - excess / (1.0 + self.swept * width)
            inside = (low < following) & (following < high)
            following = np.where(inside, following, 0.5 * (low + high))
            following = np.where(settled, loads, following)
            if np.array_equal(following, loads):
                break
            loads = following
        return loads, width / (1.0 + self.swept * width)

    def solution(
        self, approach: float, line_loads: Array, total: float, passes: int
    ) -> ContactSolution:
        p = balance(self.pressure(approach, line_loads), np.asarray(total), self.limit)
        displacement = self.softness * p + self.swept * self.dx * np.sum(p, axis=0)
        deepest = np.maximum(approach - self.gap - displacement, 0.0)
        return ContactSolution(
            pressure=p,
            approach=approach,
            overlap=np.where(p >= self.limit, deepest, 0.0),
            iterations=passes,
            residuals=residuals(p, self.gap, displacement, approach, total, self.limit),
        )
