"""A stranger's third body: debris that wear feeds, sliding ejects, and that protects."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated

import numpy as np

from tribo import (
    Array,
    ContactConditions,
    Effect,
    Field,
    LocalConditions,
    Quantity,
    WearLaw,
    WearRate,
)

THICKNESS = Field(
    "debris_thickness", "m", "Height of debris in the contact.", at_least=0, typical=1e-6
)


class Debris(Effect):
    """dt/ds = c (r₁ + r₂) − t/λ, with the depths r that the bodies lose per metre."""

    type = "stranger.debris"
    reach = "point"
    caught: Annotated[float, Quantity("1", at_least=0)] = 1.0
    """Part c of what is worn that stays in the contact."""
    length: Annotated[float, Quantity("m", above=0)]
    """Sliding distance λ over which debris leaves it."""
    on: str | None = None
    """The body on which it lies."""

    state_fields = (THICKNESS,)

    def carrier(self) -> str | None:
        return self.on

    def state_rates(self, contact: ContactConditions) -> Mapping[str, Array]:
        source = self.caught * sum(contact.wear_rates.values())
        leaving = np.where(contact.pressure > 0, contact.state[THICKNESS.name] / self.length, 0.0)
        return {THICKNESS.name: contact.speed * (source - leaving)}


class Filling(Debris):
    """Debris on which the bodies meet."""

    type = "stranger.filling"

    state_fields = (replace(THICKNESS, fills=True),)


class Covered(WearLaw):
    """dh/ds = k p exp(−t/t₀)."""

    type = "stranger.covered"
    k: Annotated[float, Quantity("1/Pa", at_least=0)]
    """Specific wear rate without debris."""
    cover: Annotated[float, Quantity("m", above=0)]
    """Thickness t₀ of debris that lets through 1/e of the wear."""

    requires = (THICKNESS,)

    def rate(self, local: LocalConditions) -> WearRate:
        k = self.k * np.exp(-local.fields[THICKNESS.name] / self.cover)
        return WearRate(k * local.pressure, k)
