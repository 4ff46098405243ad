"""A stranger's contact solver: a half-space under an elastic layer, as a kernel.

The kernel is that of a half-space of the layer's material plus the effect of
the base, which is smooth on the scale of the layer's thickness.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Annotated

import numpy as np
import scipy.fft
from scipy.interpolate import CubicSpline
from scipy.special import j0

from tribo import (
    Array,
    CaseError,
    ContactProblem,
    ContactSolution,
    ContactSolver,
    ContactSystem,
    HalfSpace,
    Quantity,
    hookimpl,
    solve_bounded,
)

Modulus = Annotated[float, Quantity("Pa", above=0)]
Poisson = Annotated[float, Quantity("1", above=-1, below=0.5)]


class LayeredHalfSpace:
    """Layer, base and a half-space as counter-body: an operator for `solve_bounded`.

    Parameters
    ----------
    shape, spacing : tuple
        Cells of the box, and their edge lengths in m.
    config : Layered
        Layer and base.
    counter : float
        Compliance 1/E* of the counter-body, in 1/Pa; 0 if it is rigid.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        spacing: tuple[float, float],
        config: Layered,
        counter: float = 0.0,
    ) -> None:
        self.shape, self.spacing = shape, spacing
        self._layer = HalfSpace(shape, spacing, 1 / (1 / config.modulus + counter))
        self._padded = [scipy.fft.next_fast_len(2 * n - 1, real=True) for n in shape]
        offsets = [np.minimum(np.arange(m), m - np.arange(m)) for m in self._padded]
        kernel = self._base_kernel(config)[
            np.ix_(*(np.minimum(o, n - 1) for o, n in zip(offsets, shape, strict=True)))
        ]
        self._spectrum = scipy.fft.rfft2(kernel)
        qx = 2 * np.pi * np.fft.fftfreq(shape[0], spacing[0])
        qy = 2 * np.pi * np.fft.rfftfreq(shape[1], spacing[1])
        q = np.hypot(qx[:, None], qy[None, :])
        q[0, 0] = 0.5 * min(qx[1], qy[1])
        self._symbol = config.compliance(q) + 2 * counter / q

    def _base_kernel(self, config: Layered) -> Array:
        """Mean displacement of cells at offsets (i, j) under unit pressure on cell (0, 0)."""
        h, (dx, dy) = config.thickness, self.spacing
        reach = np.hypot(self.shape[0] * dx, self.shape[1] * dy) / h
        # Dense near the load, and ever wider apart where the kernel falls like 1/r.
        r = np.sinh(np.linspace(0, np.arcsinh(4 * reach), 400)) / 4
        xi, weights = _panels(20.0, 8 + int(reach))
        values = j0(np.outer(r, xi)) @ (weights * config.influence(xi))
        green = CubicSpline(r, values / (np.pi * config.modulus * h))
        x, wx = _between_cells(self.shape[0], dx / h)
        y, wy = _between_cells(self.shape[1], dy / h)
        distance = np.hypot(x[:, None, :, None], y[None, :, None, :])
        return np.asarray(np.einsum("ijab,a,b->ij", green(distance), wx, wy) * dx * dy)

    def apply(self, pressure: Array) -> Array:
        """Return the displacement under `pressure`."""
        modes = scipy.fft.rfft2(pressure, self._padded) * self._spectrum
        nx, ny = self.shape
        return self._layer.apply(pressure) + scipy.fft.irfft2(modes, self._padded)[:nx, :ny]

    def symbol(self) -> Array:
        """Return the compliance of the waves on the box."""
        return np.array(self._symbol)


class Layered(ContactSolver):
    """Contact on a layered half-space, on the whole window."""

    type = "stranger.layered"
    thickness: Annotated[float, Quantity("m", above=0)]
    """Thickness of the layer."""
    young: Modulus
    """Young's modulus of the layer."""
    poisson: Poisson
    """Poisson's ratio of the layer."""
    base_young: Modulus
    """Young's modulus of the base, which is the material of one of the bodies."""
    base_poisson: Poisson
    """Poisson's ratio of the base."""

    @property
    def modulus(self) -> float:
        """Plane-strain modulus of the layer, in Pa."""
        return self.young / (1 - self.poisson**2)

    @property
    def base_modulus(self) -> float:
        """Plane-strain modulus of the base, in Pa."""
        return self.base_young / (1 - self.base_poisson**2)

    def influence(self, xi: Array) -> Array:
        """Displacement per pressure over that of a half-space of layer, minus 1; xi = q h.

        O'Sullivan, T. C., King, R. B. (1988), J. Tribol. 110, 235-240.
        """
        nu, base_nu = self.poisson, self.base_poisson
        mu = self.young / (1 + nu) / (self.base_young / (1 + base_nu))
        lam = 1 - 4 * (1 - nu) / (1 + mu * (3 - 4 * base_nu))
        kap = (mu - 1) / (mu + 3 - 4 * nu)
        decay = np.exp(-2 * xi)
        above = 4 * xi * kap * decay - lam * kap * decay**2
        below = -(lam + kap + 4 * kap * xi**2) * decay + lam * kap * decay**2
        return np.asarray((above - below) / (1 + below))

    def compliance(self, q: Array) -> Array:
        """Displacement per pressure of a wave of wavenumber q (1/m) on layer and base, in m/Pa."""
        return np.asarray(2 / (self.modulus * q) * (1 + self.influence(q * self.thickness)))

    accepts_wear_compliance = True
    honours_cap = True

    def check(self, system: ContactSystem) -> None:
        base = self.base_modulus
        if system.modulus > base * (1 + 1e-12):
            raise CaseError(
                f"the bodies have a contact modulus of {system.modulus:.4g} Pa, but the base alone "
                f"has {base:.4g} Pa; base_young and base_poisson are those of one of the bodies"
            )

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        system = problem.system
        counter = max(1 / system.modulus - 1 / self.base_modulus, 0.0)
        return solve_bounded(
            _operator(system.grid.cells, system.grid.spacing, self, counter),
            problem.gap,
            problem.load,
            system.cap,
            problem.wear,
            start=None if start is None else start.pressure,
        )


_operator = lru_cache(maxsize=4)(LayeredHalfSpace)


def _between_cells(count: int, width: float, points: int = 3) -> tuple[Array, Array]:
    """Distances from a cell's centre to points of the cells beside it, and their weights."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return width * (np.arange(count)[:, None] + 0.5 * nodes), 0.5 * weights


def _panels(end: float, count: int, points: int = 16) -> tuple[Array, Array]:
    """Nodes and weights of Gauss's rule on equal parts of [0, end]."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    width = end / count
    middles = width * (np.arange(count)[:, None] + 0.5)
    return (middles + 0.5 * width * nodes).ravel(), np.tile(0.5 * width * weights, count)


@hookimpl
def tribo_components() -> list[type[Layered]]:
    return [Layered]
