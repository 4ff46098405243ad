"""The iteration of a contact solve in compiled passes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from tribo import ContactSolution, HalfSpace, Operator, Residuals
from tribo.kernel_api import NEAR_ENOUGH, Iterate, PeriodicHalfSpace, WornOperator

from tribo_fast import passes, threads
from tribo_fast.operator import CompiledOperator as CompiledOperator
from tribo_fast.operator import Convolution, transposed
from tribo_fast.operator import Threads as Threads

Array = NDArray[np.float64]


def serves(operator: Operator) -> bool:
    """Whether the compiled iteration knows an operator."""
    base = operator.base if isinstance(operator, WornOperator) else operator
    # Not a subclass, which may respond otherwise.
    return type(base) in (HalfSpace, PeriodicHalfSpace)


class CompiledIterate(Iterate):
    """An iterate whose fields have the positions on their first axis, one or several."""

    def __init__(
        self,
        operator: Operator,
        gap: Array,
        total: Array,
        limit: Array | float,
        start: Array | None,
        shares: Array | None,
    ) -> None:
        stacked = (-1, *operator.shape)
        # Compiled code checks no bounds, and takes one type and order only.
        whole = np.broadcast_to(gap, (*gap.shape[:-2], *operator.shape))
        gap = np.array(whole, dtype=float, order="C").reshape(stacked)
        self._threads = Threads(threads(), len(gap))
        self._compiled = CompiledOperator(operator, self._threads)
        super().__init__(
            self._compiled,
            gap,
            np.array(total).reshape(-1),
            limit
            if isinstance(limit, float)
            else np.array(limit, dtype=float, order="C").reshape(stacked),
            None if start is None else start.reshape(stacked),
            shares,
        )
        self._most = (
            np.full((1, 1, gap.shape[2]), limit) if isinstance(limit, float) else self.limit
        )
        shape = self._compiled.shape
        inverse = transposed(1.0 / self.preconditioner.symbol, shape)
        self._inverse = Convolution(inverse, shape, self._compiled.modes)
        self._sums = passes.empty_sums(len(gap))
        self._judge()

    def _sum(self, column: int) -> float:
        return float((self.shares * self._sums[:, column]).sum())

    def _judge(self) -> None:
        place = (self.pressure, self.displacement, self.gap, self.deformed, self._most)
        self._threads(passes.judge, *place, self.total, self._sums)

    def judge(self) -> list[Residuals]:
        """Return the residuals of the iterate, as it was judged when it was reached."""
        self.approach = self._sums[:, passes.APPROACH].copy()
        if np.isinf(self.approach).any():
            return super().judge()
        columns = [passes.FORCE, passes.OPENING, passes.PENETRATION]
        # Never −0.
        return [Residuals(*errors) for errors in (self._sums[:, columns] + 0.0).tolist()]

    def conjugate_step(self) -> bool:
        """Move along a conjugate direction on the face; see `Iterate.conjugate_step`."""
        sums = self._sums
        self._precondition()
        decrease = self._sum(passes.STEEPNESS)
        beta = max(0.0, (decrease - self._sum(passes.OVERLAP)) / self.decrease)
        self.decrease = np.inf
        self._advance(beta)
        if self._sum(passes.ALONG) >= 0:
            self._precondition()
            self._advance(0.0)
        slope, curvature = self._sum(passes.SLOPE), self._sum(passes.CURVATURE)
        if slope >= 0 or curvature <= 0:
            return False
        self.residual, self.gradient, self.decrease = self.gradient, self.residual, decrease
        part = -slope / curvature
        self.length *= min(max(part, 0.5), 2.0)
        onto = part >= NEAR_ENOUGH and sums[:, passes.MEETS_BOUND].any()
        if onto or passes.leaves(self.pressure, self.change, self._most, part):
            part = 1.0
        place = (self.pressure, self.displacement, self.gap, self.deformed, self._most)
        step = (self.change, self.moved, self.ahead)
        self._threads(passes.arrive, *place, *step, self.total, sums, part)
        return True

    def _precondition(self) -> None:
        """Write the preconditioned residual, which lies in `change` until there is a step."""
        by = self._inverse
        place = (self.pressure, self.deformed, self._most, self.residual)
        rest = (self._sums, by.spectrum)
        self._threads(passes.precondition, *place, self.change, *rest, memory=by.memory)
        if self.preconditioner.wears:
            self.change -= self.preconditioner.taken(self.residual)
        fields = (self.gradient, self.direction, self.change, self._sums)
        self._threads(passes.steepen, *place, *fields)

    def _advance(self, beta: float) -> None:
        """Write the step of a direction, and the response to it, which lies in `moved`."""
        by = self._compiled.elastic
        place = (self.pressure, self.deformed, self._most)
        fields = (self.residual, self.direction, self.change, self.ahead, self.moved)
        self._threads(
            passes.advance,
            *place,
            *fields,
            self.total,
            self._sums,
            beta,
            self.length,
            by.spectrum,
            memory=by.memory,
        )
        self._compiled.add_wear(self.change, self.moved, self._sums)

    def spectral_step(self) -> None:
        """Move along the gradient; see `Iterate.spectral_step`."""
        super().spectral_step()
        self._judge()

    def solutions(self, iterations: int, reached: list[Residuals]) -> list[ContactSolution]:
        """Return the solution at each position."""
        self.full = self.pressure >= self.limit
        return super().solutions(iterations, reached)
