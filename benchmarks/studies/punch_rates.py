r"""Rates at which a flat punch on an elastic half-space wears to an even pressure.

    python -m benchmarks.studies.punch_rates

Worn by Archard's law and held level, the punch keeps u + w = δ(s), with
u = Kp/E* and dw/ds = kp. What is left of the first pressure beside the mean
decays in modes exp(−λ kE*s/a), whose shapes φ have mean zero and

    K φ = (a/λ) φ + constant        on the punch.

Both kernels are expanded in products of the polynomials that diagonalise them
with the punch's own singular weight, and taken between Legendre polynomials:
the series falls as n⁻⁵.

References
----------
L. A. Galin (1976), Komogortsev (1985) and I. G. Goryacheva (1998),
Contact Mechanics in Tribology, on the wear of punches. The expansions:
K. L. Johnson (1985), Contact Mechanics, section 2.7 (strip), and G. Ya. Popov
(1963), J. Appl. Math. Mech. 27 (disc).
"""

from __future__ import annotations

import numpy as np
import scipy.linalg
import scipy.special
from numpy.polynomial import chebyshev, legendre

from tribo.core.arrays import Array

_SERIES = 200
_SHAPES = 24


def strip_rates(*, odd: bool = False) -> tuple[float, ...]:
    """Decay rates of an infinitely long strip of half-width a.

    With −ln|x − t| = ln 2 + Σ (2/n) Tₙ(x) Tₙ(t) on −1 < x, t < 1.

    Parameters
    ----------
    odd : bool, optional
        Whether the pressure is odd across the strip, whose tilt is held.

    Returns
    -------
    tuple of float
        λ, rising; the first few are good to six digits.
    """
    x, weight = scipy.special.roots_legendre(2 * _SERIES)
    n = np.arange(1 if odd else 2, _SERIES, 2)
    shapes = np.arange(1 if odd else 2, 2 * _SHAPES, 2)
    modes = chebyshev.chebvander(x, _SERIES)[:, n]
    tests = legendre.legvander(x, 2 * _SHAPES)[:, shapes]
    overlap = (weight[:, None] * modes).T @ tests
    # K is −(2/π) ∫ p ln|x − t| dt.
    kernel = overlap.T @ ((4 / (np.pi * n))[:, None] * overlap)
    return _rates(kernel, 2 / (2 * shapes + 1))


def disc_rates() -> tuple[float, ...]:
    """Decay rates of a disc of radius a, under pressures symmetric about its axis.

    With ρ = √(1 − r²/a²) the kernel 1/(π|x − y|) is Σ γₙ P₂ₙ(ρ) P₂ₙ(ρ′)/hₙ,
    γₙ = π [(2n)!/(4ⁿ n!²)]² and hₙ = 2π/(4n + 1).

    Returns
    -------
    tuple of float
        λ, rising; the first few are good to six digits.
    """
    x, weight = scipy.special.roots_legendre(2 * _SERIES)
    rho, weight = 0.5 * (x + 1), 0.5 * weight
    n = np.arange(_SERIES)
    ratio = np.concatenate(([1.0], np.cumprod((2 * n[1:] - 1) / (2 * n[1:]))))
    shapes = np.arange(1, _SHAPES)
    modes = legendre.legvander(rho, 2 * _SERIES)[:, 2 * n]
    tests = legendre.legvander(2 * rho**2 - 1, _SHAPES)[:, shapes]
    # dA = 2π r dr = 2π ρ dρ.
    overlap = (2 * np.pi * (rho * weight)[:, None] * modes).T @ tests
    kernel = overlap.T @ ((0.5 * ratio**2 * (4 * n + 1))[:, None] * overlap)
    return _rates(kernel, np.pi / (2 * shapes + 1))


def _rates(kernel: Array, mass: Array) -> tuple[float, ...]:
    compliance = scipy.linalg.eigh(kernel, np.diag(mass), eigvals_only=True)
    return tuple(float(1.0 / value) for value in compliance[::-1])


if __name__ == "__main__":
    print("disc", *disc_rates()[:3])
    print("strip, even", *strip_rates()[:2])
    print("strip, odd", *strip_rates(odd=True)[:2])
