r"""A ball that slides to and fro on a flat, both wearing, in the rigid limit.

Elastic displacement is neglected beside the worn depth. The ball wears by its
local pressure, with k_b; the flat by its average along a track of length ℓ,
with k_f, so that its depth w_f depends on y alone (x is the sliding
direction). Then all of it is closed but for one quadrature and one root.

In contact, δ = (x² + y²)/2R + w_b(x, y) + w_f(y), so that at each y

- all points share dw_b/ds = k_b p = dδ/ds − dw_f/ds: p is uniform along x;
- the contact ends where w_b = 0: b² = 2R(δ − w_f) − y², with half-length b(y);
- dw_f/ds = (k_f/ℓ) 2bp, hence dw_f/dδ = qb/(1 + qb), q = 2k_f/(k_b ℓ).

With the second, the third becomes (1 + qb) d(b²) = 2R dδ, which integrates from
first touch, b = 0 at 2Rδ = y², to

    b² + ⅔ q b³ = c² − y²,        c² = 2Rδ

for the outline of the contact: half-width c across, and along, a = b(0), the
root of a² + ⅔ q a³ = c². From there, with F = ∫∫ p dx dy,

- depths: w_f = q b³/3R, and at the centre of the ball a²/2R;
- volumes: V_b = ∫ 2b³/3R dy = k_b F s, and V_f = ℓ ∫ w_f dy = k_f F s exactly;
- pressure: p = p_max/(1 + qb), with p_max = F/∫ 2b/(1 + qb) dy, at the edge y = ±c.

The worn ball stands w_f(0) higher at its centre than at the edges of its scar
across the track: its *crown* is the depth of the groove.

Validity: half-widths small beside R, elastic approach small beside the worn
depth, and a closed track. To and fro, this is the limit of the stroke average and
not of a contact that is followed along its stroke: at a stroke of 4a that leaves a
groove that is shallower by about a fifth.

References
----------
Derived here, after J. F. Archard (1953), J. Appl. Phys. 24, 981-988, and the
stroke average of J. Andersson, A. Almqvist and R. Larsson, Simulation of a
wear experiment, equation (5) with N = L.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq
from scipy.special import roots_sh_legendre

from tribo.core.arrays import Array


@dataclass(frozen=True)
class BallOnTrack:
    """The worn ball and flat at a sequence of sliding distances."""

    distance: Array
    """Sliding distance s, in m; all others have its shape."""
    half_width_along: Array
    half_width_across: Array
    """Half-widths of the contact, a along the sliding direction and c across it, in m."""
    ball_depth: Array
    """Worn depth at the centre of the ball, in m."""
    flat_depth: Array
    """Depth of the groove in the flat, which is also the crown left on the ball, in m."""
    centre_pressure: Array
    peak_pressure: Array
    """Pressure at the centre, and the largest, at the contact's edges across the track, in Pa;
    infinite at s = 0."""
    ball_volume: Array
    flat_volume: Array
    """Volumes worn off the ball and off the flat's whole track, in m³."""


def ball_on_track(
    distance: ArrayLike,
    *,
    load: float,
    radius: float,
    track_length: float,
    ball_wear_coefficient: float,
    flat_wear_coefficient: float,
) -> BallOnTrack:
    """Wear a ball and a flat against each other, rigid limit.

    Parameters
    ----------
    distance : array_like, shape (n,)
        Sliding distances s, in m; not negative, in any order.
    load, radius : float
        Normal load F, in N, and radius R of the ball, in m.
    track_length : float
        ℓ, in m: the stroke, or the circumference of the track.
    ball_wear_coefficient, flat_wear_coefficient : float
        Archard's k_b and k_f, in 1/Pa; k_b is positive, and 0 leaves the flat unworn.
    """
    s = np.atleast_1d(np.asarray(distance, dtype=float))
    q = 2.0 * flat_wear_coefficient / (ball_wear_coefficient * track_length)
    ball_volume = ball_wear_coefficient * load * s
    a = np.array([_half_width_along(volume, radius, q) for volume in ball_volume])
    peak = np.array([_peak_pressure(width, q, load) for width in a])
    return BallOnTrack(
        distance=s,
        half_width_along=a,
        half_width_across=np.sqrt(a**2 + 2.0 / 3.0 * q * a**3),
        ball_depth=a**2 / (2.0 * radius),
        flat_depth=q * a**3 / (3.0 * radius),
        centre_pressure=peak / (1.0 + q * a),
        peak_pressure=peak,
        ball_volume=ball_volume,
        flat_volume=flat_wear_coefficient * load * s,
    )


def _half_width_along(ball_volume: float, radius: float, q: float) -> float:
    # The ball alone would wear to `alone`; a groove makes the contact shorter.
    alone = (4.0 * radius * ball_volume / np.pi) ** 0.25
    if alone == 0.0:
        return 0.0
    root = brentq(
        lambda t: _ball_volume(t * alone, radius, q) / ball_volume - 1.0, 0.0, 1.0 + 1e-12
    )
    return float(root) * float(alone)


# Integrals across the track are taken over b instead of y, by parts, and b = a(1 − t²) takes
# away the root at b = a: Gauss points then give them to round-off.
_T, _WEIGHTS = roots_sh_legendre(40)


def _across(a: float, q: float) -> tuple[Array, Array]:
    """Return b and the weights of ∫ y(b) db from 0 to a."""
    u = 1.0 - _T**2
    y = a * _T * np.sqrt(1.0 + u + 2.0 / 3.0 * q * a * (1.0 + u + u**2))
    return a * u, _WEIGHTS * 2.0 * a * _T * y


def _ball_volume(a: float, radius: float, q: float) -> float:
    b, weight = _across(a, q)
    return float(4.0 / radius * np.sum(weight * b**2))


def _peak_pressure(a: float, q: float, load: float) -> float:
    b, weight = _across(a, q)
    area = 4.0 * float(np.sum(weight / (1.0 + q * b) ** 2))
    return load / area if area > 0.0 else np.inf
