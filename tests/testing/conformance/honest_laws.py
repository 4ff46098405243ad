"""Sound wear laws, some as the documentation has them, for mistakes to be made in."""

from dataclasses import replace
from typing import Annotated

import numpy as np
from testing.conformance.honest_effects import TEMPERATURE

from tribo import WORN_DEPTH, Archard, Field, ModifiedLaw, Quantity, WearLaw, WearRate

GAS_CONSTANT = 8.314462618


class RunningIn(WearLaw):
    """dh/ds = k p, with k from k_first to k_last over a length."""

    type = "honest.running_in"
    k_first: Annotated[float, Quantity("1/Pa", at_least=0)] = 4e-16
    """Specific wear rate of a fresh point."""
    k_last: Annotated[float, Quantity("1/Pa", at_least=0)] = 1e-16
    """Specific wear rate once it has run in."""
    length: Annotated[float, Quantity("m", above=0)] = 2.0
    """Distance slid over which it runs in."""

    state_fields = (Field("slid", "m", "Distance slid under pressure.", at_least=0.0),)

    def rate(self, local):
        slid = local.state["slid"]
        k = self.k_last + (self.k_first - self.k_last) * np.exp(-slid / self.length)
        return WearRate(k * local.pressure, k, {"slid": (local.pressure > 0).astype(float)})


class Coating(WearLaw):
    """dh/ds = k p, with one k down to a depth and another below."""

    type = "honest.coating"
    k: Annotated[float, Quantity("1/Pa", at_least=0)] = 1e-16
    """Rate above."""
    below: Annotated[float, Quantity("1/Pa", at_least=0)] = 1e-15
    """Rate below."""
    thickness: Annotated[float, Quantity("m", above=0)] = 1e-6
    """Where it ends."""

    @property
    def state_fields(self):
        return (replace(WORN_DEPTH, breaks=(self.thickness,)),)

    def rate(self, local):
        worn = local.state["worn_depth"]
        k = np.where(worn < self.thickness, self.k, self.below)
        return WearRate(k * local.pressure, k, {"worn_depth": k * local.pressure})


class Oxide(WearLaw):
    """Bare metal wears by its temperature; oxide covers it and does not wear."""

    type = "honest.oxide"
    k_bare: Annotated[float, Quantity("1/Pa", at_least=0)] = 4e-16
    """Specific wear rate of bare metal at the reference temperature."""
    length: Annotated[float, Quantity("m", above=0)] = 5.0
    """Distance slid over which oxide covers it."""
    energy: Annotated[float, Quantity("J/mol", at_least=0)] = 8e3
    """Activation energy."""
    reference: Annotated[float, Quantity("K", above=0)] = 363.0
    """Reference temperature."""

    requires = (TEMPERATURE.name,)
    state_fields = (Field("cover", "1", "Part under oxide.", at_least=0.0, at_most=1.0),)

    def rate(self, local):
        bare = 1 - local.state["cover"]
        warmer = 1 / local.fields["temperature"] - 1 / self.reference
        factor = np.exp(-self.energy / GAS_CONSTANT * warmer)
        k = self.k_bare * factor * bare
        grown = np.where(local.pressure > 0, (1 - local.state["cover"]) / self.length, 0.0)
        return WearRate(k * local.pressure, k, {"cover": grown})


class Incubation(WearLaw):
    """dh/ds = k p once a point has slid a length, and k_early p before."""

    type = "honest.incubation"
    k_early: Annotated[float, Quantity("1/Pa", at_least=0)] = 1e-17
    """Specific wear rate at first."""
    k: Annotated[float, Quantity("1/Pa", at_least=0)] = 3e-16
    """Specific wear rate afterwards."""
    length: Annotated[float, Quantity("m", above=0)] = 4.0
    """Distance slid at which cracks have come to the surface."""

    @property
    def state_fields(self):
        return (Field("cracked", "m", "Distance slid.", at_least=0.0, breaks=(self.length,)),)

    def rate(self, local):
        k = np.where(local.state["cracked"] < self.length, self.k_early, self.k)
        return WearRate(k * local.pressure, k, {"cracked": (local.pressure > 0).astype(float)})


class Lubricated(ModifiedLaw):
    """dh/ds = r(p - p_film), with r another law, and a film that is rubbed off."""

    type = "honest.lubricated"
    law: WearLaw = Archard(k=2e-16)
    """The law that wears under the rest of the pressure."""
    p_film: Annotated[float, Quantity("Pa", at_least=0)] = 3e8
    """Pressure that the film carries at first."""
    length: Annotated[float, Quantity("m", above=0)] = 6.0
    """Distance over which 1/e of the film is left."""

    own_state = (Field("film_left", "1", "Part of the film left.", at_least=0.0, at_most=1.0),)

    def initial_state(self):
        return {**self.law.initial_state(), "film_left": 1.0}

    def rate(self, local):
        left = local.state["film_left"]
        excess = np.maximum(local.pressure - self.p_film * left, 0.0)
        rate = self.law.rate(replace(local, pressure=excess))
        rubbed = np.where(local.pressure > 0, -left / self.length, 0.0)
        slope = rate.depth_slope * (excess > 0)
        states = {**rate.state_rates, "film_left": rubbed}
        return replace(rate, depth_slope=slope, state_rates=states)


LAWS = (RunningIn, Coating, Oxide)
