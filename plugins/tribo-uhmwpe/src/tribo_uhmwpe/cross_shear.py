"""Wear of polyethylene that follows the directions in which each point has been slid over."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from tribo import Field, LocalConditions, Quantity, WearLaw, WearRate

FRESH = 1e-9
"""Path (m) up to which nothing has slid over a point to speak of: there its share is 0."""
PATH = Field("slid_path", "m", "Path slid under pressure.", at_least=0, breaks=(FRESH,))
COSINE = Field("slid_cosine", "m", "Integral of cos 2θ along that path, with its heading θ.")
SINE = Field("slid_sine", "m", "Integral of sin 2θ along that path, with its heading θ.")


class CrossShear(WearLaw):
    """dh/ds = (k_along + (k_across − k_along) χ) p, with the cross-shear share χ of each point.

    χ = (1 − √(C² + S²)/s)/2 is the share of the path s that a point has been slid over across its
    principal direction, with C and S the integrals of cos 2θ and sin 2θ along s: the smaller
    eigenvalue of ∫ t tᵀ ds over its trace, t being the direction. It is 0 on a straight path, 1/3
    round a rectangle twice as long as wide, 1/2 round a circle; and 0 at a point that nothing has
    slid over yet. The chains of the polymer turn to the principal direction and resist along it: at
    an angle α to it wear goes by k_along cos² α + k_across sin² α, whose mean is the law.

    Valid where a point is slid over many times and always in the same way, under a pressure near
    the pressure of the test of both rates: UHMWPE wears less per load as the pressure grows. s
    counts from the start and never forgets, so that χ lags behind a changing principal direction.
    On a body that is averaged along a track χ belongs to the mean over the track.

    References
    ----------
    Schwenke, T., Wimmer, M. A. (2013), Cross-shear in metal-on-polyethylene articulation of
    orthopaedic implants and its relationship to wear, Wear 301, 168-174: work to remove a volume
    6.4 times as large along as across. Wang, A. (2001), A unified theory of wear for ultra-high
    molecular weight polyethylene in multi-directional sliding, Wear 248, 38-47.

    Examples
    --------
    >>> from tribo_uhmwpe.cross_shear import CrossShear
    >>> law = CrossShear(k_along="1e-6 mm^3/(N m)", k_across="6.4e-6 mm^3/(N m)")
    >>> path, zero = np.ones(2), np.zeros(2)  # 1 m straight, and 1 m round a circle
    >>> state = {"slid_path": path, "slid_cosine": np.array([1.0, 0.0]), "slid_sine": zero}
    >>> heading = {"heading_x": path, "heading_y": zero}
    >>> local = tribo.LocalConditions(5e6 * path, 0.1, tribo.materials["UHMWPE"], heading, state)
    >>> (1e9 * law.rate(local).depth_rate).round(2).tolist()  # in nm per metre of sliding
    [5.0, 18.5]
    """

    examples = ({"k_along": "1e-6 mm^3/(N m)", "k_across": "6.4e-6 mm^3/(N m)"},)
    type = "uhmwpe.cross_shear"
    k_along: Annotated[float, Quantity("1/Pa", at_least=0, usual=(1e-22, 1e-10))]
    """Specific wear rate along the principal direction, as on a straight path."""
    k_across: Annotated[float, Quantity("1/Pa", at_least=0, usual=(1e-22, 1e-10))]
    """Specific wear rate across it: twice the rate on a circle less `k_along`."""

    requires = ("heading_x", "heading_y")
    state_fields = (PATH, COSINE, SINE)

    def rate(self, local: LocalConditions) -> WearRate:
        """Return k p and k; the states grow where the pressure does not vanish."""
        path = local.state[PATH.name]
        along = np.hypot(local.state[COSINE.name], local.state[SINE.name])
        straight = np.divide(along, path, out=np.ones_like(path), where=path >= FRESH)
        share = 0.5 * np.maximum(1.0 - straight, 0.0)
        k = self.k_along + (self.k_across - self.k_along) * share
        slides = (local.pressure > 0).astype(float)
        x, y = local.fields["heading_x"], local.fields["heading_y"]
        moments = {COSINE.name: slides * (x**2 - y**2), SINE.name: slides * 2 * x * y}
        return WearRate(k * local.pressure, k, {PATH.name: slides, **moments})
