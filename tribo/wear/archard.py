"""Archard's law: depth is proportional to pressure and sliding distance."""

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

    Valid for mild sliding wear in a steady regime: k independent of pressure,
    speed and history.

    References
    ----------
    Archard, J. F. (1953), Contact and rubbing of flat surfaces, J. Appl. Phys.
    24, 981-988. Holm, R. (1958), Electric Contacts Handbook, Springer.
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
