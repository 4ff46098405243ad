"""A sphere on a Winkler foundation, unworn and worn.

The foundation answers an overlap u with the pressure p = K_w u, point by
point. The profile is parabolic, h = r²/2R, so the contact must stay small
beside the radius. A sphere on K_w = 16E*/3πa has the contact radius a of Hertz,
4/3 of his peak pressure and half of his approach.

References
----------
K. L. Johnson (1985), Contact Mechanics, section 4.3 (foundation);
P. Podra and S. Andersson (1997), Wear 207, 79-85 (wear on it). The worn
solutions are derived in the notes of each function.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import dawsn

from tribo.core.arrays import Array


@dataclass(frozen=True)
class WinklerContact:
    """An unworn contact on a Winkler foundation."""

    half_width: float
    """Contact radius, in m."""
    pressure: float
    """Pressure at the centre, in Pa."""
    approach: float
    """Rigid approach, in m."""


def sphere(load: float, radius: float, stiffness: float) -> WinklerContact:
    """Press a rigid sphere on a Winkler foundation.

    F = π K_w a⁴/4R, p0 = K_w a²/2R = 2F/πa², δ = a²/2R.

    Parameters
    ----------
    load, radius, stiffness : float
        Normal load F, in N; radius R, in m; foundation stiffness K_w, in Pa/m.
    """
    a = (4.0 * radius * load / (np.pi * stiffness)) ** 0.25
    approach = a**2 / (2.0 * radius)
    return WinklerContact(a, stiffness * approach, approach)


def worn_sphere_pressure(
    r: ArrayLike,
    distance: ArrayLike,
    *,
    load: float,
    radius: float,
    stiffness: float,
    wear_coefficient: float,
) -> Array:
    """Pressure under a sphere that alone wears, by Archard's law.

    With a0, p0 of the unworn contact, z = 1 + k K_w s, ρ = r²/a0² and
    Dawson's function D::

        p/p0 = D(√z) + exp(1 − z) (1 − ρ − D(1))     r ≤ a0
        p/p0 = D(√z) − exp(ρ² − z) D(ρ)              a0 < r ≤ a(s)
        p    = 0                                     r > a(s)

    Parameters
    ----------
    r, distance : array_like
        Distance from the axis, and sliding distance s, in m; broadcast against each other.
    load, radius, stiffness : float
        As for `sphere`.
    wear_coefficient : float
        Archard's k, in 1/Pa.

    Returns
    -------
    ndarray
        Pressure, in Pa.

    Notes
    -----
    The contact radius a(s) is that of `tribo.closed_forms.ball_wear.elastic_ball_half_width`.
    A point in contact obeys dp/ds = K_w (dδ/ds − k p), from p(r, 0) or, where
    the contact comes later, from p = 0 at a(s) = r. With δ = δ0 √z the integral
    of √z exp(z) is Dawson's.
    """
    contact = sphere(load, radius, stiffness)
    z = 1.0 + wear_coefficient * stiffness * np.asarray(distance, dtype=float)
    rho = (np.asarray(r, dtype=float) / contact.half_width) ** 2
    touched_at = np.maximum(rho**2, 1.0)
    start = np.where(rho <= 1.0, 1.0 - rho, 0.0)
    fading = np.exp(np.minimum(touched_at - z, 0.0)) * (start - dawsn(np.sqrt(touched_at)))
    ratio = dawsn(np.sqrt(z)) + fading
    return np.asarray(contact.pressure * np.where(touched_at <= z, np.maximum(ratio, 0.0), 0.0))
