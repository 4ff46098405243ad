"""Conjugate gradients with bounds: the pressure in [0, cap] that carries a load, any operator."""

from __future__ import annotations

import numpy as np
import scipy.fft

from tribo.contact.operator import Operator, WornOperator
from tribo.contact.projection import balance, project
from tribo.contact.residuals import check_bearable, check_finite, dot, residuals
from tribo.core.arrays import Array, Mask
from tribo.core.contact import ContactSolution, Residuals, WearCompliance
from tribo.core.errors import NumericalError

# Where the minimum along a step onto a bound lies beyond this part of the step, all of it is
# taken; that lowers the energy if the part is more than 1/2.
_NEAR_ENOUGH = 0.75
# Iterations within which a method must halve the residual, or the other takes over.
_PATIENCE = 12


def solve_bounded(
    operator: Operator,
    gap: Array,
    load: float,
    cap: float | None = None,
    compliance: WearCompliance | None = None,
    *,
    start: Array | None = None,
    tolerance: float = 1e-8,
    max_iterations: int = 500,
) -> ContactSolution:
    """Minimise ½ pᵀA p + gapᵀp over 0 <= p <= cap with sum(p) * cell area = load.

    Preconditioned conjugate gradients on the cells strictly within the bounds,
    which are left and entered as the iteration goes: a step as long as the last
    one is projected onto the bounds, and the minimum sought along what is left
    of it. Where that stalls, as it does when nearly all cells are at a bound,
    projected Barzilai-Borwein steps take over until they stall in turn.

    Parameters
    ----------
    operator : Operator
        K, from pressure to displacement; its cells give the area and Δx.
    gap : ndarray, shape (nx, ny)
        Undeformed gap, up to a constant, in m.
    load : float
        Normal load, in N; positive.
    cap : float, optional
        Largest pressure, in Pa; unlimited when None.
    compliance : WearCompliance, optional
        Added to K, on the same box.
    start : ndarray, shape (nx, ny), optional
        A pressure to start from, in Pa; brought to the load and the bounds.
    tolerance : float, default 1e-8
        What each of the `Residuals` must fall to. Their ``scale`` is the largest
        displacement A p under pressure, or the range of the gap there if that
        is more. Cells at the cap whose gap is open count as violations of
        complementarity too.
    max_iterations : int, default 500
        Each costs one call of the operator; the start costs one too.

    Returns
    -------
    ContactSolution
        On the box of the operator.

    Raises
    ------
    CaseError
        If the load is not positive, or more than the box bears at the cap.
    NumericalError
        If the gap is not finite, the load is lost in rounding, or the residuals
        did not fall to the tolerance; the message says how far they came.

    References
    ----------
    I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206-219; E. A. H. Vollebregt,
    J. Optim. Theory Appl. 162 (2014) 931-953; V. Rey, G. Anciaux,
    J.-F. Molinari, Comput. Mech. 60 (2017) 69-81; J. Barzilai, J. M. Borwein,
    IMA J. Numer. Anal. 8 (1988) 141-148.
    """
    if compliance is not None:
        operator = WornOperator(operator, compliance)
    limit = np.inf if cap is None else cap
    cell_area = operator.spacing[0] * operator.spacing[1]
    check_bearable(load, cell_area * gap.size, limit)
    check_finite(gap)
    total = load / cell_area

    iterate = _Iterate(operator, gap, total, limit, start)
    best, waited = np.inf, 0
    for iteration in range(max_iterations + 1):
        reached = iterate.judge()
        if reached.worst <= tolerance:
            return iterate.solution(iteration, reached)
        if iteration == max_iterations:
            break
        waited += 1
        if reached.worst < 0.5 * best:
            best, waited = reached.worst, 0
        if waited > _PATIENCE:
            best, waited = reached.worst, 0
            iterate.switch()
        if not (iterate.conjugate and iterate.conjugate_step()):
            iterate.spectral_step()
    raise NumericalError(
        f"the contact did not converge in {max_iterations} iterations: the residual is "
        f"{reached.worst:.1e}, the tolerance {tolerance:.1e}. Raise max_iterations or "
        "tolerance of the contact solver, or shorten the step"
    )


class _Iterate:
    """A feasible pressure, its displacement, and the memory of the iteration."""

    def __init__(
        self, operator: Operator, gap: Array, total: float, limit: float, start: Array | None
    ) -> None:
        self.operator = operator
        self.symbol = operator.symbol()
        self.gap = gap
        self.total = total
        self.limit = limit
        self.pressure = _feasible(start, gap.shape, total, limit)
        self.displacement = operator.apply(self.pressure)
        self.full = np.zeros(gap.shape, dtype=bool)
        self.conjugate = True
        self.direction: Array | None = None
        self.gradient = np.zeros(0)
        self.decrease = 0.0
        self.length = 1.0
        self.rate = 1.0 / float(self.symbol.max())
        self.lengthen = False

    def judge(self) -> Residuals:
        """Sort the cells, find the approach and the deformed gap, and judge them."""
        p = self.pressure
        self.free = p > 0
        self.zero = ~self.free
        if self.limit < np.inf:
            self.full = p >= self.limit
            self.free &= ~self.full
        self.deformed = self.displacement + self.gap
        self.approach = _approach(self.deformed, self.free, self.zero, self.full)
        self.deformed -= self.approach
        return residuals(p, self.gap, self.displacement, self.approach, self.total, self.limit)

    def conjugate_step(self) -> bool:
        """Move along a conjugate direction on the face; False if that does not lower the energy."""
        g = self.deformed
        face = self.free | (self.zero & (g < 0))
        if self.limit < np.inf:
            face |= self.full & (g > 0)
        share = 1.0 / max(int(np.count_nonzero(face)), 1)
        residual = _centred(g, face, share)
        modes = scipy.fft.rfft2(residual)
        modes /= self.symbol
        shape = (residual.shape[0], residual.shape[1])
        z = _centred(scipy.fft.irfft2(modes, s=shape, overwrite_x=True), face, share)
        decrease = dot(residual, z)
        direction = -z
        if self.direction is not None:
            # Polak and Ribière's formula forgets by itself when the face changes.
            beta = (decrease - dot(z, self.gradient)) / self.decrease
            if beta > 0:
                kept = _centred(self.direction, face, share)
                kept *= beta
                direction += kept
        if dot(residual, direction) >= 0:
            direction = -z
        # Not `ahead` less the pressure, of which little but rounding may be left.
        change = self.length * direction
        ahead = self.pressure + change
        meets_bound = self._leaves(ahead)
        if meets_bound:
            ahead = project(ahead, self.total, self.limit, face)
            change = ahead - self.pressure
        slope = dot(change, g)
        if slope >= 0:
            return False
        response = self.operator.apply(change)
        curvature = dot(change, response)
        if curvature <= 0:
            return False
        self.direction, self.gradient, self.decrease = direction, residual, decrease
        best = -slope / curvature
        self.length *= min(max(best, 0.5), 2.0)
        part, moved = best, self.pressure + best * change
        if (meets_bound and best >= _NEAR_ENOUGH) or self._leaves(moved):
            # `ahead` lies within the bounds, and cells that meet one leave the face there.
            part, moved = 1.0, ahead
        self.pressure = balance(moved, self.total, self.limit)
        response *= part
        self.displacement += response
        return True

    def _leaves(self, pressure: Array) -> bool:
        return float(pressure.min()) < 0 or float(pressure.max()) > self.limit

    def spectral_step(self) -> None:
        """Move along the gradient by an inverse Rayleigh quotient and project."""
        before, displaced = self.pressure, self.displacement
        everywhere = np.ones(before.shape, dtype=bool)
        moved = before - self.rate * self.deformed
        self.pressure = project(moved, self.total, self.limit, everywhere)
        self.displacement = self.operator.apply(self.pressure)
        change, response = self.pressure - before, self.displacement - displaced
        curvature = dot(change, response)
        if curvature > 0:
            long = dot(change, change) / curvature
            short = curvature / dot(response, response)
            # Alternating the two keeps the steps from settling into a cycle.
            self.rate = long if self.lengthen else short
            self.lengthen = not self.lengthen

    def switch(self) -> None:
        """Hand over to the other method."""
        self.conjugate = not self.conjugate
        self.direction = None
        self.rate = 1.0 / float(self.symbol.max())

    def solution(self, iterations: int, reached: Residuals) -> ContactSolution:
        return ContactSolution(
            pressure=self.pressure,
            approach=self.approach,
            overlap=np.where(self.full, np.maximum(-self.deformed, 0.0), 0.0),
            iterations=iterations,
            residuals=reached,
        )


def _approach(gap: Array, free: Mask, zero: Mask, full: Mask) -> float:
    if free.any():
        return float(np.mean(gap[free]))
    if not full.any():
        raise NumericalError(
            "no cell is in contact: the load is so small that it is lost in rounding; raise "
            "load.normal"
        )
    # Without a cell between the bounds any value between the two will do.
    highest = float(gap[full].max())
    return 0.5 * (highest + float(gap[zero].min())) if zero.any() else highest


def _centred(values: Array, face: Mask, share: float) -> Array:
    """Return `values` on the face less their mean there, `share` being one over its cells."""
    kept = values * face
    np.subtract(kept, share * float(kept.sum()), out=kept, where=face)
    return kept


def _feasible(start: Array | None, shape: tuple[int, ...], total: float, limit: float) -> Array:
    loaded = np.ones(shape, dtype=bool)
    guess = np.full(shape, total / loaded.size)
    given = 0.0 if start is None else float(start.sum())
    if start is not None and given > 0:
        guess = np.maximum(start, 0.0)
        guess *= total / float(guess.sum())
        if float(guess.max()) <= limit:
            return balance(guess, total, limit)
        np.minimum(guess, limit, out=guess)
        support = guess > 0
        if int(np.count_nonzero(support)) * limit > total:
            loaded = support
    return project(guess, total, limit, loaded)
