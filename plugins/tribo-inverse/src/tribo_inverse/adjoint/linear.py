"""The linear system of the adjoint of a step, on the cells in contact."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from tribo import Array, Box, CycleCompliance, Mask, NumericalError, Operator, WearCompliance
from tribo.kernel_api import CELLS, Preconditioner, WornOperator, over

from tribo_inverse.increment.carriers import Carrier

Map = Callable[[Array], Array]

TOLERANCE = 1e-7
"""Residual of a system, relative to its right side: as small as a one-sided difference of rates."""
ALIKE = 1e-9
"""Relative difference below which slopes are alike, which are differences of rates."""
MOST = 400
"""Iterations after which the method gives up."""


@dataclass(frozen=True)
class StepSystem:
    """K z plus the wear that a step adds, transposed, on the free cells of each position.

    With the shares ω of the positions, Tₘ from a body's surface to the window and ωₘ r'ₘ the
    derivative of a point's depth in the pressure of each of its cells::

        (A z)ₘ = K zₘ + Σ over bodies r'ₘ Tₘ Σₙ Tₙᵀ ωₙ zₙ

    `operator` is K on the `box`, `bodies` has the carrier of each body that wears and r', shape
    (positions, nx, ny), in m/Pa, and `free` the cells whose pressure is between its bounds. `wear`
    returns A z − K z where `bodies` give it approximately, to precondition. `mirrored` is whether
    each position also represents its mirror image along x; the last represents itself.
    """

    operator: Operator
    box: Box
    shares: Array
    bodies: Sequence[tuple[Carrier, Array]]
    free: Mask
    wear: Map | None = None
    mirrored: bool = False

    def apply(self, z: Array) -> Array:
        """Return A z on all of the box."""
        found = self.operator.apply(z)
        if self.wear is not None:
            return found + self.wear(z)
        if self.bodies:
            weighed = over(self.shares) * z
            for carrier, slope in self.bodies:
                own = carrier.gathered(weighed, self.box)
                if self.mirrored:
                    own = own + own[::-1]
                found = found + slope * carrier.seen(own, self.box)
        return found

    def solve(self, given: Array, fixed: Array, start: Array) -> Array:
        """Return z, for which `given` − A z is uniform on the free cells of each position.

        On the other cells z is `fixed`, and its sum over all is 0; `start` is the first guess.
        """
        if self._mirrors(given, fixed):
            return _both(self._one_side().solve(*(a[: self._half] for a in (given, fixed, start))))
        count = self.free.sum(CELLS)
        if np.any((count == 0) & (np.sum(fixed, CELLS) != 0)):
            raise NumericalError(
                "all cells in contact are at the hardness at once: the approach has no derivative "
                "there; take a finer grid or a lower load"
            )
        share = 1.0 / np.maximum(count, 1)
        z = np.where(self.free, start, 0.0)
        z -= over(share * (z.sum(CELLS) + fixed.sum(CELLS))) * self.free
        z += fixed
        estimate = self._estimate()

        def centred(values: Array) -> Array:
            kept: Array = values * self.free
            kept -= over(share * kept.sum(CELLS)) * self.free
            return kept

        def preconditioned(values: Array) -> Array:
            return centred(estimate(values))

        def applied(values: Array) -> Array:
            return centred(self.apply(values))

        left = given - self.apply(z)
        residual = centred(left)
        # A uniform right side is balanced by μ alone, but for rounding.
        scale = max(_norm(given * self.free), _norm((given - left) * self.free))
        if scale > 0 and _norm(residual) > TOLERANCE * scale:
            z = z + _minimal(applied, preconditioned, residual, TOLERANCE * scale)
        return z

    @property
    def _half(self) -> int:
        return len(self.shares) // 2 + 1

    def _one_side(self) -> StepSystem:
        shares = self.shares[: self._half].copy()
        # The middle position mirrors itself.
        shares[-1] *= 0.5
        bodies = [
            (replace(carrier, cells=carrier.cells[: self._half]), slope[: self._half])
            for carrier, slope in self.bodies
        ]
        return replace(
            self, shares=shares, bodies=bodies, free=self.free[: self._half], mirrored=True
        )

    def _mirrors(self, given: Array, fixed: Array) -> bool:
        """Whether each position mirrors another along x, and the middle one itself."""
        beside = 2 * self.box.first[0] + self.box.shape[0] - self.box.window[0]
        if (
            self.wear
            or self.mirrored
            or len(self.shares) < 3
            or len(self.shares) % 2 == 0
            or beside
        ):
            return False
        for carrier, _ in self.bodies:
            rows = carrier.shape[0]
            pairs = zip(carrier.cells, reversed(carrier.cells), strict=True)
            off = ((a + b - rows + self.box.window[0]) % rows or c - d for (a, c), (b, d) in pairs)
            if carrier.weights is None and any(off):
                return False
        # Laws are asked in a region around the contact that need not mirror itself.
        pressed = [given * self.free, *(slope * self.free for _, slope in self.bodies)]
        fields = [self.free.astype(float), fixed, *pressed]
        return np.allclose(self.shares, self.shares[::-1], rtol=ALIKE) and all(
            np.max(np.abs(field - field[::-1, ::-1])) <= ALIKE * np.max(np.abs(field))
            for field in fields
        )

    def _estimate(self) -> Preconditioner:
        """Return an estimate of the inverse of A, with the mean slope of each body."""
        bodies: list[tuple[Array, Sequence[tuple[int, int]]]] = []
        local = swept = 0.0
        for carrier, slope in self.bodies:
            inside = slope[self.free]
            mean = max(float(np.mean(inside)), 0.0) if inside.size else 0.0
            if carrier.weights is not None:
                swept += mean / self.operator.spacing[0]
            elif len(self.shares) == 1:
                local += mean
            else:
                bodies.append((np.full(carrier.shape, mean), carrier.cells))
        nx, ny = self.box.window
        wear: WearCompliance | CycleCompliance = WearCompliance(
            np.full((nx, ny), local), np.full(ny, swept)
        )
        if bodies:
            wear = CycleCompliance(self.shares, bodies, slice(0, nx), self.mirrored)
        return Preconditioner(WornOperator(self.operator, wear.on(self.box)))


def _minimal(applied: Map, preconditioned: Map, residual: Array, tolerance: float) -> Array:
    """Solve by generalised conjugate residuals: the iterates of GMRES."""
    found, basis = np.zeros_like(residual), list[tuple[Array, Array]]()
    for _ in range(MOST):
        direction = preconditioned(residual)
        response = applied(direction)
        for before, answer in basis:
            part = np.einsum("mxy,mxy->", answer, response)
            direction -= part * before
            response -= part * answer
        size = _norm(response)
        if size == 0:
            break
        direction, response = direction / size, response / size
        basis.append((direction, response))
        step = np.einsum("mxy,mxy->", response, residual)
        found += step * direction
        residual = residual - step * response
        if _norm(residual) <= tolerance:
            return found
    raise NumericalError(
        f"the gradient of a step did not converge: its residual is {_norm(residual):.1e}, wanted "
        f"{tolerance:.1e}"
    )


def _both(values: Array) -> Array:
    """Return fields at all positions, from the fields on one side and in the middle."""
    middle = 0.5 * (values[-1:] + values[-1:, ::-1])
    return np.concatenate([values[:-1], middle, values[-2::-1, ::-1]])


def _norm(values: Array) -> float:
    return float(np.sqrt(np.sum(values * values)))
