"""A stranger's wear law that requires a field of an effect."""

from typing import Annotated, Literal

from tribo.plugin import LocalConditions, Quantity, WearLaw, WearLawConfig, WearRate


class ProtectedConfig(WearLawConfig):
    type: Literal["stranger.protected"] = "stranger.protected"
    k: Annotated[float, Quantity("1/Pa", at_least=0)]
    """Specific wear rate of the bare metal; oxide does not wear."""


class Protected(WearLaw[ProtectedConfig]):
    """dh/ds = k (1 − c) p, with the part c of the surface that is under oxide."""

    Config = ProtectedConfig
    requires = ("stranger_oxide",)

    def rate(self, local: LocalConditions) -> WearRate:
        k = self.config.k * (1 - local.fields["stranger_oxide"])
        return WearRate(k * local.pressure, k)
