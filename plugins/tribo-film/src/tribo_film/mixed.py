"""Mixed lubrication: film and asperities share the load."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

import numpy as np
from pydantic import ConfigDict
from tribo import (
    FRICTION_COEFFICIENT,
    LOAD_SHARE,
    Array,
    ContactConditions,
    Effect,
    Field,
    Quantity,
)

from tribo_film.hamrock_dowson import central_film

THICKNESS = Field("film_thickness", "m", "Thickness of the film of smooth bodies.", at_least=0)
RATIO = Field("lambda_ratio", "1", "Film thickness over roughness.", at_least=0, typical=1.0)
EXAMPLE = {"viscosity": "0.1 Pa s", "pressure_viscosity": "20 1/GPa", "radius": "5 mm"}


class Mixed(Effect):
    """φ = 1 − 1/(1 + Λ)² of the load is on the film, with Λ = h/σ and h after Hamrock & Dowson.

    The rest is on asperities, and wears. Friction is that of both: μ = φ μ_film + (1 − φ) μ_b,
    which is Olver & Spikes' formula. The pressure is shared alike everywhere.

    Valid for a ball on a flat of which one stands still, as long as wear is shallow beside the
    elastic approach (the film's formula does not know the worn shape), fully flooded, isothermal,
    with a roughness that stays, at a speed that is steady along many contact widths.

    References
    ----------
    Hamrock, B. J., Dowson, D. (1977), J. Lubr. Technol. 99, 264-275. Olver, A. V., Spikes, H. A.
    (1998), Prediction of traction in elastohydrodynamic lubrication, Proc. IMechE J 212, 321-332.
    Johnson, K. L., Greenwood, J. A., Poon, S. Y. (1972), A simple theory of asperity contact in
    elastohydrodynamic lubrication, Wear 19, 91-108: that both pressures add up to one.
    """

    model_config = ConfigDict(
        json_schema_extra={"examples": [{**EXAMPLE, "roughness": "0.2 um"}]}  # type: ignore[dict-item]
    )

    type = "film.mixed"
    viscosity: Annotated[float, Quantity("Pa s", at_least=0, usual=(1e-5, 20.0))]
    """Dynamic viscosity of the lubricant at ambient pressure."""
    pressure_viscosity: Annotated[float, Quantity("1/Pa", above=0, usual=(1e-10, 1e-6))]
    """Its coefficient with pressure α."""
    radius: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))]
    """Reduced radius of curvature of the contact; that of the ball on a flat."""
    roughness: Annotated[float, Quantity("m", above=0, usual=(1e-10, 1e-4))]
    """Root mean square roughness σ of both bodies together, √(Rq₁² + Rq₂²)."""
    boundary_friction: Annotated[float, Quantity("1", at_least=0)] = 0.12
    """Coefficient of friction μ_b of the asperities."""
    film_friction: Annotated[float, Quantity("1", at_least=0)] = 0.03
    """Coefficient of friction μ_film of the film."""

    provides = (LOAD_SHARE, FRICTION_COEFFICIENT, THICKNESS, RATIO)

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        """Return the film's share and thickness, and the friction, uniform over the contact."""
        load = float(np.sum(contact.pressure)) * contact.grid.cell_area
        compliance = sum((1 - m.poisson**2) / m.young for m in contact.materials.values())
        thickness = 0.0
        if load > 0:
            thickness = central_film(
                self.radius,
                load,
                # One body stands still.
                0.5 * contact.speed,
                self.viscosity,
                self.pressure_viscosity,
                1 / compliance,
            )
        ratio = thickness / self.roughness
        share = self.share(ratio)
        values = {
            LOAD_SHARE: share,
            FRICTION_COEFFICIENT: self.friction(ratio),
            THICKNESS: thickness,
            RATIO: ratio,
        }
        return {
            field.name: dict.fromkeys(contact.materials, np.full((1, 1), value))
            for field, value in values.items()
        }

    def share(self, ratio: float) -> float:
        """Return the part of the load that the film carries at a ratio Λ."""
        return 1 - (1 + ratio) ** -2

    def friction(self, ratio: float) -> float:
        """Return the coefficient of friction at a ratio Λ."""
        return (
            self.film_friction + (self.boundary_friction - self.film_friction) * (1 + ratio) ** -2
        )
