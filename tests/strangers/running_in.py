"""A stranger's wear law with a state per material point: it runs in."""

from typing import Annotated, Literal

import numpy as np

from tribo.plugin import Field, LocalConditions, Quantity, WearLaw, WearLawConfig, WearRate

SpecificRate = Annotated[float, Quantity("1/Pa", at_least=0)]


class RunningInConfig(WearLawConfig):
    type: Literal["stranger.running_in"] = "stranger.running_in"
    k_first: SpecificRate
    """Specific wear rate of a fresh surface."""
    k_last: SpecificRate
    """Specific wear rate once it has run in."""
    length: Annotated[float, Quantity("m", above=0)]
    """Slip over which it runs in."""


class RunningIn(WearLaw[RunningInConfig]):
    """dh/ds = k p, k = k_last + (k_first − k_last) exp(−slip/length)."""

    Config = RunningInConfig
    state_fields = (Field("slip", "m", "How far this point has slid under pressure."),)

    def rate(self, local: LocalConditions) -> WearRate:
        c = self.config
        k = c.k_last + (c.k_first - c.k_last) * np.exp(-local.state["slip"] / c.length)
        return WearRate(k * local.pressure, k, {"slip": np.where(local.pressure > 0, 1.0, 0.0)})
