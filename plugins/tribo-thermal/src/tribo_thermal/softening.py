"""Archard's law with a hardness that falls as the temperature rises."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from tribo import CaseError, LocalConditions, Material, Quantity, WearLaw, WearRate

from tribo_thermal.flash import TEMPERATURE


class Softening(WearLaw):
    """dh/ds = K p/H(T), with H(T) = H₀ max(1 − β (T − T_ref), c).

    In m/m; p and H in Pa, β in 1/K, T in K, c the least part of the hardness.
    Valid for a linear fall of hardness, for steels to some 600 K, and below
    T_ref + (1 − c)/β: beyond, the floor c only keeps the rate finite. It
    softens wear, not the contact: the pressure stays limited by the
    material's own hardness.

    References
    ----------
    Archard, J. F. (1953), J. Appl. Phys. 24, 981-988. Lim, S. C., Ashby, M. F.
    (1987), Wear-mechanism maps, Acta Metallurgica 35, 1-24.

    Examples
    --------
    >>> from tribo_thermal.softening import Softening
    >>> law = Softening(K=1e-6, hardness="5 GPa", softening="0.001 1/K", reference_temperature=293)
    >>> hot = {"temperature": np.array([293.0, 493.0])}
    >>> local = tribo.LocalConditions(np.full(2, 1e9), 0.1, tribo.materials["100Cr6"], hot)
    >>> (1e9 * law.rate(local).depth_rate).round(1).tolist()  # in nm/m, at 20 and 220 °C
    [200.0, 250.0]
    """

    examples = ({"K": 1.24e-6, "softening": "0.001 1/K", "reference_temperature": "20 degC"},)
    type = "thermal.softening"
    K: Annotated[float, Quantity("1", at_least=0, usual=(1e-12, 1.0))]
    """Archard's dimensionless wear coefficient."""
    hardness: Annotated[float, Quantity("Pa", above=0, usual=(1e4, 2e11))] | None = None
    """Hardness H₀ at the reference temperature; the material's hardness if left out."""
    softening: Annotated[float, Quantity("1/K", at_least=0, usual=(1e-6, 0.1))]
    """Part β of the hardness lost per kelvin."""
    reference_temperature: Annotated[float, Quantity("K", above=0, usual=(150.0, 2000.0))]
    """Temperature at which the hardness is H₀."""
    least_hardness: Annotated[float, Quantity("1", above=0, at_most=1)] = 0.1
    """Part of H₀ below which the hardness does not fall."""

    requires = (TEMPERATURE,)

    def check(self, material: Material) -> None:
        """Require a hardness, here or of the material."""
        self._hardness(material)

    def rate(self, local: LocalConditions) -> WearRate:
        """Return k(T) p and k(T), with k = K/H(T)."""
        warmer = local.fields[TEMPERATURE.name] - self.reference_temperature
        part = np.maximum(1 - self.softening * warmer, self.least_hardness)
        k = self.K / (self._hardness(local.material) * part)
        return WearRate(k * local.pressure, k)

    def _hardness(self, material: Material) -> float:
        hardness = self.hardness or material.hardness
        if hardness is None:
            raise CaseError("a hardness is needed: add it here or to the body's material")
        return hardness
