"""What a lab computes from the sizes of scars and tracks, against shapes summed up cell by cell."""

from __future__ import annotations

import math

import numpy as np

from tribo.core.arrays import Array
from tribo.lab import ball, track
from tribo.verification.reference import Row, reference

RADIUS, GROOVE = 5e-3, 8e-3
WIDTH, LENGTH = 1e-3, 10e-3
SOURCE = "shapes summed up cell by cell"


def _rows(*found: tuple[str, str, float, float]) -> list[Row]:
    return [Row(*each, 1e-5, note="the sum's cells") for each in found]


def _middles(cells: int) -> tuple[Array, float]:
    """Return the middles of equal intervals of [-WIDTH/2, WIDTH/2], and their length."""
    spacing = WIDTH / cells
    return np.asarray((np.arange(cells) - 0.5 * (cells - 1)) * spacing, dtype=np.float64), spacing


def _segment(radius: float, cells: int) -> float:
    """Return the area between a circle and its chord."""
    y, spacing = _middles(cells)
    return float(np.sum(np.sqrt(radius**2 - y**2) - math.sqrt(radius**2 - WIDTH**2 / 4))) * spacing


@reference("volume off a ball by the size of its scar", SOURCE, 500)
def _ball(cells: int, placement: float) -> list[Row]:
    y, spacing = _middles(cells)
    x = y[:, None]
    squares = x**2 + y**2
    half, length = 0.5 * WIDTH, 0.5 * WIDTH

    def volume(depth: Array) -> float:
        return float(np.sum(np.maximum(depth, 0.0))) * spacing**2

    cap = volume(np.sqrt(RADIUS**2 - squares) - math.sqrt(RADIUS**2 - half**2))
    conforming = volume(0.5 * (half**2 - squares) * (1 / RADIUS - 1 / GROOVE))
    # Flat along x, half as long as it is wide: an ellipse worn off a cylinder along y.
    flat = volume((0.25 * length**2 * (1 - (y / half) ** 2) - x**2) / (2 * RADIUS))
    groove = ball.conforming_ball_volume(WIDTH, WIDTH, RADIUS, GROOVE)
    along = ball.flat_along_ball_volume(length, WIDTH, RADIUS)
    return _rows(
        ("flat scar, G99", "m^3", cap, ball.ball_cap_volume(WIDTH, RADIUS)),
        ("diameter of a flat scar", "m", WIDTH, ball.cap_diameter(cap, RADIUS)),
        ("scar in a groove, D7755", "m^3", conforming, groove),
        ("scar flat along sliding", "m^3", flat, along),
    )


@reference("section and volume of a track by its width", SOURCE, 500)
def _track(cells: int, placement: float) -> list[Row]:
    y, spacing = _middles(cells)
    parabola = (0.25 * WIDTH**2 - y**2) / (2 * GROOVE)
    area = track.planimetric_area(parabola, spacing)
    circle, ring = _segment(RADIUS, cells), 7 * RADIUS
    on_ring = LENGTH * _segment(0.5 * ring, cells)
    straight = LENGTH * circle + ball.ball_cap_volume(WIDTH, RADIUS)
    unworn = track.circular_groove_area(WIDTH, RADIUS)
    disk = track.disk_track_volume(WIDTH, RADIUS, LENGTH)
    to_and_fro = track.reciprocating_track_volume(WIDTH, RADIUS, LENGTH)
    block = track.block_on_ring_volume(WIDTH, ring, LENGTH)
    return _rows(
        ("section of a groove, D7755", "m^2", WIDTH**3 / (12 * GROOVE), area),
        ("radius of a groove, D7755", "m", GROOVE, track.groove_radius(WIDTH, area)),
        ("groove of an unworn ball, G99", "m^2", circle, unworn),
        ("round track, G99", "m^3", 2 * math.pi * LENGTH * circle, disk),
        ("straight track, G133", "m^3", straight, to_and_fro),
        ("block on ring, G77", "m^3", on_ring, block),
    )
