"""A stranger's wear law that requires a field of an effect."""

from typing import Annotated

from tribo import LocalConditions, Quantity, WearLaw, WearRate


class Protected(WearLaw):
    """dh/ds = k (1 − c) p, with the part c of the surface that is under oxide."""

    type = "stranger.protected"
    k: Annotated[float, Quantity("1/Pa", at_least=0)]
    """Specific wear rate of the bare metal; oxide does not wear."""

    requires = ("stranger_oxide",)

    def rate(self, local: LocalConditions) -> WearRate:
        k = self.k * (1 - local.fields["stranger_oxide"])
        return WearRate(k * local.pressure, k)
