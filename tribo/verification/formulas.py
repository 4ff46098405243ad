"""What a lab computes from the sizes of scars and tracks, against shapes summed up cell by cell."""

from __future__ import annotations

import math

import numpy as np

from tribo.core.arrays import Array
from tribo.lab import ball, track
from tribo.verification.check import Check, Found, Quantity

RADIUS, GROOVE = 5e-3, 8e-3
WIDTH, LENGTH = 1e-3, 10e-3


def _middles(width: float, cells: int) -> tuple[Array, float]:
    """Return the middles of equal intervals of [-width/2, width/2], and their length."""
    spacing = width / cells
    return np.asarray((np.arange(cells) - 0.5 * (cells - 1)) * spacing, dtype=np.float64), spacing


def _segment(radius: float, width: float, cells: int) -> float:
    """Return the area between a circle and its chord."""
    y, spacing = _middles(width, cells)
    return float(np.sum(np.sqrt(radius**2 - y**2) - math.sqrt(radius**2 - width**2 / 4))) * spacing


def _ball(cells: int, placement: float) -> Found:
    y, spacing = _middles(WIDTH, cells)
    x = y[:, None]
    squares = x**2 + y**2
    half = 0.5 * WIDTH

    def volume(depth: Array) -> float:
        return float(np.sum(np.maximum(depth, 0.0))) * spacing**2

    below = math.sqrt(RADIUS**2 - half**2)
    cap = volume(np.sqrt(RADIUS**2 - squares) - below)
    parabolic = volume((half**2 - squares) / (2 * RADIUS))
    conforming = volume(0.5 * (half**2 - squares) * (1 / RADIUS - 1 / GROOVE))
    # Flat along x, half as long as it is wide: an ellipse worn off a cylinder along y.
    length = 0.5 * WIDTH
    flat = volume((0.25 * length**2 * (1 - (y / half) ** 2) - x**2) / (2 * RADIUS))
    return {
        "flat scar, G99": (cap, ball.ball_cap_volume(WIDTH, RADIUS)),
        "flat scar, G99, shallow": (parabolic, ball.shallow_cap_volume(WIDTH, RADIUS)),
        "diameter of a flat scar": (WIDTH, ball.cap_diameter(cap, RADIUS)),
        "scar in a groove, D7755": (
            conforming,
            ball.conforming_ball_volume(WIDTH, WIDTH, RADIUS, GROOVE),
        ),
        "scar flat along sliding": (flat, ball.flat_along_ball_volume(length, WIDTH, RADIUS)),
    }


def _track(cells: int, placement: float) -> Found:
    y, spacing = _middles(WIDTH, cells)
    parabola = (0.25 * WIDTH**2 - y**2) / (2 * GROOVE)
    area = track.planimetric_area(parabola, spacing)
    circle = _segment(RADIUS, WIDTH, cells)
    ends = ball.ball_cap_volume(WIDTH, RADIUS)
    ring = 7 * RADIUS
    return {
        "section of a groove, D7755": (WIDTH**3 / (12 * GROOVE), area),
        "radius of a groove, D7755": (GROOVE, track.groove_radius(WIDTH, area)),
        "volume of a track, D7755": (
            float(np.sum(parabola)) * spacing * LENGTH,
            track.planimetric_volume(area, LENGTH),
        ),
        "groove of an unworn ball, G99": (circle, track.circular_groove_area(WIDTH, RADIUS)),
        "round track, G99": (
            2 * math.pi * LENGTH * circle,
            track.disk_track_volume(WIDTH, RADIUS, LENGTH),
        ),
        "straight track, G133": (
            LENGTH * circle + ends,
            track.reciprocating_track_volume(WIDTH, RADIUS, LENGTH),
        ),
        "block on ring, G77": (
            LENGTH * _segment(0.5 * ring, WIDTH, cells),
            track.block_on_ring_volume(WIDTH, ring, LENGTH),
        ),
    }


SOURCE = "shapes summed up cell by cell"
NOTE = "the sum's cells"
CHECKS = (
    Check(
        "volume off a ball by the size of its scar",
        SOURCE,
        _ball,
        (
            Quantity("flat scar, G99", "m^3", 1e-5, note=NOTE),
            Quantity("flat scar, G99, shallow", "m^3", 1e-5, note=NOTE),
            Quantity("diameter of a flat scar", "m", 1e-5, note=NOTE),
            Quantity("scar in a groove, D7755", "m^3", 1e-5, note=NOTE),
            Quantity("scar flat along sliding", "m^3", 1e-5, note=NOTE),
        ),
        levels=(500,),
        cost=0.1,
    ),
    Check(
        "section and volume of a track by its width",
        SOURCE,
        _track,
        (
            Quantity("section of a groove, D7755", "m^2", 1e-5, note=NOTE),
            Quantity("radius of a groove, D7755", "m", 1e-5, note=NOTE),
            Quantity("volume of a track, D7755", "m^3", 1e-5, note=NOTE),
            Quantity("groove of an unworn ball, G99", "m^2", 1e-5, note=NOTE),
            Quantity("round track, G99", "m^3", 1e-5, note=NOTE),
            Quantity("straight track, G133", "m^3", 1e-5, note=NOTE),
            Quantity("block on ring, G77", "m^3", 1e-5, note=NOTE),
        ),
        levels=(500,),
        cost=0.1,
    ),
)
