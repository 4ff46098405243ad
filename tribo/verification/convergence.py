"""What three levels of refinement say about the error: order, limit and uncertainty.

References
----------
I. B. Celik, U. Ghia, P. J. Roache, C. J. Freitas, H. Coleman, P. E. Raad,
"Procedure for estimation and reporting of uncertainty due to discretization in
CFD applications", J. Fluids Eng. 130 (2008) 078001; P. J. Roache, J. Fluids
Eng. 116 (1994) 405-413. The limits of the order and the two factors of safety:
W. L. Oberkampf, C. J. Roy, "Verification and Validation in Scientific
Computing" (2010), section 8.6. Where the levels do not converge: L. Eça,
M. Hoekstra, J. Comput. Phys. 262 (2014) 104-130.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from scipy.optimize import brentq

SAFETY, DOUBTFUL_SAFETY = 1.25, 3.0
"""Factors on the estimated error where the observed order is near the formal one, and elsewhere:
Oberkampf & Roy (2010), section 8.6."""


@dataclass(frozen=True)
class Convergence:
    """The error of a quantity, from its values at three levels."""

    values: tuple[float, float, float]
    """From coarse to fine."""
    uncertainty: float
    """Of the value at the case's own level, in its unit."""
    order: float | None = None
    """Observed order; None, as are limit and gci, where the values do not converge."""
    limit: float | None = None
    """Value extrapolated with it."""
    gci: float | None = None
    """Grid convergence index of the finest level, relative to its value."""


def convergence(
    values: Sequence[float], sizes: Sequence[float], *, formal_order: float, own: int = -1
) -> Convergence:
    """Estimate the error of discretisation.

    With the values φ₃, φ₂, φ₁ from coarse to fine, the ratios of cell sizes
    r₂₁, r₃₂ and the differences ε₂₁ = φ₂ − φ₁, ε₃₂ = φ₃ − φ₂ (Celik et al.)::

        p = |ln|ε₃₂/ε₂₁| + ln((r₂₁ᵖ − 1)/(r₃₂ᵖ − 1))| / ln r₂₁
        φ_limit = (r₂₁ᵖ φ₁ − φ₂)/(r₂₁ᵖ − 1)
        GCI = F |(φ₁ − φ₂)/φ₁| / (r₂₁ᵖ − 1)

    The factor F is 1.25 if p is within 10 % of the formal order, and 3
    otherwise; of a p above the formal order, the formal one is used
    (Oberkampf & Roy). The uncertainty is F |φ − φ_limit| at the case's own
    level, which is GCI times φ₁ at the finest. Without a p between half of the
    formal order and 1 above it the values do not converge, and the uncertainty
    is three times their range (Eça & Hoekstra).

    Parameters
    ----------
    values : sequence of float
        Three, from coarse to fine.
    sizes : sequence of float
        Of cells or steps at these levels, in any unit.
    formal_order : float
        Order of the method.
    own : int, optional
        Index of the level whose uncertainty is wanted; the finest if left out.
    """
    coarse, middle, fine = three = values[0], values[1], values[2]
    close = middle - fine
    order = _observed_order(coarse - middle, close, sizes)
    if order is None or not 0.5 * formal_order <= order <= formal_order + 1:
        return Convergence(three, DOUBTFUL_SAFETY * (max(values) - min(values)))
    safety = SAFETY if abs(order - formal_order) <= 0.1 * formal_order else DOUBTFUL_SAFETY
    gain = (sizes[1] / sizes[2]) ** min(order, formal_order) - 1
    limit = fine - close / gain
    gci = safety * abs(close) / gain / abs(fine) if fine != 0 else None
    return Convergence(three, safety * abs(values[own] - limit), order, limit, gci)


def _observed_order(rough: float, close: float, sizes: Sequence[float]) -> float | None:
    """Return p of ε₃₂/ε₂₁ = r₂₁ᵖ (r₃₂ᵖ − 1)/(r₂₁ᵖ − 1), or None if there is no positive one."""
    if not (sizes[0] > sizes[1] > sizes[2] and rough * close > 0):
        return None
    r32, r21 = sizes[0] / sizes[1], sizes[1] / sizes[2]

    def excess(p: float) -> float:
        return math.log(rough / close) - p * math.log(r21) - math.log((r32**p - 1) / (r21**p - 1))

    low, high = 1e-3, 50.0
    found = excess(low) > 0 > excess(high)
    return float(brentq(excess, low, high)) if found else None
