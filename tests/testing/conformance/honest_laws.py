"""Sound wear laws, some as the documentation has them, for mistakes to be made in."""

from dataclasses import replace
from typing import Annotated

import numpy as np

from tribo import WORN_DEPTH, Archard, Field, ModifiedLaw, Quantity, WearLaw, WearRate

GAS_CONSTANT = 8.314462618

SpecificRate = Annotated[float, Quantity("1/Pa", at_least=0)]
Length = Annotated[float, Quantity("m", above=0)]


class Law(WearLaw):
    """Rubbed points wear less; friction and pressure make more of it."""

    type = "honest.law"
    k: Annotated[float, Quantity("1/Pa", above=0)] = 1e-16
    """Specific wear rate per coefficient of friction."""
    p_ref: Annotated[float, Quantity("Pa", above=0)] = 1e9
    """Pressure at which the wear rate has doubled."""
    length: Length = 1.0
    """Distance over which rubbed points wear less."""

    requires = ("friction_coefficient",)
    state_fields = (Field("rubbed", "m", "Distance slid under pressure."),)

    def rate(self, local):
        p, ref, rubbed = local.pressure, self.p_ref, local.state["rubbed"]
        k = self.k * local.fields["friction_coefficient"] * (1 + np.exp(-rubbed / self.length))
        return WearRate(k * p * (1 + p / ref), k * (1 + 2 * p / ref), {"rubbed": 1.0 * (p > 0)})


class RunningIn(WearLaw):
    """dh/ds = k p, with k from k_first to k_last over a length."""

    type = "honest.running_in"
    k_first: SpecificRate = 4e-16
    """Specific wear rate of a fresh point."""
    k_last: SpecificRate = 1e-16
    """Specific wear rate once it has run in."""
    length: Length = 2.0
    """Distance slid over which it runs in."""

    state_fields = (Field("slid", "m", "Distance slid under pressure.", at_least=0.0),)

    def k(self, slid):
        return self.k_last + (self.k_first - self.k_last) * np.exp(-slid / self.length)

    def rate(self, local):
        p, k = local.pressure, self.k(local.state["slid"])
        return WearRate(k * p, k, {"slid": 1.0 * (p > 0)})


class Coating(WearLaw):
    """dh/ds = k p, with one k down to a depth and another below."""

    type = "honest.coating"
    k: SpecificRate = 1e-16
    """Rate above."""
    below: SpecificRate = 1e-15
    """Rate below."""
    thickness: Length = 1e-6
    """Where it ends."""

    @property
    def state_fields(self):
        return (replace(WORN_DEPTH, breaks=(self.thickness,)),)

    def rate(self, local):
        p, worn = local.pressure, local.state["worn_depth"]
        k = np.where(worn < self.thickness, self.k, self.below)
        return WearRate(k * p, k, {"worn_depth": k * p})


TEMPERATURE = Field(
    "temperature", "K", "Temperature of the surface.", at_least=0.0, at_most=1500.0, typical=400.0
)


class Oxide(WearLaw):
    """Bare metal wears by its temperature; oxide covers it and does not wear."""

    type = "honest.oxide"
    k_bare: SpecificRate = 4e-16
    """Specific wear rate of bare metal at the reference temperature."""
    length: Length = 5.0
    """Distance slid over which oxide covers it."""
    energy: Annotated[float, Quantity("J/mol", at_least=0)] = 8e3
    """Activation energy."""
    reference: Annotated[float, Quantity("K", above=0)] = 363.0
    """Reference temperature."""

    requires = (TEMPERATURE,)
    state_fields = (Field("cover", "1", "Part under oxide.", at_least=0.0, at_most=1.0),)

    def factor(self, temperature):
        return np.exp(-self.energy / GAS_CONSTANT * (1 / temperature - 1 / self.reference))

    def rate(self, local):
        p, bare = local.pressure, 1 - local.state["cover"]
        k = self.k_bare * bare * self.factor(local.fields["temperature"])
        return WearRate(k * p, k, {"cover": np.where(p > 0, bare / self.length, 0.0)})


class Lubricated(ModifiedLaw):
    """dh/ds = r(p - p_film), with r another law, and a film that is rubbed off."""

    type = "honest.lubricated"
    law: WearLaw = Archard(k=2e-16)
    """The law that wears under the rest of the pressure."""
    p_film: Annotated[float, Quantity("Pa", at_least=0)] = 3e8
    """Pressure that the film carries at first."""
    length: Length = 6.0
    """Distance over which 1/e of the film is left."""

    own_state = (Field("film_left", "1", "Part of the film left.", at_least=0.0, at_most=1.0),)

    def initial_state(self):
        return {**self.law.initial_state(), "film_left": 1.0}

    def rate(self, local):
        left = local.state["film_left"]
        excess = np.maximum(local.pressure - self.p_film * left, 0.0)
        rate = self.law.rate(replace(local, pressure=excess))
        rubbed = np.where(local.pressure > 0, -left / self.length, 0.0)
        states = {**rate.state_rates, "film_left": rubbed}
        return replace(rate, depth_slope=rate.depth_slope * (excess > 0), state_rates=states)


LAWS = (Law, RunningIn, Coating, Oxide, Lubricated)
