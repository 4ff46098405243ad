"""Wear that grows with a power of the pressure."""

from __future__ import annotations

from typing import Annotated

from tribo.core.fields import LocalConditions, WearRate
from tribo.core.units import Quantity
from tribo.wear.law import WearLaw


class Power(WearLaw):
    """dh/ds = k p_ref (p/p_ref)^m.

    Valid where the exponent was fitted: it is a fit, not a mechanism.

    References
    ----------
    Rhee, S. K. (1970), Wear equation for polymers sliding against metal
    surfaces, Wear 16, 431-445.
    """

    examples = ({"k": "3.11e-16 1/Pa", "p_exponent": 1.5, "reference_pressure": "1 GPa"},)
    type = "power"
    k: Annotated[float, Quantity("1/Pa", at_least=0, usual=(1e-22, 1e-10))]
    """Specific wear rate at the reference pressure."""
    p_exponent: Annotated[float, Quantity("1", at_least=1, at_most=10)]
    """Exponent m of the pressure; 1 is Archard's law. Below 1 the slope at p = 0 is infinite."""
    reference_pressure: Annotated[float, Quantity("Pa", above=0, usual=(1e2, 1e12))]
    """Pressure at which the law equals Archard's with the same k."""

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the rate, and m times the rate over p."""
        ratio = local.pressure / self.reference_pressure
        slope = self.k * self.p_exponent * ratio ** (self.p_exponent - 1)
        return WearRate(self.k * self.reference_pressure * ratio**self.p_exponent, slope)
