"""The film between a ball and a flat under elastohydrodynamic lubrication."""

from __future__ import annotations

import math


def central_film(
    radius: float,
    load: float,
    speed: float,
    viscosity: float,
    pressure_viscosity: float,
    modulus: float,
) -> float:
    """Return the film thickness in the middle of a point contact, in m.

    H = 2.69 U^0.67 G^0.53 W^−0.067 (1 − 0.61 e^(−0.73 k)), with k = 1 for a circle, U = η₀u/(E′R),
    G = αE′, W = F/(E′R²), h = HR and E′ = 2E*. Valid for fully flooded, isothermal, smooth
    contacts of hard bodies.

    Parameters
    ----------
    radius : float
        Reduced radius of curvature R, in m.
    load : float
        Normal load F, in N.
    speed : float
        Entrainment speed u, the mean of both surfaces', in m/s.
    viscosity, pressure_viscosity : float
        Dynamic viscosity η₀ in Pa s and its coefficient with pressure α in 1/Pa.
    modulus : float
        Contact modulus E*, in Pa.

    References
    ----------
    Hamrock, B. J., Dowson, D. (1977), Isothermal elastohydrodynamic lubrication of point contacts,
    Part III: fully flooded results, J. Lubr. Technol. 99, 264-275.
    """
    stiffness = 2 * modulus
    entrained = viscosity * speed / (stiffness * radius)
    pressed = load / (stiffness * radius**2)
    round_contact = 1 - 0.61 * math.exp(-0.73)
    thickness = 2.69 * entrained**0.67 * (pressure_viscosity * stiffness) ** 0.53
    return float(radius * thickness * pressed**-0.067 * round_contact)
