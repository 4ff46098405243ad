"""A ball that alone wears against a hard flat, by Archard's law.

In the rigid limit elastic displacement is small beside the worn depth, the
worn face is flat, and its radius follows from the worn volume V = kFs. The
profile is parabolic: the contact must stay small beside the radius.

References
----------
J. F. Archard (1953), J. Appl. Phys. 24, 981-988 (the law); I. I. Argatov
(2011), Wear 271 (the elastic ball). The geometry is elementary.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from tribo.core.arrays import Array


@dataclass(frozen=True)
class WornFace:
    """The flat face worn on a body; arrays are shaped like the sliding distance."""

    half_width: Array
    """Radius of the face, in m."""
    depth: Array
    """Worn depth at the centre, in m."""
    pressure: Array
    """Uniform pressure on the face, in Pa; infinite at zero distance."""


def ball(distance: ArrayLike, *, load: float, radius: float, wear_coefficient: float) -> WornFace:
    """Wear a ball, rigid limit.

    a = (4RkFs/π)^¼, h = a²/2R = √(kFs/πR), p = F/πa².

    Parameters
    ----------
    distance : array_like
        Sliding distance s, in m.
    load, radius, wear_coefficient : float
        Normal load F, in N; radius R of the ball, in m; Archard's k, in 1/Pa.
    """
    given = {"load": load, "radius": radius, "wear_coefficient": wear_coefficient}
    a = elastic_ball_half_width(distance, **given, initial_half_width=0.0)
    with np.errstate(divide="ignore"):
        pressure = np.asarray(load / (np.pi * a**2))
    return WornFace(a, a**2 / (2.0 * radius), pressure)


def elastic_ball_half_width(
    distance: ArrayLike,
    *,
    load: float,
    radius: float,
    wear_coefficient: float,
    initial_half_width: float,
) -> Array:
    """Contact radius of a ball that wears from its Hertzian contact (Argatov 2011).

    a⁴ = a0⁴ + 4kFRs/π. It is exact on a Winkler foundation, for δ − h = w + p/K_w integrates to
    πa⁴/4R = kFs + F/K_w over a contact whose border is unworn and free of pressure; an elastic
    half-space stays within 1 % of it once a has grown by half.

    Parameters
    ----------
    distance, load, radius, wear_coefficient
        As for `ball`.
    initial_half_width : float
        Contact radius a0 at s = 0, in m.

    Returns
    -------
    ndarray
        Contact radius, in m, shaped like `distance`.
    """
    volume = wear_coefficient * load * np.asarray(distance, dtype=float)
    return np.asarray((initial_half_width**4 + 4.0 * radius * volume / np.pi) ** 0.25)
