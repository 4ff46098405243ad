"""What three levels of refinement say about the error: order, limit and uncertainty.

References
----------
I. B. Celik, U. Ghia, P. J. Roache, C. J. Freitas, H. Coleman, P. E. Raad,
"Procedure for estimation and reporting of uncertainty due to discretization in
CFD applications", J. Fluids Eng. 130 (2008) 078001; P. J. Roache, J. Fluids
Eng. 116 (1994) 405-413. Where the levels do not converge: L. Eça,
M. Hoekstra, J. Comput. Phys. 262 (2014) 104-130.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from scipy.optimize import brentq

Behaviour = Literal["exact", "converges", "oscillates", "diverges", "unrefined"]

SAFETY = 1.25
UNCONVERGED_SAFETY = 3.0
ROUND_OFF = 1e-10


@dataclass(frozen=True)
class Convergence:
    """The error of a quantity, from its values at three levels.

    Parameters
    ----------
    values : tuple of float
        From coarse to fine.
    behaviour : str
        "exact" if the values agree to round-off; "converges" if their
        differences shrink and keep their sign; "oscillates" if those change
        it; "diverges" if they do not shrink; "unrefined" if the sizes do not
        fall, whatever the values do.
    order : float or None
        Observed order; only of what converges.
    limit : float or None
        Value extrapolated with it.
    gci : float or None
        Grid convergence index of the finest level, relative to its value.
    uncertainty : float
        Of the value at the case's own level, in its unit.
    """

    values: tuple[float, float, float]
    behaviour: Behaviour
    order: float | None
    limit: float | None
    gci: float | None
    uncertainty: float


def convergence(
    values: Sequence[float], sizes: Sequence[float], *, formal_order: float, own: int = -1
) -> Convergence:
    """Estimate the error of discretisation.

    With the values φ₃, φ₂, φ₁ from coarse to fine, the ratios of cell sizes
    r₂₁, r₃₂ and the differences ε₂₁ = φ₂ − φ₁, ε₃₂ = φ₃ − φ₂ (Celik et al.)::

        p = |ln|ε₃₂/ε₂₁| + ln((r₂₁ᵖ − 1)/(r₃₂ᵖ − 1))| / ln r₂₁
        φ_limit = (r₂₁ᵖ φ₁ − φ₂)/(r₂₁ᵖ − 1)
        GCI = 1.25 |(φ₁ − φ₂)/φ₁| / (r₂₁ᵖ − 1)

    An order above the formal one is a chance of the three values, and the
    formal one is used with them. The uncertainty is 1.25 |φ − φ_limit| at the
    case's own level, which is GCI times φ₁ at the finest. Values that
    oscillate have no order: the uncertainty is their range. Of values that do
    not converge, or of levels that are no refinement, it is three times that.

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

    Returns
    -------
    Convergence
    """
    coarse, middle, fine = values
    spread = max(values) - min(values)
    three = (coarse, middle, fine)
    if not sizes[0] > sizes[1] > sizes[2]:
        return Convergence(three, "unrefined", None, None, None, UNCONVERGED_SAFETY * spread)
    if spread <= ROUND_OFF * max(map(abs, values)):
        return Convergence(three, "exact", None, None, 0.0, 0.0)
    rough, close = coarse - middle, middle - fine
    if rough * close < 0 or close == 0:
        return Convergence(three, "oscillates", None, None, None, spread)
    order = _observed_order(rough, close, sizes)
    if order is None:
        return Convergence(three, "diverges", None, None, None, UNCONVERGED_SAFETY * spread)
    gain = (sizes[1] / sizes[2]) ** min(order, formal_order) - 1
    limit = fine - close / gain
    gci = SAFETY * abs(close) / gain / abs(fine) if fine != 0 else None
    uncertainty = SAFETY * abs(values[own] - limit)
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
