"""Archard's law with a coefficient that follows Arrhenius' law."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from tribo import LocalConditions, Quantity, WearLaw, WearRate

from tribo_thermal.flash import TEMPERATURE

GAS_CONSTANT = 8.314462618
"""In J/(mol K), exact since the SI of 2019."""


class Arrhenius(WearLaw):
    """dh/ds = k exp(−(Q/R) (1/T − 1/T_ref)) p, in m/m.

    k in 1/Pa, Q in J/mol, R the gas constant, T in K. Valid where one
    thermally activated process, such as oxidation or the failure of a boundary
    film, sets the wear rate, over the temperatures at which Q was fitted.

    References
    ----------
    Quinn, T. F. J. (1983), Review of oxidational wear, Part I, Tribology
    International 16, 257-271.

    Examples
    --------
    >>> from tribo_thermal.arrhenius import Arrhenius
    >>> law = Arrhenius(k=1e-16, activation_energy="50 kJ/mol", reference_temperature="90 degC")
    >>> hot = {"temperature": np.array([363.15, 383.15])}
    >>> local = tribo.LocalConditions(np.full(2, 1e9), 0.1, tribo.materials["100Cr6"], hot)
    >>> (1e9 * law.rate(local).depth_rate).round(1).tolist()  # in nm/m, at 90 and 110 °C
    [100.0, 237.4]
    """

    examples = (
        {
            "k": "3.11e-16 1/Pa",
            "activation_energy": "50 kJ/mol",
            "reference_temperature": "90 degC",
        },
    )
    type = "thermal.arrhenius"
    k: Annotated[float, Quantity("1/Pa", at_least=0, usual=(1e-22, 1e-10))]
    """Specific wear rate at the reference temperature."""
    activation_energy: Annotated[float, Quantity("J/mol", at_least=0, usual=(1e3, 1e6))]
    """Activation energy Q, per mole."""
    reference_temperature: Annotated[float, Quantity("K", above=0, usual=(150.0, 2000.0))]
    """Temperature at which the law equals Archard's with the same k."""

    requires = (TEMPERATURE,)

    def rate(self, local: LocalConditions) -> WearRate:
        """Return k(T) p and k(T)."""
        difference = 1 / local.fields[TEMPERATURE.name] - 1 / self.reference_temperature
        k = self.k * np.exp(-self.activation_energy / GAS_CONSTANT * difference)
        return WearRate(k * local.pressure, k)
