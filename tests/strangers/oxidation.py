"""A stranger's effect: an oxide film that grows with the power of friction."""

from collections.abc import Mapping
from typing import Annotated

from tribo import Array, ContactConditions, Effect, Field, Quantity

OXIDE = "stranger_oxide"


class OxideFilm(Effect):
    """w/(w + power), with the power of friction w = μ p v."""

    type = "stranger.oxide_film"
    reach = "point"
    power: Annotated[float, Quantity("W/m^2", above=0)]
    """Power of friction per area at which half the surface is oxidised."""

    requires = ("friction_coefficient",)
    provides = (Field(OXIDE, "1", "Part of the surface under oxide."),)

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        friction = contact.fields["friction_coefficient"]
        heat = {name: mu * contact.pressure * contact.speed for name, mu in friction.items()}
        return {OXIDE: {name: w / (w + self.power) for name, w in heat.items()}}
