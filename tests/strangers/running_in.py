"""A stranger's wear law with a state per material point: it runs in."""

from typing import Annotated

import numpy as np

from tribo import Field, LocalConditions, Quantity, WearLaw, WearRate

SpecificRate = Annotated[float, Quantity("1/Pa", at_least=0)]


class RunningIn(WearLaw):
    """dh/ds = k p, k = k_last + (k_first − k_last) exp(−slip/length)."""

    type = "stranger.running_in"
    k_first: SpecificRate
    """Specific wear rate of a fresh surface."""
    k_last: SpecificRate
    """Specific wear rate once it has run in."""
    length: Annotated[float, Quantity("m", above=0)]
    """Slip over which it runs in."""

    state_fields = (Field("slip", "m", "How far this point has slid under pressure."),)

    def rate(self, local: LocalConditions) -> WearRate:
        k = self.k_last + (self.k_first - self.k_last) * np.exp(-local.state["slip"] / self.length)
        return WearRate(k * local.pressure, k, {"slip": np.where(local.pressure > 0, 1.0, 0.0)})
