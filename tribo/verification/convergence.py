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
from typing import Literal

from scipy.optimize import brentq

from tribo.core.rounding import ROUND_OFF

Behaviour = Literal[
    "exact", "converges", "not asymptotic", "oscillates", "scatters", "diverges", "unrefined"
]

SAFETY, DOUBTFUL_SAFETY = 1.25, 3.0


@dataclass(frozen=True)
class Convergence:
    """The error of a quantity, from its values at three levels."""

    values: tuple[float, float, float]
    """From coarse to fine."""
    behaviour: Behaviour
    """`exact` if the values agree to round-off; `converges` if their differences shrink and keep
    their sign; `not asymptotic` if they do so at an order far from the formal one; `oscillates` if
    the sign changes; `diverges` if they do not shrink, and `scatters` if nor do they exceed the
    scatter of such values; `unrefined` if the sizes do not fall, whatever the values do."""
    order: float | None = None
    """Observed order; only of what converges, or is not asymptotic."""
    limit: float | None = None
    """Value extrapolated with it; only of what converges."""
    gci: float | None = None
    """Grid convergence index of the finest level, relative to its value; of what converges."""
    uncertainty: float | None = None
    """Of the value at the case's own level, in its unit; None of what diverges."""


def convergence(
    values: Sequence[float],
    sizes: Sequence[float],
    *,
    formal_order: float,
    own: int = -1,
    scatter: float = 0.0,
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
    level, which is GCI times φ₁ at the finest. A p below half of the formal
    order, or more than 1 above it, says that the levels are not in the
    asymptotic range, and that nothing can be extrapolated: the uncertainty is
    three times the range of the values, as of those that oscillate or scatter,
    and of levels that are no refinement (Eça & Hoekstra). Of values that
    diverge no range bounds the error, and there is none.

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
    scatter : float, optional
        Range of the values, in their unit, that is no sign of divergence; 1 %
        of the largest if that is more.
    """
    coarse, middle, fine = three = values[0], values[1], values[2]
    spread = max(values) - min(values)

    def doubtful(behaviour: Behaviour, order: float | None = None) -> Convergence:
        return Convergence(three, behaviour, order, uncertainty=DOUBTFUL_SAFETY * spread)

    if not sizes[0] > sizes[1] > sizes[2]:
        return doubtful("unrefined")
    if spread <= ROUND_OFF * max(map(abs, values)):
        return Convergence(three, "exact", gci=0.0, uncertainty=0.0)
    rough, close = coarse - middle, middle - fine
    if rough * close < 0 or close == 0:
        return doubtful("oscillates")
    order = _observed_order(rough, close, sizes)
    if order is None:
        if spread <= max(scatter, 0.01 * max(map(abs, values))):
            return doubtful("scatters")
        return Convergence(three, "diverges")
    if not 0.5 * formal_order <= order <= formal_order + 1:
        return doubtful("not asymptotic", order)
    safety = SAFETY if abs(order - formal_order) <= 0.1 * formal_order else DOUBTFUL_SAFETY
    gain = (sizes[1] / sizes[2]) ** min(order, formal_order) - 1
    limit = fine - close / gain
    gci = safety * abs(close) / gain / abs(fine) if fine != 0 else None
    uncertainty = safety * abs(values[own] - limit)
    return Convergence(three, "converges", order, limit, gci, uncertainty)


def _observed_order(rough: float, close: float, sizes: Sequence[float]) -> float | None:
    """Return p of ε₃₂/ε₂₁ = r₂₁ᵖ (r₃₂ᵖ − 1)/(r₂₁ᵖ − 1), or None if there is no positive one."""
    r32, r21 = sizes[0] / sizes[1], sizes[1] / sizes[2]
    if rough == 0:
        return None

    def excess(p: float) -> float:
        return math.log(rough / close) - p * math.log(r21) - math.log((r32**p - 1) / (r21**p - 1))

    low, high = 1e-3, 50.0
    if excess(low) <= 0:
        return None
    return high if excess(high) >= 0 else float(brentq(excess, low, high))
