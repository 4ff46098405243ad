"""Wear in proportion to the energy that friction dissipates."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from tribo import Field, LocalConditions, Quantity, WearLaw, WearRate

from tribo_energy.traction import SLOPE, TRACTION

ENERGY = Field("dissipated_energy", "J/m^2", "Friction energy dissipated per area so far.")


class Dissipation(WearLaw):
    """dh/ds = α max(τ − τ_th, 0) φ(E), with dE/ds = τ.

    φ rises from 0 to 1, in proportion to the energy E that a point has
    dissipated, over the spread w E_th centred at E_th; without a threshold
    energy it is 1. Beyond E_th (1 + w/2) the depth is α (E − E_th), the law of
    Fouvry: α in m³/J = 1/Pa, τ in Pa, E in J/m².

    Valid for gross sliding under one wear mechanism, with α from tests of the
    same mechanism. On a swept body E is the mean over the track.

    References
    ----------
    Fouvry, S., Liskiewicz, T., Kapsa, Ph., Hannel, S., Sauger, E. (2003), An
    energy description of wear mechanisms and its applications to oscillating
    sliding contacts, Wear 255, 287-298. Reye, T. (1860), Zur Theorie der
    Zapfenreibung, Der Civilingenieur 4, 235-255.

    Examples
    --------
    >>> from tribo_energy.dissipation import Dissipation
    >>> pressure = np.array([[[100e6, 1e9]]])
    >>> traction = {"friction_traction": 0.3 * pressure, "friction_traction_slope": 0.3}
    >>> local = tribo.LocalConditions(pressure, 0.1, tribo.materials["100Cr6"], traction)
    >>> law = Dissipation(alpha="3e-6 mm^3/J", threshold_traction="50 MPa")
    >>> (1e9 * law.rate(local).depth_rate).round(3).tolist()  # in nm per metre of sliding
    [[[0.0, 750.0]]]
    """

    examples = (
        {"alpha": "3.11e-6 mm^3/J"},
        {
            "alpha": "3.11e-6 mm^3/J",
            "threshold_traction": "50 MPa",
            "threshold_energy": "10 MJ/m^2",
        },
    )
    type = "energy.dissipation"
    alpha: Annotated[float, Quantity("m^3/J", at_least=0, usual=(1e-22, 1e-10))]
    """Energy wear coefficient: volume per dissipated energy. k/μ for Archard's k."""
    threshold_traction: Annotated[float, Quantity("Pa", at_least=0)] = 0.0
    """Friction traction below which nothing wears."""
    threshold_energy: Annotated[float, Quantity("J/m^2", at_least=0)] = 0.0
    """Energy per area that a point dissipates before it wears."""
    threshold_spread: Annotated[float, Quantity("1", above=0, at_most=2)] = 0.05
    """Width of the onset of wear around ``threshold_energy``, relative to it."""

    requires = (TRACTION, SLOPE)
    state_fields = (ENERGY,)

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the rate, α φ dτ/dp where it wears, and τ as the rate of E."""
        traction = np.where(local.pressure > 0, local.fields[TRACTION.name], 0.0)
        slope = local.fields[SLOPE.name]
        alpha = np.full_like(traction, self.alpha)
        if self.threshold_energy > 0:
            spread = self.threshold_spread * self.threshold_energy
            onset = (local.state[ENERGY.name] - self.threshold_energy) / spread + 0.5
            alpha *= np.clip(onset, 0.0, 1.0)
        excess = traction - self.threshold_traction
        return WearRate(
            depth_rate=alpha * np.maximum(excess, 0.0),
            depth_slope=alpha * np.where(excess >= 0, slope, 0.0),
            state_rates={ENERGY.name: traction},
        )
