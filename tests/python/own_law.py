"""A law of one's own, in a file that can be imported."""

from typing import Annotated

from tribo import LocalConditions, Quantity, WearLaw, WearRate


class Halved(WearLaw):
    """dh/ds = k p/2."""

    type = "own.halved"
    k: Annotated[float, Quantity("1/Pa", at_least=0)]

    def rate(self, local: LocalConditions) -> WearRate:
        return WearRate(0.5 * self.k * local.pressure)
