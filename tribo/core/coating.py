"""An elastic layer on a body."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tribo.core.arrays import Array
from tribo.core.material import Material


@dataclass(frozen=True)
class Coating:
    """A layer of one material bonded to a half-space of another.

    Parameters
    ----------
    thickness : float
        Thickness of the layer, in m.
    layer, base : Material
        Materials of the layer, and of the body below it.

    References
    ----------
    T. C. O'Sullivan, R. B. King, "Sliding contact stress field due to a spherical indenter on a
    layered elastic half-space", J. Tribol. 110 (1988) 235-240; T. Nogi, T. Kato, J. Tribol. 119
    (1997) 493-500.

    Examples
    --------
    >>> hard = tribo.Material(young="300 GPa", poisson=0.2)
    >>> coating = tribo.Coating(thickness=2e-6, layer=hard, base=tribo.materials["100Cr6"])
    >>> long, short = coating.influence(2 * np.pi / np.array([1e-3, 1e-6]))
    >>> round(float(long), 2), round(float(short), 2)  # 1 mm long waves reach the base
    (0.35, 0.0)
    """

    thickness: float
    layer: Material
    base: Material

    @cached_property
    def modulus(self) -> float:
        """Plane-strain modulus E/(1 − ν²) of the layer, in Pa."""
        return self.layer.young / (1 - self.layer.poisson**2)

    def influence(self, wavenumber: Array) -> Array:
        """Return the influence of the base on the displacement of a half-space of the layer.

        A wave of pressure of amplitude 1 and wavenumber q displaces the surface by
        2 (1 + influence)/(E′ q), with E′ the layer's `modulus`. It is 0 for a thick layer
        and E′/E′_base − 1 for a thin one.

        Parameters
        ----------
        wavenumber : ndarray
            q, in 1/m; not negative.
        """
        xi = wavenumber * self.thickness
        nu, base_nu = self.layer.poisson, self.base.poisson
        mu = self.layer.young / (1 + nu) / (self.base.young / (1 + base_nu))
        lam = 1 - 4 * (1 - nu) / (1 + mu * (3 - 4 * base_nu))
        kap = (mu - 1) / (mu + 3 - 4 * nu)
        decay = np.exp(-2 * xi)
        above = 4 * xi * kap * decay - lam * kap * decay**2
        below = -(lam + kap + 4 * kap * xi**2) * decay + lam * kap * decay**2
        return (above - below) / (1 + below)
