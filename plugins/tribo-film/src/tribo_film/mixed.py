"""Mixed lubrication: film and asperities share the load."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

import numpy as np
from scipy.special import pbdv
from tribo import (
    FRICTION_COEFFICIENT,
    LOAD_SHARE,
    Array,
    ContactConditions,
    Effect,
    Field,
    Finding,
    Quantity,
    Snapshot,
)

from tribo_film.hamrock_dowson import central_film

THICKNESS = Field("film_thickness", "m", "Thickness of the film of smooth bodies.", at_least=0)
RATIO = Field("lambda_ratio", "1", "Film thickness over roughness.", at_least=0, typical=1.0)
FAR = 30.0
"""Ratio Λ beyond which asperities carry 1e-197 of the load, and the function no number."""
SHALLOW = 1.0
"""Wear depth over elastic approach, above which the film does not hold."""
EXAMPLE = {"viscosity": "0.1 Pa s", "pressure_viscosity": "20 1/GPa", "radius": "5 mm"}


class Mixed(Effect):
    """φ = 1 − A(Λ) of the load is on the film, with Λ = h/σ and h after Hamrock & Dowson.

    The part A is on asperities, and wears. With ``sharing = "asperities"`` it is their own
    pressure at a separation h, over that at none, where they carry the whole load:

        A = F_5/2(Λ)/F_5/2(0),  F_5/2(u) = (2π)^−½ ∫ (s − u)^5/2 exp(−s²/2) ds  from u to ∞,

    Greenwood & Tripp's integral over heights of two rough surfaces, in which Johnson, Greenwood &
    Poon put the film of smooth bodies, since the load hardly thins it. With ``"olver_spikes"`` it
    is A = (1 + Λ)^−2, an interpolation of friction between boundary and film, not of contact: at
    Λ = 3 it leaves 6 % of the load on asperities, the integral 0.03 %. Friction is shared as well,
    μ = φ μ_film + (1 − φ) μ_b. The pressure is shared alike everywhere.

    Valid for a ball on a flat of which one stands still, as long as wear is shallow beside the
    elastic approach (the film's formula does not know the worn shape), fully flooded, isothermal,
    with Gaussian roughness that stays, at a speed that is steady along many contact widths. The
    integral takes dry bodies to touch at a separation of 0. Where it is u σ, A is F_5/2(Λ)/F_5/2(u)
    for Λ > u: 8 times as much for asperities so stiff that u = 1, a quarter where the load flattens
    them to u = −1.

    References
    ----------
    Hamrock, B. J., Dowson, D. (1977), J. Lubr. Technol. 99, 264-275. Johnson, K. L., Greenwood,
    J. A., Poon, S. Y. (1972), A simple theory of asperity contact in elastohydrodynamic
    lubrication, Wear 19, 91-108. Greenwood, J. A., Tripp, J. H. (1970), The contact of two
    nominally flat rough surfaces, Proc. IMechE 185, 625-633. Olver, A. V., Spikes, H. A. (1998),
    Prediction of traction in elastohydrodynamic lubrication, Proc. IMechE J 212, 321-332.

    Examples
    --------
    >>> from tribo_film.mixed import Mixed
    >>> oil = {"viscosity": "0.1 Pa s", "pressure_viscosity": "20 1/GPa"}
    >>> film = Mixed(**oil, radius="5 mm", roughness="0.2 um")
    >>> [round(float(film.share(ratio)), 2) for ratio in (0.0, 1.0, 3.0)]  # of the load, at Λ
    [0.0, 0.87, 1.0]
    """

    examples = ({**EXAMPLE, "roughness": "0.2 um"},)
    type = "film.mixed"
    reach = "contact"
    viscosity: Annotated[float, Quantity("Pa s", at_least=0, usual=(1e-5, 20.0))]
    """Dynamic viscosity of the lubricant at ambient pressure."""
    pressure_viscosity: Annotated[float, Quantity("1/Pa", above=0, usual=(1e-10, 1e-6))]
    """Its coefficient with pressure α."""
    radius: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))]
    """Reduced radius of curvature of the contact; the ball's radius on a flat."""
    roughness: Annotated[float, Quantity("m", above=0, usual=(1e-10, 1e-4))]
    """Root mean square roughness σ of both bodies together, √(Rq₁² + Rq₂²)."""
    sharing: Literal["asperities", "olver_spikes"] = "asperities"
    """What shares the load between film and asperities: the ``asperities``' own pressure at the
    film's thickness, or the interpolation of ``olver_spikes``."""
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
        values = {
            LOAD_SHARE: self.share(ratio),
            FRICTION_COEFFICIENT: self.friction(ratio),
            THICKNESS: thickness,
            RATIO: ratio,
        }
        return {
            field.name: dict.fromkeys(contact.materials, np.full((1, 1), value))
            for field, value in values.items()
        }

    def findings(self, snapshot: Snapshot) -> tuple[Finding, ...]:
        """Return a finding where wear is too deep beside the first approach for the film."""
        bodies = snapshot.measures.bodies.values()
        part = max(body.max_wear_depth for body in bodies) / snapshot.state.reference_depth
        if part <= SHALLOW:
            return ()
        words = f"the wear is {part:.4g} times as deep as the approach, too deep for its film"
        return (Finding("validity", words, value=part, limit=SHALLOW),)

    def share(self, ratio: float) -> float:
        """Return the part of the load that the film carries at a ratio Λ."""
        return 1 - self._on_asperities(ratio)

    def friction(self, ratio: float) -> float:
        """Return the coefficient of friction at a ratio Λ."""
        boundary = self._on_asperities(ratio)
        return self.film_friction + (self.boundary_friction - self.film_friction) * boundary

    def _on_asperities(self, ratio: float) -> float:
        if self.sharing == "olver_spikes":
            return (1 + ratio) ** -2
        # F_n(u) is Γ(n + 1) exp(−u²/4) D_−n−1(u)/√2π, with D the parabolic cylinder function.
        apart = min(ratio, FAR)
        return float(np.exp(-(apart**2) / 4) * pbdv(-3.5, apart)[0] / pbdv(-3.5, 0.0)[0])
