"""The volumes lost by a ball and its track, from the size of the scar and the track's section.

All lengths in m, sections in m², volumes in m³: `radius` R of the ball; `diameter` d of its scar,
`along` d∥ and `across` d⊥ the sliding direction; `width` d of a track, both at most 2R; `area` W_q
of its section; `groove` R', the radius of the section. The formulas are from the standards named,
derived again from the geometry; ``tribo verify lab_formulas`` integrates the shapes that they
assume.

References
----------
ASTM G99 (pin or ball on disk), G133 (reciprocating ball on flat), D6425 and DIN 51834 (SRV), D7755
(SRV, wear volume); ISO 20808.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike


def ball_cap_depth(diameter: float, radius: float) -> float:
    """Height of the cap that a flat scar takes off a ball, R − √(R² − d²/4) (ASTM G99)."""
    half = 0.5 * diameter
    # The textbook difference loses its digits for small scars.
    return half**2 / (radius + math.sqrt(radius**2 - half**2))


def ball_cap_volume(diameter: float, radius: float) -> float:
    """Volume of the cap that a flat scar takes off a ball, exact (ASTM G99).

    V = πh(3d²/4 + h²)/6 with `ball_cap_depth` h. Only right for a flat scar: a
    scar that conforms to a groove has lost less, see `conforming_ball_volume`.
    """
    h = ball_cap_depth(diameter, radius)
    return math.pi * h * (0.75 * diameter**2 + h**2) / 6.0


def conforming_ball_volume(along: float, across: float, radius: float, groove: float) -> float:
    """Volume off a ball whose scar conforms to a groove (ASTM D7755, DIN 51834).

    V = (π/64) d∥² d⊥² (1/R − 1/R'), R' > R from `groove_radius`. The flat cap is the limit
    R' → ∞.

    Notes
    -----
    The form supposes a scar as long as it is wide. A scar worn flat along the
    sliding direction in a parabolic groove obeys d∥² = d⊥² (1 − R/R') and has
    lost d⊥/d∥ times the volume of the formula, πd∥³d⊥/64R.
    """
    return math.pi / 64.0 * along**2 * across**2 * (1.0 / radius - 1.0 / groove)


def groove_radius(width: float, area: float) -> float:
    """Radius of a groove from its width and its section, R' = d³/12W_q (ASTM D7755).

    It takes the groove for a parabola.
    """
    return width**3 / (12.0 * area)


def planimetric_area(depth: ArrayLike, spacing: float) -> float:
    """Section of a track below the original surface, W_q (ASTM D7755, G133, ISO 20808).

    Of several profiles, as a lab takes them along the track, it is the mean.
    Material piled up above the original surface is not subtracted.

    Parameters
    ----------
    depth : array_like, shape (n,) or (profiles, n)
        Depth below the original surface across the track, at the centres of
        equal intervals; negative above.
    spacing : float
        Interval.
    """
    below = np.maximum(np.asarray(depth, dtype=float), 0.0)
    return float(np.mean(np.sum(below, axis=-1))) * spacing


def circular_groove_area(width: float, radius: float) -> float:
    """Section of a track with the shape of an unworn ball (ASTM G99).

    A = R² asin(d/2R) − (d/4)√(4R² − d²), a segment of the ball's section. Where the
    ball wears too the track is shallower than that.
    """
    half_angle = math.asin(width / (2.0 * radius))
    return radius**2 * half_angle - 0.25 * width * math.sqrt(4.0 * radius**2 - width**2)


def reciprocating_track_volume(width: float, radius: float, stroke: float) -> float:
    """Volume of a straight track with the shape of an unworn ball, ends included.

    `circular_groove_area` times the stroke, and half a ball cap at each end
    (after ASTM G133).
    """
    return stroke * circular_groove_area(width, radius) + ball_cap_volume(width, radius)
