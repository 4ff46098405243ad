"""What a track or the block on a ring has lost, by width and section.

All lengths in m, sections in m², volumes in m³: `radius` R of the ball; `width` d
of the track, at most 2R; `area` W_q of its section. The formulas are those of the
standards named, derived again from the geometry; the tests integrate the shapes
they stand for.

References
----------
ASTM G99 (ball on disk), G133 (reciprocating ball on flat), D7755 (SRV, wear
volume), G77 (block on ring); ISO 18535 and ISO 20808.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from tribo.lab.ball import ball_cap_volume


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


def disk_track_volume(width: float, radius: float, track_radius: float) -> float:
    """Volume of a track of radius r with the shape of an unworn ball, V = 2πr A (ASTM G99).

    A is `circular_groove_area`.
    """
    return 2.0 * math.pi * track_radius * circular_groove_area(width, radius)


def reciprocating_track_volume(width: float, radius: float, stroke: float) -> float:
    """Volume of a straight track with the shape of an unworn ball, ends included.

    `circular_groove_area` times the stroke, and half a ball cap at each end
    (after ASTM G133).
    """
    return stroke * circular_groove_area(width, radius) + ball_cap_volume(width, radius)


def block_on_ring_volume(scar_width: float, ring_diameter: float, block_width: float) -> float:
    """Volume off the block of a block-on-ring test (ASTM G77).

    V = (D²t/8)(2θ − sin 2θ), θ = asin(b/D), with the mean scar width b, at most
    the ring's diameter D, and the width t of the block.
    """
    twice = 2.0 * math.asin(scar_width / ring_diameter)
    return ring_diameter**2 * block_width / 8.0 * (twice - math.sin(twice))
