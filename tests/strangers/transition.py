"""A stranger's wear law that is not linear in pressure: mild to severe."""

from typing import Annotated

from tribo import LocalConditions, Quantity, WearLaw, WearRate


class Transition(WearLaw):
    """dh/ds = k p (1 + (p/p_severe)²)."""

    type = "stranger.transition"
    k: Annotated[float, Quantity("1/Pa", at_least=0)]
    """Specific wear rate far below the transition."""
    p_severe: Annotated[float, Quantity("Pa", above=0)]
    """Pressure at which it has doubled."""

    def rate(self, local: LocalConditions) -> WearRate:
        k, ratio2 = self.k, (local.pressure / self.p_severe) ** 2
        return WearRate(k * local.pressure * (1 + ratio2), k * (1 + 3 * ratio2))
