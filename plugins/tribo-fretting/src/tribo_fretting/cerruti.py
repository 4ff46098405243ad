"""Cerruti's displacement along the surface under tangential traction, as an operator."""

from __future__ import annotations

import math
from collections.abc import Collection
from functools import lru_cache

import numpy as np
import scipy
from tribo import Array, HalfSpace, Material


def tangential_compliances(materials: Collection[Material]) -> tuple[float, float]:
    """Return A = Σ 1/(2πG) and B = Σ ν/(2πG) of two bodies, in 1/Pa, with G = E/(2(1 + ν))."""
    shear = [(m.young / (2 * (1 + m.poisson)), m.poisson) for m in materials]
    whole = sum(1 / (2 * math.pi * g) for g, _ in shear)
    return whole, sum(nu / (2 * math.pi * g) for g, nu in shear)


def dundurs_beta(materials: Collection[Material]) -> float:
    """Return Dundurs' β, the coupling of pressure and traction; 0 for bodies of one material."""
    whole, mixed = tangential_compliances(materials)
    one, other = ((1 + m.poisson) * (1 - 2 * m.poisson) / m.young for m in materials)
    return (one - other) / (2 * math.pi * (whole - mixed))


def coefficients(
    shape: tuple[int, int], spacing: tuple[float, float], compliances: tuple[float, float]
) -> Array:
    """Return uxx, uyy and uxy under a traction of 1 on one cell, shape (3, nx, ny), in m/Pa.

    Entry (i, j) belongs to the offset of (i, j) cells, counted round as a circular convolution of
    `shape` (nx, ny) needs it; cells have the edges `spacing` (m), bodies the compliances A and B
    (1/Pa). u is the displacement of one body less the displacement of the other. With [·] the sum
    over the corners of a cell, signs + − − +, and r² = x² + y²::

        uxx = A [y ln(x + r)] + (A − B) [x ln(y + r)],  uyy alike,  uxy = −B [r]

    References
    ----------
    Johnson, K. L. (1985), Contact Mechanics, section 3.6 (Cerruti), integrated over a rectangle.
    """
    # Corners lie half a cell off, so that none has x = 0 or y = 0.
    x, y = ((np.arange(n + 1) - n // 2 - 0.5) * d for n, d in zip(shape, spacing, strict=True))
    x, y = x[:, None], y[None, :]
    # arcsinh(x/|y|) is ln(x + r) less ln |y|, which the differences along x take out.
    along, across = y * np.arcsinh(x / np.abs(y)), x * np.arcsinh(y / np.abs(x))
    whole, less = compliances[0], compliances[0] - compliances[1]
    corners = [whole * along + less * across, less * along + whole * across]
    corners.append(-compliances[1] * np.hypot(x, y))
    return np.fft.ifftshift(np.diff(np.diff(corners, axis=1), axis=2), axes=(1, 2))


class Cerruti:
    """Two half-spaces under tangential traction that is constant in each cell, in free space.

    Parameters are as in `coefficients`, on a box that is padded; the components: 1 along x alone, 2
    both; and the displacement along x of a rig under a traction of 1 on one cell, in m/Pa.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        spacing: tuple[float, float],
        compliances: tuple[float, float],
        components: int = 2,
        rig: float = 0.0,
    ) -> None:
        self.shape, self.components, self.rig = shape, components, rig
        self._padded = tuple(scipy.fft.next_fast_len(2 * n - 1, real=True) for n in shape)
        kernels = coefficients((self._padded[0], self._padded[1]), spacing, compliances)
        # Even in both, or odd in both: the spectra are real.
        uxx, uyy, uxy = scipy.fft.rfft2(kernels).real
        self._spectra = np.array([[uxx, uxy], [uxy, uyy]])[:components, :components]
        # As of the normal displacement: 1/(πE*) is A − B, and here A − B/2 on average.
        whole, mixed = compliances
        self._symbols = HalfSpace(shape, spacing, 1 / (math.pi * (whole - 0.5 * mixed))).symbol()
        self.typical = float(np.mean(self._symbols))
        """A mean eigenvalue, in m/Pa."""
        self._symbols[0, 0] += rig * shape[0] * shape[1]

    def apply(self, traction: Array) -> Array:
        """Return the displacement (m) under a traction (Pa), both (components, nx, ny)."""
        nx, ny = self.shape
        modes = np.sum(self._spectra * scipy.fft.rfft2(traction, self._padded), axis=1)
        moved = scipy.fft.irfft2(modes, self._padded)[:, :nx, :ny]
        moved[0] += self.rig * np.sum(traction[0])
        return np.asarray(moved)

    def preconditioned(self, slip: Array) -> Array:
        """Return about the traction that gives a displacement, both (components, nx, ny)."""
        return np.asarray(scipy.fft.irfft2(scipy.fft.rfft2(slip) / self._symbols, self.shape))


cerruti = lru_cache(maxsize=16)(Cerruti)
"""`Cerruti`, kept for boxes that come again."""
