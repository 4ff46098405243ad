"""Conjugate gradients with bounds: the pressure in [0, cap] that carries a load, any operator."""

from __future__ import annotations

import numpy as np

from tribo.contact.operator import Operator, WornOperator
from tribo.contact.preconditioner import Preconditioner
from tribo.contact.projection import CELLS, balance, limits, over, project
from tribo.contact.residuals import check_bearable, check_finite, dots, judged
from tribo.core.arrays import Array, Mask
from tribo.core.compiled import compiled
from tribo.core.contact import ContactSolution, CycleCompliance, Residuals, WearCompliance
from tribo.core.errors import NumericalError

NEAR_ENOUGH = 0.75
"""Where the minimum along a step onto a bound lies beyond this part of the step, all of it is
taken; that lowers the energy if the part is more than 1/2."""


def solve_bounded(
    operator: Operator,
    gap: Array,
    load: float,
    cap: Array | float | None = None,
    compliance: WearCompliance | None = None,
    *,
    start: Array | None = None,
    tolerance: float = 1e-8,
    max_iterations: int = 500,
) -> ContactSolution:
    """Minimise ½ pᵀA p + gapᵀp over 0 <= p <= cap with sum(p) * cell area = load.

    Preconditioned conjugate gradients on the cells strictly within the bounds. A step as long as
    the last one is projected onto the bounds, and the minimum sought along the projected step.
    Where that leads uphill, a projected step of Barzilai and Borwein's length is taken.

    Parameters
    ----------
    operator : Operator
        K, from pressure to displacement; its cells give the area and Δx.
    gap : ndarray, shape (nx, ny)
        Undeformed gap, up to a constant, in m.
    load : float
        Normal load, in N; positive.
    cap : float or ndarray, shape (nx, ny), optional
        Largest pressure, in Pa; unlimited when None.
    compliance : WearCompliance, optional
        Added to K, on the same box, which makes A of it.
    start : ndarray, shape (nx, ny), optional
        A pressure to start from, in Pa; brought to the load and the bounds.
    tolerance : float, default 1e-8
        Largest of the `Residuals`, in which the displacement is A p.
    max_iterations : int, default 500
        Each costs one call of the operator; the start costs one too.

    Returns
    -------
    ContactSolution
        On the operator's box.

    Raises
    ------
    CaseError
        If the load is not positive, or more than the box bears at the cap.
    NumericalError
        If the gap is not finite, the load is lost in rounding, or the residuals stay above the
        tolerance; the message states them.

    References
    ----------
    I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206-219; E. A. H. Vollebregt, J. Optim. Theory Appl.
    162 (2014) 931-953; V. Rey, G. Anciaux, J.-F. Molinari, Comput. Mech. 60 (2017) 69-81;
    J. Barzilai, J. M. Borwein, IMA J. Numer. Anal. 8 (1988) 141-148.

    Examples
    --------
    >>> grid = tribo.Grid("0.4 mm", 64)
    >>> steel = tribo.HalfSpace(grid.cells, grid.spacing, modulus=115e9)
    >>> gap = -tribo.Sphere(radius="5 mm").height(grid)
    >>> round(tribo.solve_bounded(steel, gap, load=10.0).approach * 1e6, 2)  # µm, as Hertz's
    0.95
    """
    return solve_together(
        operator,
        gap,
        np.asarray(load, dtype=float),
        cap,
        compliance,
        start=start,
        tolerance=tolerance,
        max_iterations=max_iterations,
    )[0]


def solve_together(
    operator: Operator,
    gap: Array,
    load: Array,
    cap: Array | float | None = None,
    compliance: WearCompliance | CycleCompliance | None = None,
    *,
    start: Array | None = None,
    tolerance: float = 1e-8,
    max_iterations: int = 500,
) -> list[ContactSolution]:
    """Solve one position, or the stacked positions of a cycle, as one problem.

    Gap, cap and start have the shape (nx, ny) or (positions, nx, ny), the load () or (positions,).
    Positions that a compliance couples are weighted with their shares of the path, which keeps A
    symmetric; else equally. See `solve_bounded`.
    """
    if compliance is not None:
        operator = WornOperator(operator, compliance)
    limit = np.inf if cap is None else cap if isinstance(cap, np.ndarray) else float(cap)
    cell_area = operator.spacing[0] * operator.spacing[1]
    for place in np.ndindex(gap.shape[:-2]):
        check_bearable(float(load[place]), cell_area * gap[place].size, at(limit, place))
    check_finite(gap)
    total = np.asarray(load / cell_area)
    shares = compliance.shares if isinstance(compliance, CycleCompliance) else None

    fast = compiled()
    iterates = fast.iterates(operator, gap.size) if fast else None
    iterate: Iterate = (iterates or Iterate)(operator, gap, total, limit, start, shares)
    for iteration in range(max_iterations + 1):
        reached = iterate.judge()
        worst = max(each.worst for each in reached)
        if worst <= tolerance:
            return iterate.solutions(iteration, reached)
        if iteration == max_iterations:
            break
        if not iterate.conjugate_step():
            iterate.spectral_step()
    raise NumericalError(
        f"the contact did not converge in {max_iterations} iterations: the residual is "
        f"{worst:.1e}, the tolerance {tolerance:.1e}. Raise max_iterations or "
        "tolerance of the contact solver, or shorten the step"
    )


class Iterate:
    """A feasible pressure, its displacement, and the memory of the iteration."""

    def __init__(
        self,
        operator: Operator,
        gap: Array,
        total: Array,
        limit: Array | float,
        start: Array | None,
        shares: Array | None,
    ) -> None:
        self.operator = operator
        self.preconditioner = Preconditioner(operator)
        self.gap = gap
        self.total = total
        self.limit = limit
        self.shares = np.ones(gap.shape[:-2]) if shares is None else shares
        self.pressure = _feasible(start, gap.shape, total, limit)
        self.displacement = operator.apply(self.pressure)
        self.full = np.zeros(gap.shape, dtype=bool)
        # Overwritten in each iteration: new memory costs as much as what is computed in it.
        self.deformed, self.residual, self.gradient, self.direction = np.zeros((4, *gap.shape))
        self.change, self.ahead, self.moved = np.empty((3, *gap.shape))
        self.decrease = np.inf
        self.length = 1.0
        self.rate = 1.0 / float(self.preconditioner.symbol.max())
        self.lengthen = False

    def _dot(self, a: Array, b: Array) -> float:
        return float((self.shares * dots(a, b)).sum())

    def judge(self) -> list[Residuals]:
        """Sort the cells, find the approach and the deformed gap, and judge them."""
        p = self.pressure
        self.free = p > 0
        self.zero = ~self.free
        if limits(self.limit):
            self.full = p >= self.limit
            self.free &= ~self.full
        np.add(self.displacement, self.gap, out=self.deformed)
        self.approach = _approach(self.deformed, self.free, self.zero, self.full)
        self.deformed -= over(self.approach)
        return judged(p, self.gap, self.displacement, self.deformed, self.total, self.limit)

    def conjugate_step(self) -> bool:
        """Move along a conjugate direction on the face; False if that does not lower the energy."""
        g = self.deformed
        face = self.free | (self.zero & (g < 0))
        if limits(self.limit):
            face |= self.full & (g > 0)
        share = 1.0 / np.maximum(face.sum(CELLS), 1)
        residual = _centred(g, face, share, self.residual)
        z = self.preconditioner(residual)
        z = _centred(z, face, share, z)
        decrease = self._dot(residual, z)
        # Polak and Ribière's formula forgets by itself when the face changes. The direction before
        # is lost here, and forgotten unless this step is taken.
        beta = max(0.0, (decrease - self._dot(z, self.gradient)) / self.decrease)
        self.decrease = np.inf
        direction = _centred(self.direction, face, share, self.direction)
        direction *= beta
        direction -= z
        if self._dot(residual, direction) >= 0:
            np.negative(z, out=direction)
        # Not `ahead` less the pressure, of which little but rounding may be left.
        change = np.multiply(direction, self.length, out=self.change)
        ahead = np.add(self.pressure, change, out=self.ahead)
        meets_bound = self._leaves(ahead)
        if meets_bound.any():
            ahead[meets_bound] = project(
                ahead[meets_bound],
                self.total[meets_bound],
                at(self.limit, meets_bound),
                face[meets_bound],
            )
            change[meets_bound] = ahead[meets_bound] - self.pressure[meets_bound]
        slope = self._dot(change, g)
        if slope >= 0:
            return False
        response = self.operator.apply(change)
        curvature = self._dot(change, response)
        if curvature <= 0:
            return False
        self.residual, self.gradient, self.decrease = self.gradient, residual, decrease
        part = -slope / curvature
        self.length *= min(max(part, 0.5), 2.0)
        change *= part
        moved = np.add(self.pressure, change, out=self.moved)
        if (meets_bound.any() and part >= NEAR_ENOUGH) or self._leaves(moved).any():
            # `ahead` lies within the bounds, and cells that meet one leave the face there.
            part, moved, self.ahead = 1.0, ahead, moved
        self.moved, self.pressure = self.pressure, balance(moved, self.total, self.limit)
        response *= part
        self.displacement += response
        return True

    def _leaves(self, pressure: Array) -> Mask:
        below: Mask = np.asarray(pressure.min(CELLS) < 0)
        return below | (pressure > self.limit).any(CELLS) if limits(self.limit) else below

    def spectral_step(self) -> None:
        """Move along the gradient by an inverse Rayleigh quotient and project."""
        before, displaced = self.pressure, self.displacement
        everywhere = np.ones(before.shape, dtype=bool)
        moved = before - self.rate * self.deformed
        self.pressure = project(moved, self.total, self.limit, everywhere)
        self.displacement = self.operator.apply(self.pressure)
        change, response = self.pressure - before, self.displacement - displaced
        curvature = self._dot(change, response)
        if curvature > 0:
            long = self._dot(change, change) / curvature
            short = curvature / self._dot(response, response)
            # Alternating the two keeps the steps from settling into a cycle.
            self.rate = long if self.lengthen else short
            self.lengthen = not self.lengthen

    def solutions(self, iterations: int, reached: list[Residuals]) -> list[ContactSolution]:
        """Return the solution at each position."""
        overlap = np.zeros_like(self.gap)
        overlap[self.full] = np.maximum(-self.deformed[self.full], 0.0)
        places = np.ndindex(self.gap.shape[:-2])
        return [
            ContactSolution(
                pressure=self.pressure[place],
                approach=float(self.approach[place]),
                overlap=overlap[place],
                iterations=iterations,
                residuals=residuals,
            )
            for place, residuals in zip(places, reached, strict=True)
        ]


def _approach(gap: Array, free: Mask, zero: Mask, full: Mask) -> Array:
    between = free.sum(CELLS)
    found = np.asarray((gap * free).sum(CELLS) / np.maximum(between, 1))
    if not between.all():
        for place in map(tuple, np.argwhere(between == 0)):
            found[place] = _approach_at_bounds(gap[place], zero[place], full[place])
    return found


def _approach_at_bounds(gap: Array, zero: Mask, full: Mask) -> float:
    """Return the approach where no cell is between the bounds: any value between the two."""
    if not full.any():
        raise NumericalError(
            "no cell is in contact: the load is so small that it is lost in rounding; raise "
            "load.normal"
        )
    highest = float(gap[full].max())
    return 0.5 * (highest + float(gap[zero].min())) if zero.any() else highest


def _centred(values: Array, face: Mask, share: Array, centred: Array) -> Array:
    """Write `values` on the face less their mean there, `share` being one over its cells."""
    np.multiply(values, face, out=centred)
    return np.subtract(centred, over(share * centred.sum(CELLS)), out=centred, where=face)


def at(limit: Array | float, place: tuple[int, ...] | Mask) -> Array | float:
    """Return a largest pressure at some of the positions."""
    return limit if isinstance(limit, float) else np.asarray(limit[place])


def _feasible(
    start: Array | None, shape: tuple[int, ...], total: Array, limit: Array | float
) -> Array:
    """Return a pressure within the bounds that carries the load, as near to `start` as it may."""
    guess = np.zeros(shape) if start is None else np.maximum(start, 0.0, dtype=float)
    guess[~guess.any(CELLS)] = 1.0
    guess *= over(total / guess.sum(CELLS))
    if (guess <= limit).all():
        return balance(guess, total, limit)
    np.minimum(guess, limit, out=guess)
    loaded = guess > 0
    loaded[np.where(loaded, limit, 0.0).sum(CELLS) <= total] = True
    return project(guess, total, limit, loaded)
