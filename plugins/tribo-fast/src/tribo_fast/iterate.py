"""The iteration of a contact solve in compiled passes."""

from __future__ import annotations

from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray
from tribo import ContactSolution, HalfSpace, Operator, Residuals
from tribo.kernel_api import NEAR_ENOUGH, Iterate, PeriodicHalfSpace, WornOperator

from tribo_fast import passes, threads
from tribo_fast.operator import CompiledOperator, Convolution, Threads, transposed

Array = NDArray[np.float64]
EXACT = 1e-12
"""Relative difference from NumPy that compiled code may have: the bound of the tests of solves."""
_spare: WeakKeyDictionary[Operator, tuple[Any, ...]] = WeakKeyDictionary()
"""Memory of the last solve, for the next one: new memory costs as much as two iterations."""


def serves(operator: Operator) -> bool:
    """Whether the compiled iteration knows an operator."""
    base = operator.base if isinstance(operator, WornOperator) else operator
    # Not a subclass, which may respond otherwise.
    return type(base) in (HalfSpace, PeriodicHalfSpace)


def tried() -> float:
    """Return the error of compiled code beside NumPy; raise ArithmeticError if it is large."""
    steel = HalfSpace(shape=(24, 20), spacing=(1e-5, 1e-5), modulus=115e9)
    pressure = np.random.default_rng(0).random((2, 24, 20))
    known = steel.apply(pressure)
    answer = CompiledOperator(steel, Threads(1, 2)).apply(pressure)
    error = float(np.max(np.abs(answer - known)) / np.max(known))
    if not error < EXACT:
        raise ArithmeticError(f"its answer is off by {error:.0e}")
    return error


def _memory(positions: int, nx: int, ny: int) -> tuple[Any, ...]:
    lists = (2, positions, nx * ny)
    cells, fields = np.empty(lists, dtype=np.uint32), np.zeros((*lists[:2], passes.FIELDS, nx * ny))
    return (*np.empty((3, positions, nx, ny)), cells, fields)


def _stacked(values: Array, shape: tuple[int, ...]) -> Array:
    """Return values as compiled code takes them, which checks no bounds: (positions, nx, ny)."""
    if values.shape != shape:
        raise ValueError(f"values of shape {values.shape} cannot be broadcast to {shape}")
    return np.asarray(values, dtype=float, order="C").reshape(-1, *shape[-2:])


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
        stacked = (total.size, *operator.shape)
        self._base = operator.base if isinstance(operator, WornOperator) else operator
        spare = _spare.pop(self._base, ())
        _spare.clear()
        self._memory = spare if spare and spare[0].shape == stacked else _memory(*stacked)
        whole = (*total.shape, *operator.shape)
        given, gap = gap, self._memory[0]
        gap[:] = _stacked(given, whole)
        self._threads = Threads(threads(), len(gap))
        self._compiled = CompiledOperator(operator, self._threads)
        super().__init__(
            self._compiled,
            gap,
            np.array(total, dtype=float).reshape(-1),
            # A copy: compiled code takes no read-only array.
            limit if isinstance(limit, float) else _stacked(limit, whole).copy(),
            None if start is None else _stacked(start, whole),
            shares,
        )
        self._most = (
            np.full((1, 1, gap.shape[2]), limit) if isinstance(limit, float) else self.limit
        )
        shape = self._compiled.shape
        inverse = transposed(1.0 / self.preconditioner.symbol, shape)
        self._inverse = Convolution(inverse, shape, self._compiled.modes)
        _, self.change, self.moved, *lists = self._memory
        self.change[:] = self.moved[:] = 0.0
        self._sums = passes.empty_sums(len(gap))
        self._lists = (*lists, self._sums)
        self._judge()

    def _sum(self, column: int) -> float:
        return float((self.shares * self._sums[:, column]).sum())

    def _judge(self) -> None:
        self._threads(passes.judge, self._place(), self._lists, self.total)

    def _place(self) -> tuple[Any, ...]:
        here = (self.pressure, self.displacement, self.gap, self._most)
        return (*here, self.change, self.moved)

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
        self.decrease = decrease
        part = -slope / curvature
        self.length *= min(max(part, 0.5), 2.0)
        onto = part >= NEAR_ENOUGH and sums[:, passes.MEETS_BOUND].any()
        if onto or passes.leaves(self._lists, part):
            part = 1.0
        self._threads(passes.arrive, self._place(), self._lists, self.total, part)
        return True

    def _precondition(self) -> None:
        """Write the preconditioned residual, which is the step until there is one."""
        by = self._inverse
        given = (self.change, self.moved, self._lists, by.spectrum)
        self._threads(passes.precondition, *given, memory=by.memory)
        if self.preconditioner.wears:
            self.moved -= self.preconditioner.correction(self.change)
        passes.steepen(self.moved, self._lists)

    def _advance(self, beta: float) -> None:
        """Write the step of a direction, and the response to it, which lies in `moved`."""
        by = self._compiled.elastic
        given = (self.change, self.moved, self._lists, self.total, beta, self.length, by.spectrum)
        self._threads(passes.advance, *given, memory=by.memory)
        self._compiled.add_wear(self.change, self.moved, self._sums)

    def spectral_step(self) -> None:
        """Move along the gradient; see `Iterate.spectral_step`."""
        self._deform()
        super().spectral_step()
        self._judge()

    def solutions(self, iterations: int, reached: list[Residuals]) -> list[ContactSolution]:
        """Return the solution at each position."""
        self.full = self.pressure >= self.limit
        if self.full.any():
            self._deform()
        _spare[self._base] = self._memory
        return super().solutions(iterations, reached)

    def _deform(self) -> None:
        self.deformed = self.displacement + self.gap - self.approach[:, None, None]
