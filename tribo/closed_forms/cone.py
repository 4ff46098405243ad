"""A rigid cone on an elastic half-space.

α is the angle between the axis and the flank; a blunt cone has α near π/2,
where half-space theory holds.

References
----------
I. N. Sneddon (1965), Int. J. Eng. Sci. 3, 47-57; K. L. Johnson (1985),
Contact Mechanics, section 5.2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from tribo.core.arrays import Array


@dataclass(frozen=True)
class ConeContact:
    """A cone in contact."""

    half_width: float
    """Contact radius, in m."""
    mean_pressure: float
    """Load over contact area, in Pa; it does not depend on the load."""
    approach: float
    """Rigid approach, in m."""


def cone(load: float, semi_angle: float, modulus: float) -> ConeContact:
    """Press a cone on a half-space.

    F = ½πE*a² cot α, δ = ½πa cot α, mean pressure ½E* cot α.

    Parameters
    ----------
    load, semi_angle, modulus : float
        Normal load F, in N; angle α between axis and flank, in rad; contact modulus E*, in Pa.
    """
    cot = 1.0 / math.tan(semi_angle)
    mean = 0.5 * modulus * cot
    a = math.sqrt(load / (math.pi * mean))
    return ConeContact(a, mean, 0.5 * math.pi * a * cot)


def pressure(r: ArrayLike, load: float, semi_angle: float, modulus: float) -> Array:
    """Pressure under the cone, p = ½E* cot α arcosh(a/r).

    Parameters
    ----------
    r : array_like
        Distance from the axis, in m.
    load, semi_angle, modulus : float
        As for `cone`.

    Returns
    -------
    ndarray
        Pressure, in Pa, shaped like `r`; infinite on the axis, 0 outside the contact.
    """
    contact = cone(load, semi_angle, modulus)
    with np.errstate(divide="ignore"):
        ratio = contact.half_width / np.abs(np.asarray(r, dtype=float))
    return np.asarray(contact.mean_pressure * np.arccosh(np.maximum(ratio, 1.0)))
