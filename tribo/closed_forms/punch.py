"""A rigid, flat-ended circular punch on an elastic half-space.

References
----------
I. N. Sneddon (1965), Int. J. Eng. Sci. 3, 47-57; K. L. Johnson (1985),
Contact Mechanics, section 3.4.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from tribo.core.arrays import Array


def approach(load: float, radius: float, modulus: float) -> float:
    """Approach of the punch, δ = F/2E*a, in m.

    Parameters
    ----------
    load, radius, modulus : float
        Normal load F, in N; radius a of the punch, in m; contact modulus E*, in Pa.
    """
    return load / (2.0 * modulus * radius)


def pressure(r: ArrayLike, load: float, radius: float) -> Array:
    """Pressure under the punch, p = F/[2πa²√(1 − r²/a²)].

    Parameters
    ----------
    r : array_like
        Distance from the axis, in m.
    load, radius : float
        As for `approach`.

    Returns
    -------
    ndarray
        Pressure, in Pa, shaped like `r`; infinite at r = a, 0 beyond.
    """
    inside = 1.0 - (np.asarray(r, dtype=float) / radius) ** 2
    mean = load / (np.pi * radius**2)
    with np.errstate(divide="ignore"):
        value = 0.5 * mean / np.sqrt(np.maximum(inside, 0.0))
    return np.where(inside < 0.0, 0.0, value)
