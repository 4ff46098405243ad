"""Hertz's contact of smooth elastic bodies: point, line and the onset of yield.

Valid while the contact is small beside the radii of curvature, and without friction.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log, pi, sqrt

import scipy


@dataclass(frozen=True)
class PointContact:
    """An elliptic contact, p = p0 √(1 − x²/a² − y²/b²)."""

    semi_axes: tuple[float, float]
    """a along x and b along y, in m."""
    peak_pressure: float
    """p0, in Pa."""
    approach: float
    """In m."""


@dataclass(frozen=True)
class LineContact:
    """A strip of contact, p = p0 √(1 − x²/b²).

    Its approach depends on the size of the bodies and has no value here.
    """

    half_width: float
    """b, in m."""
    peak_pressure: float
    """p0, in Pa."""


def point(modulus: float, load: float, curvature_x: float, curvature_y: float) -> PointContact:
    """Return the contact across the gap ½ (cx x² + cy y²).

    Parameters
    ----------
    modulus, load : float
        Contact modulus E*, in Pa, and normal load, in N.
    curvature_x, curvature_y : float
        Curvatures of the gap along x and y, in 1/m; positive. A ball of
        radius R on a flat has 1/R for both.

    Raises
    ------
    ValueError
        If an argument is not positive.

    References
    ----------
    K. L. Johnson, Contact Mechanics (1985), section 4.2; the elliptic integrals
    in Carlson's symmetric form, in which the circle is no special case.
    """
    _require_positive(modulus=modulus, load=load, curvature_x=curvature_x, curvature_y=curvature_y)
    wanted = log(curvature_y / curvature_x)

    def excess(log_ratio: float) -> float:
        squared = exp(2 * log_ratio)
        x, y = scipy.special.elliprd(0, [squared, 1], [1, squared])
        return log(y / x) - wanted

    # b/a lies between 1 and cx/cy, to which it tends for slender ellipses.
    log_ratio = 0.0
    if wanted != 0.0:
        log_ratio = float(
            scipy.optimize.brentq(excess, -abs(wanted), abs(wanted), xtol=1e-15, rtol=1e-15)
        )
    ratio = exp(log_ratio)
    a = float(
        (load * scipy.special.elliprd(0, ratio**2, 1) / (pi * modulus * curvature_x)) ** (1 / 3)
    )
    b = ratio * a
    return PointContact(
        semi_axes=(a, b),
        peak_pressure=3 * load / (2 * pi * a * b),
        approach=float(3 * load * scipy.special.elliprf(0, 1, ratio**2) / (2 * pi * modulus * a)),
    )


def line(modulus: float, load_per_length: float, curvature: float) -> LineContact:
    """Return the contact across the gap ½ c x².

    Parameters
    ----------
    modulus, load_per_length : float
        Contact modulus E*, in Pa, and load per length, in N/m.
    curvature : float
        In 1/m; positive. A cylinder of radius R on a flat has 1/R.

    Raises
    ------
    ValueError
        If an argument is not positive.

    References
    ----------
    K. L. Johnson, Contact Mechanics (1985), section 4.2(c).
    """
    _require_positive(modulus=modulus, load_per_length=load_per_length, curvature=curvature)
    return LineContact(
        half_width=sqrt(4 * load_per_length / (pi * modulus * curvature)),
        peak_pressure=sqrt(load_per_length * modulus * curvature / pi),
    )


def first_yield_pressure(hardness: float, *, line: bool = False) -> float:
    """Return the Hertzian peak pressure, in Pa, at which yield begins below the surface.

    Parameters
    ----------
    hardness : float
        H, in Pa; the yield stress is taken as Y = H/2.8.
    line : bool, optional
        Whether it is a line contact, which yields in plane strain.

    References
    ----------
    K. L. Johnson, Contact Mechanics (1985), section 6.1: p0 = 1.60 Y for a ball, and by von
    Mises' criterion 1.79 Y for a cylinder (ν = 0.3); section 6.3: fully plastic indentation
    at H ≈ 2.8 Y.
    """
    return (1.79 if line else 1.60) * hardness / 2.8


def _require_positive(**values: float) -> None:
    for name, value in values.items():
        if not value > 0:
            raise ValueError(f"{name} is {value:g}; it must be positive")
