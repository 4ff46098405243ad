"""A uniform pressure on a disc of an elastic half-space.

References
----------
A. E. H. Love (1929), Phil. Trans. R. Soc. A 228, 377-420; K. L. Johnson
(1985), Contact Mechanics, section 3.4.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipe, ellipk

from tribo.core.arrays import Array


def displacement(r: ArrayLike, pressure: float, radius: float, modulus: float) -> Array:
    """Displacement of the surface inside and outside the disc.

    With complete elliptic integrals E(m), K(m) of the parameter m = modulus²::

        u = (4pa/πE*) E(r²/a²)                              r ≤ a
        u = (4pr/πE*) [E(a²/r²) − (1 − a²/r²) K(a²/r²)]     r > a

    that is 2pa/E* at the centre and 4pa/πE* at the edge.

    Parameters
    ----------
    r : array_like
        Distance from the axis, in m.
    pressure, radius, modulus : float
        Uniform pressure p, in Pa; radius a of the disc, in m; contact modulus E*, in Pa.

    Returns
    -------
    ndarray
        Normal displacement, in m, shaped like `r`.
    """
    t = np.abs(np.asarray(r, dtype=float)) / radius
    far = np.maximum(t, 1.0)
    m = 1.0 / far**2
    # K diverges at the edge, where its factor vanishes faster.
    tail = np.where(m < 1.0, (1.0 - m) * ellipk(np.where(m < 1.0, m, 0.0)), 0.0)
    shape = np.where(t <= 1.0, ellipe(np.minimum(t, 1.0) ** 2), far * (ellipe(m) - tail))
    return np.asarray(4.0 * pressure * radius / (np.pi * modulus) * shape)
