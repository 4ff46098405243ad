"""Running-in: laws with more wear at first, by the work done or by the roughness left."""

from __future__ import annotations

from typing import Annotated, Self

import numpy as np
from pydantic import model_validator

from tribo.core.arrays import Array
from tribo.core.fields import Field, LocalConditions, WearRate
from tribo.core.units import Quantity
from tribo.wear.modified import ModifiedLaw, times

WORK = Field(
    "pressure_distance", "Pa m", "Pressure times distance that a point has slid under.", at_least=0
)
ROUGHNESS = Field("roughness", "m", "Sq that is left of the roughness finer than a cell.")


class RunningIn(ModifiedLaw):
    """dh/ds = [1 + (f − 1) exp(−D/W)] r(p), with dD/ds = p and r another law.

    A fresh point wears f times as fast. The excess decays over a distance W/p. Under Archard's law,
    with its steady k, running-in costs the same depth (f − 1) k W under any pressure; under an even
    pressure::

        h = k p s + (f − 1) k W [1 − exp(−p s/W)]

    Valid where running-in smooths one first surface, by an amount that the load does not change:
    a fit, with W and f from the bend of a measured wear curve.

    References
    ----------
    Queener, C. A., Smith, T. C., Mitchell, W. L. (1965), Transient wear of machine parts, Wear 8,
    391-400. Blau, P. J. (2005), On the nature of running-in, Tribol. Int. 38, 1007-1012.

    Examples
    --------
    >>> steel, work = tribo.Material(name="100Cr6"), {"pressure_distance": np.array([0, 10e9])}
    >>> local = tribo.LocalConditions(np.full(2, 1e9), speed=0.1, material=steel, state=work)
    >>> law = tribo.RunningIn(law=tribo.Archard(k="1e-15 1/Pa"), factor=6, over="1 GPa m")
    >>> law.rate(local).depth_rate.round(9).tolist()  # m/m when fresh, and after 10 m
    [6e-06, 1e-06]
    """

    examples = ({"law": {"type": "archard", "k": "1e-16 1/Pa"}, "factor": 6, "over": "1 GPa m"},)
    type = "running_in"
    factor: Annotated[float, Quantity("1", at_least=0)]
    """Wear rate of a fresh point over the later rate: f."""
    over: Annotated[float, Quantity("Pa m", above=0)]
    """Pressure times distance W after which 1/e of the excess is left."""

    own_state = (WORK,)

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the other law's rate times the present factor, and p as the rate of D."""
        fresh = np.exp(-local.state[WORK.name] / self.over)
        rate = self.law.rate(local)
        state = {**rate.state_rates, WORK.name: local.pressure}
        faster = times(1 + (self.factor - 1) * fresh, rate)
        return WearRate(faster.depth_rate, faster.depth_slope, state)


class Smoothing(ModifiedLaw):
    """dh/ds = [1 + (f − 1) x] r(p), with x = (Sq − Sq∞)/(Sq₀ − Sq∞) and dSq/dh = −(Sq − Sq∞)/λ.

    Wear is in proportion to the roughness left, and reduces it: over a depth λ of wear the
    roughness above Sq∞ falls to 1/e. Under Archard's law with its steady k, and an even pressure::

        h = λ ln[1 + f (exp(k p s/λ) − 1)],  x = exp(−h/λ)

    so that running-in costs a depth of λ ln f. The roughness is finer than a cell; a surface that
    is rough on the grid smooths under any law. Valid where one kind of asperities is worn to a
    steady roughness: f, λ and both Sq are from a test.

    References
    ----------
    Hu, Y. Z., Li, N., Tønder, K. (1991), A dynamic system model for lubricated sliding wear and
    running-in, J. Tribol. 113, 499-505. Sugimura, J., Kimura, Y. (1984), Characterization of
    topographical changes during lubricated wear, Wear 98, 101-116.

    Examples
    --------
    >>> steel, sq = tribo.Material(name="100Cr6"), {"roughness": np.array([0.4e-6, 0.2e-6])}
    >>> local = tribo.LocalConditions(np.full(2, 1e9), speed=0.1, material=steel, state=sq)
    >>> archard = tribo.Archard(k="1e-15 1/Pa")
    >>> law = tribo.Smoothing(law=archard, factor=6, roughness="0.4 um", depth="0.5 um")
    >>> law.rate(local).depth_rate.round(9).tolist()  # m/m when rough, and half as rough
    [6e-06, 3.5e-06]
    """

    examples = (
        {
            "law": {"type": "archard", "k": "1e-16 1/Pa"},
            "factor": 6,
            "roughness": "0.4 um",
            "settled": "0.1 um",
            "depth": "0.5 um",
        },
    )
    type = "smoothing"
    factor: Annotated[float, Quantity("1", at_least=0)]
    """Wear rate of a surface of the first roughness over the later rate: f."""
    roughness: Annotated[float, Quantity("m", above=0)]
    """Sq at first, Sq₀."""
    settled: Annotated[float, Quantity("m", at_least=0)] = 0.0
    """Steady Sq, Sq∞."""
    depth: Annotated[float, Quantity("m", above=0)]
    """Depth of wear λ after which 1/e of the difference is left."""

    own_state = (ROUGHNESS,)

    @model_validator(mode="after")
    def _smoother(self) -> Self:
        if self.settled >= self.roughness:
            raise ValueError("settled must be less than roughness: the surface becomes smoother")
        return self

    def initial_state(self) -> dict[str, float]:
        """Return the initial state of both."""
        return {**super().initial_state(), ROUGHNESS.name: self.roughness}

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the other law's rate times the factor of now, and the rate of Sq."""
        left = self._left(local)
        above = left * (self.roughness - self.settled)
        rate = self.law.rate(local)
        faster = times(1 + (self.factor - 1) * left, rate)
        state = {**rate.state_rates, ROUGHNESS.name: -above / self.depth * faster.depth_rate}
        return WearRate(faster.depth_rate, faster.depth_slope, state)

    def _left(self, local: LocalConditions) -> Array:
        """Return the part of the roughness above Sq∞ that is left.

        It is limited so that a trial step that smoothed too much has a wear rate above 0.
        """
        left = (local.state[ROUGHNESS.name] - self.settled) / (self.roughness - self.settled)
        return np.maximum(left, -1 / max(self.factor, 1.0))
