"""Wear that grows with a power of the pressure."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import ConfigDict

from tribo.core.fields import LocalConditions, WearRate
from tribo.core.units import Quantity
from tribo.interfaces.wear import WearLaw, WearLawConfig


class PowerConfig(WearLawConfig):
    """Configuration of `Power`."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [{"k": "3.11e-16 1/Pa", "p_exponent": 1.5, "reference_pressure": "1 GPa"}]
        }
    )

    type: Literal["power"] = "power"
    k: Annotated[float, Quantity("1/Pa", at_least=0, usual=(1e-22, 1e-10))]
    """Specific wear rate at the reference pressure."""
    p_exponent: Annotated[float, Quantity("1", at_least=1, at_most=10)]
    """Exponent m of the pressure; 1 is Archard's law. Below 1 the slope at p = 0 is infinite."""
    reference_pressure: Annotated[float, Quantity("Pa", above=0, usual=(1e2, 1e12))]
    """Pressure at which the law equals Archard's with the same k."""


class Power(WearLaw[PowerConfig]):
    """dh/ds = k p_ref (p/p_ref)^m.

    Valid where the exponent was fitted: it is a fit, not a mechanism.

    References
    ----------
    Rhee, S. K. (1970), Wear equation for polymers sliding against metal
    surfaces, Wear 16, 431-445.
    """

    Config = PowerConfig

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the rate, and m times the rate over p."""
        c = self.config
        ratio = local.pressure / c.reference_pressure
        slope = c.k * c.p_exponent * ratio ** (c.p_exponent - 1)
        return WearRate(c.k * c.reference_pressure * ratio**c.p_exponent, slope)
