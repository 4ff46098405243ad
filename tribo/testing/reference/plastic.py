"""Loads at which a sphere on a flat first yields, and first reaches the pressure cap.

References
----------
K. L. Johnson (1985), Contact Mechanics, sections 6.1 (first yield at
p0 = 1.60 Y for ν = 0.3, below the surface) and 6.3 (hardness near 2.8 Y).
"""

from __future__ import annotations

import math

FIRST_YIELD = 1.60
"""Hertz peak pressure over yield strength at first yield, for ν = 0.3."""

CONSTRAINT = 2.8
"""Hardness over yield strength."""


def load_at_peak_pressure(peak_pressure: float, radius: float, modulus: float) -> float:
    """Load that gives a Hertzian point contact this peak pressure.

    F = π³R²p0³/6E*².

    Parameters
    ----------
    peak_pressure : float
        Peak pressure p0, in Pa.
    radius : float
        Effective radius R, in m.
    modulus : float
        Contact modulus E*, in Pa.

    Returns
    -------
    float
        Load, in N.
    """
    return math.pi**3 * radius**2 * peak_pressure**3 / (6.0 * modulus**2)


def cap_onset_load(hardness: float, radius: float, modulus: float) -> float:
    """Load at which the Hertz pressure reaches the cap, p0 = H.

    A model that caps the pressure at H is elastic below this load.

    Parameters
    ----------
    hardness : float
        Hardness H, in Pa.
    radius, modulus : float
        As for `load_at_peak_pressure`.

    Returns
    -------
    float
        Load, in N.
    """
    return load_at_peak_pressure(hardness, radius, modulus)


def first_yield_load(hardness: float, radius: float, modulus: float) -> float:
    """Load at which the material first yields, p0 = 1.60 Y with Y = H/2.8.

    It is (1.60/2.8)³ = 0.187 of `cap_onset_load`: a capped model starts to flow
    late.

    Parameters
    ----------
    hardness : float
        Hardness H, in Pa.
    radius, modulus : float
        As for `load_at_peak_pressure`.

    Returns
    -------
    float
        Load, in N.
    """
    return load_at_peak_pressure(FIRST_YIELD * hardness / CONSTRAINT, radius, modulus)
