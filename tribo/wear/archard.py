"""Archard's law, and wear that grows with a power of the pressure."""

from __future__ import annotations

from typing import Annotated, Self

import numpy as np
from pydantic import model_validator

from tribo.core.errors import CaseError
from tribo.core.fields import LocalConditions, WearRate
from tribo.core.material import Material
from tribo.core.units import Quantity
from tribo.wear.law import WearLaw


class Archard(WearLaw):
    """dh/ds = k p, with k = K/H: equations 1 and 2 of Andersson, Almqvist & Larsson (2010).

    Valid for mild sliding wear in a steady regime: k independent of pressure, speed and history.

    References
    ----------
    Archard, J. F. (1953), Contact and rubbing of flat surfaces, J. Appl. Phys.
    24, 981-988. Holm, R. (1958), Electric Contacts Handbook, Springer.

    Examples
    --------
    >>> local = tribo.LocalConditions(np.array([1e9]), 0.1, tribo.Material(name="100Cr6"))
    >>> law = tribo.Archard(k="1e-6 mm^3/(N m)")
    >>> law.rate(local).depth_rate.round(9).tolist()  # 1 µm a metre under 1 GPa
    [1e-06]
    """

    examples = ({"k": "3.11e-16 1/Pa"}, {"K": 1e-6, "hardness": "4 GPa"})
    type = "archard"
    k: Annotated[float, Quantity("1/Pa", at_least=0, usual=(1e-22, 1e-10))] | None = None
    """Specific wear rate, volume per load and sliding distance."""
    K: Annotated[float, Quantity("1", at_least=0, usual=(1e-12, 1.0))] | None = None
    """Archard's dimensionless wear coefficient; k = K/H."""
    hardness: Annotated[float, Quantity("Pa", above=0, usual=(1e4, 2e11))] | None = None
    """Hardness H for ``K``; the material's hardness if left out."""

    @model_validator(mode="after")
    def _one_coefficient(self) -> Self:
        if (self.k is None) == (self.K is None):
            raise ValueError("give exactly one of k (1/Pa) and K (dimensionless)")
        if self.k is not None and self.hardness is not None:
            raise ValueError("hardness goes with K; k does not use it")
        return self

    def check(self, material: Material) -> None:
        """Require a hardness where only K is given."""
        self._coefficient(material)

    def rate(self, local: LocalConditions) -> WearRate:
        """Return k p and k."""
        k = self._coefficient(local.material)
        return WearRate(k * local.pressure, np.full_like(local.pressure, k))

    def _coefficient(self, material: Material) -> float:
        if self.k is not None:
            return self.k
        hardness = self.hardness or material.hardness
        if hardness is None or self.K is None:
            raise CaseError(
                "K needs a hardness: add hardness here or to the body's material, or give k"
            )
        return self.K / hardness


class Power(WearLaw):
    """dh/ds = k p_ref (p/p_ref)^m.

    Valid where the exponent was fitted: it is a fit, not a mechanism.

    References
    ----------
    Rhee, S. K. (1970), Wear equation for polymers sliding against metal
    surfaces, Wear 16, 431-445.

    Examples
    --------
    >>> local = tribo.LocalConditions(np.array([1e9, 2e9]), 0.1, tribo.Material(name="100Cr6"))
    >>> law = tribo.Power(k="1e-15 1/Pa", p_exponent=2, reference_pressure="1 GPa")
    >>> law.rate(local).depth_rate.round(9).tolist()  # four times as fast under twice the pressure
    [1e-06, 4e-06]
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
