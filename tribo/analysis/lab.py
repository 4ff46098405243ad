"""What a tribology laboratory would report, from what it would have measured.

Volumes, sections and scars by the formulas of the test standards, so that a
simulation can be read with a laboratory's own ruler. R is the ball's radius
and d a diameter or a width, in m.

References
----------
ASTM G99 (pin or ball on disk), G133 (reciprocating ball on flat), G77 (block
on ring), D6425 and DIN 51834 (SRV), D7755 (SRV wear volume); ISO 18535 and
ISO 20808. Each function names its own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.measures import centre, extent

VISIBLE_DEPTH = 1e-8
"""Smallest depth taken for wear, in m: about the roughness of a polished flat."""


def specific_wear_rate(volume: float, load: float, distance: float) -> float:
    """Specific wear rate k = V/(F s).

    The number that ASTM G133 and ISO 18535 and 20808 report, and Archard's
    dimensional coefficient of the body that lost the volume.

    Parameters
    ----------
    volume : float
        Volume lost V, in m³.
    load : float
        Normal load F, in N.
    distance : float
        Sliding distance s, in m.

    Returns
    -------
    float
        k, in 1/Pa, the same as m³/(N·m).
    """
    return volume / (load * distance)


def in_mm3_per_newton_metre(wear_rate: float) -> float:
    """Convert a specific wear rate from 1/Pa to mm³/(N·m).

    Parameters
    ----------
    wear_rate : float
        Specific wear rate, in 1/Pa.

    Returns
    -------
    float
        The same, in mm³/(N·m): 10⁹ times as much.
    """
    return wear_rate * 1e9


def volume_from_mass(mass: float, density: float) -> float:
    """Volume lost, from a weighing (ASTM G99, section on mass loss).

    Parameters
    ----------
    mass : float
        Mass lost, in kg.
    density : float
        Density, in kg/m³.

    Returns
    -------
    float
        Volume, in m³.
    """
    return mass / density


def mass_from_volume(volume: float, density: float) -> float:
    """Mass that a balance would miss.

    Parameters
    ----------
    volume : float
        Volume lost, in m³.
    density : float
        Density, in kg/m³.

    Returns
    -------
    float
        Mass, in kg.
    """
    return volume * density


def ball_cap_depth(diameter: float, radius: float) -> float:
    """Height of the cap that a flat scar takes off a ball, R − √(R² − d²/4).

    Parameters
    ----------
    diameter : float
        Scar diameter d, in m; at most 2R.
    radius : float
        Ball radius R, in m.

    Returns
    -------
    float
        Height, in m.
    """
    half = 0.5 * diameter
    # The textbook difference loses its digits for small scars.
    return half**2 / (radius + math.sqrt(radius**2 - half**2))


def ball_cap_volume(diameter: float, radius: float) -> float:
    """Volume of the cap that a flat scar takes off a ball, exact (ASTM G99).

    V = πh(3d²/4 + h²)/6 with `ball_cap_depth` h. Only right for a flat scar: one
    that conforms to a groove has lost less, see `conforming_ball_volume`.

    Parameters
    ----------
    diameter : float
        Scar diameter d, in m.
    radius : float
        Ball radius R, in m.

    Returns
    -------
    float
        Volume, in m³.
    """
    h = ball_cap_depth(diameter, radius)
    return math.pi * h * (0.75 * diameter**2 + h**2) / 6.0


def shallow_cap_volume(diameter: float, radius: float) -> float:
    """Volume of a flat scar's cap, small scars, V = πd⁴/64R (ASTM G99).

    It is low by a part d²/12R²: 0.33 % at d = R/5, 1.35 % at d = 2R/5.

    Parameters
    ----------
    diameter : float
        Scar diameter d, in m.
    radius : float
        Ball radius R, in m.

    Returns
    -------
    float
        Volume, in m³.
    """
    return math.pi * diameter**4 / (64.0 * radius)


def cap_diameter(volume: float, radius: float) -> float:
    """Diameter of the flat scar that has lost this volume, exact.

    Inverse of `ball_cap_volume`, V = πh²(3R − h)/3, for caps up to half the
    ball.

    Parameters
    ----------
    volume : float
        Volume lost, in m³.
    radius : float
        Ball radius R, in m.

    Returns
    -------
    float
        Scar diameter d, in m.

    Notes
    -----
    With 1 − h/R = cos φ − √3 sin φ, the cubic h²(3R − h) = 3V/π becomes
    sin²(3φ/2) = 3V/4πR³.
    """
    phi = 2.0 / 3.0 * math.asin(math.sqrt(3.0 * volume / (4.0 * math.pi * radius**3)))
    h = radius * (2.0 * math.sin(0.5 * phi) ** 2 + math.sqrt(3.0) * math.sin(phi))
    return 2.0 * math.sqrt(h * (2.0 * radius - h))


def conforming_ball_volume(along: float, across: float, radius: float, groove: float) -> float:
    """Volume off a ball whose scar conforms to a groove (ASTM D7755, DIN 51834).

    V = (π/64) d∥² d⊥² (1/R − 1/R'), with the groove's radius R' from
    `groove_radius`. The flat cap is the limit R' → ∞.

    Parameters
    ----------
    along, across : float
        Scar diameters d∥ and d⊥ along and across the sliding direction, in m.
    radius : float
        Ball radius R, in m.
    groove : float
        Radius R' of the groove's section, in m; larger than R.

    Returns
    -------
    float
        Volume, in m³.

    Notes
    -----
    The form supposes a scar as long as it is wide. One worn flat along the
    sliding direction in a parabolic groove obeys d∥² = d⊥² (1 − R/R') and has
    lost d⊥/d∥ times as much as the formula says.
    """
    return math.pi / 64.0 * along**2 * across**2 * (1.0 / radius - 1.0 / groove)


def groove_radius(width: float, area: float) -> float:
    """Radius of a groove from its width and its section, R' = d⊥³/12W_q (ASTM D7755).

    It takes the groove for a parabola of width d⊥ and section W_q.

    Parameters
    ----------
    width : float
        Width d⊥ of the track, in m.
    area : float
        Section W_q, in m²; see `planimetric_area`.

    Returns
    -------
    float
        Radius, in m.
    """
    return width**3 / (12.0 * area)


def planimetric_area(depth: ArrayLike, spacing: float) -> float:
    """Section of a track below the original surface, W_q (ASTM D7755, G133).

    Material piled up above the original surface is not subtracted.

    Parameters
    ----------
    depth : array_like, shape (n,)
        Depth below the original surface across the track, at the centres of
        equal intervals, in m; negative above.
    spacing : float
        Interval, in m.

    Returns
    -------
    float
        Area, in m².
    """
    return float(np.sum(np.maximum(np.asarray(depth, dtype=float), 0.0))) * spacing


def planimetric_volume(area: float, track_length: float) -> float:
    """Volume of a track from one section, V = W_q ℓ (ASTM G133, D7755).

    The rounded ends of a reciprocating track are not part of it.

    Parameters
    ----------
    area : float
        Section W_q, in m².
    track_length : float
        Stroke, or 2πr of a circular track, in m.

    Returns
    -------
    float
        Volume, in m³.
    """
    return area * track_length


def circular_groove_area(width: float, radius: float) -> float:
    """Section of a track with the shape of an unworn ball (ASTM G99).

    A = R² asin(d/2R) − (d/4)√(4R² − d²).

    Parameters
    ----------
    width : float
        Width d of the track, in m; at most 2R.
    radius : float
        Ball radius R, in m.

    Returns
    -------
    float
        Area, in m².
    """
    return radius**2 * math.asin(width / (2.0 * radius)) - 0.25 * width * math.sqrt(
        4.0 * radius**2 - width**2
    )


def disk_track_volume(width: float, radius: float, track_radius: float) -> float:
    """Volume of a circular track with the shape of an unworn ball (ASTM G99).

    V = 2πr A with `circular_groove_area` A.

    Parameters
    ----------
    width : float
        Width of the track, in m.
    radius : float
        Ball radius R, in m.
    track_radius : float
        Radius r of the track, in m.

    Returns
    -------
    float
        Volume, in m³.
    """
    return 2.0 * math.pi * track_radius * circular_groove_area(width, radius)


def reciprocating_track_volume(width: float, radius: float, stroke: float) -> float:
    """Volume of a straight track with the shape of an unworn ball, ends included.

    `circular_groove_area` times the stroke, and half a ball cap at each end
    (after ASTM G133).

    Parameters
    ----------
    width : float
        Width of the track, in m.
    radius : float
        Ball radius R, in m.
    stroke : float
        Stroke, in m.

    Returns
    -------
    float
        Volume, in m³.
    """
    return stroke * circular_groove_area(width, radius) + ball_cap_volume(width, radius)


def block_on_ring_volume(scar_width: float, ring_diameter: float, block_width: float) -> float:
    """Volume off the block of a block-on-ring test (ASTM G77).

    V = (D²t/8)(2θ − sin 2θ), θ = asin(b/D).

    Parameters
    ----------
    scar_width : float
        Mean scar width b, in m; at most D.
    ring_diameter : float
        Ring diameter D, in m.
    block_width : float
        Block width t, in m.

    Returns
    -------
    float
        Volume, in m³.
    """
    twice = 2.0 * math.asin(scar_width / ring_diameter)
    return ring_diameter**2 * block_width / 8.0 * (twice - math.sin(twice))


@dataclass(frozen=True)
class Scar:
    """A wear scar as a microscope and a profilometer see it.

    Parameters
    ----------
    along : float
        Diameter along the sliding direction, d∥, in m.
    across : float
        Diameter across it, d⊥, in m.
    mean_diameter : float
        Mean of the two, the wear scar diameter WSD of ASTM D6425, in m.
    centre_depth : float
        Worn depth at the centre of the window, in m.
    peak_depth : float
        Largest worn depth, in m.
    volume : float
        Integral of the whole depth field over the window, in m³.
    """

    along: float
    across: float
    mean_diameter: float
    centre_depth: float
    peak_depth: float
    volume: float


def scar(depth: Array, grid: Grid, visible: float = VISIBLE_DEPTH) -> Scar:
    """Measure a scar (ASTM D6425, DIN 51834: diameters along and across).

    A diameter is the extent, in whole cells, of all that is worn deeper than
    `visible`; so it is uncertain by a cell. On a ball worn by a depth a²/2R the
    threshold hides a rim of about R·visible/a: 0.1 µm at the default for R =
    5 mm and a = 0.5 mm.

    Parameters
    ----------
    depth : ndarray, shape (nx, ny)
        Worn depth, in m; x along the sliding direction.
    grid : Grid
        The window.
    visible : float, default 1e-8
        Smallest depth taken for wear, in m.

    Returns
    -------
    Scar
        With diameters 0 where nothing is worn visibly.
    """
    worn = depth > visible
    along = extent(np.asarray(worn.any(axis=1))) * grid.spacing[0]
    across = extent(np.asarray(worn.any(axis=0))) * grid.spacing[1]
    return Scar(
        along=along,
        across=across,
        mean_diameter=0.5 * (along + across),
        centre_depth=centre(depth),
        peak_depth=float(np.max(depth)),
        volume=float(np.sum(depth)) * grid.cell_area,
    )


def crown(height: Array, depth: Array, visible: float = VISIBLE_DEPTH) -> float:
    """How far a worn profile bulges over the chord between the edges of its scar.

    The edges are the outermost points worn deeper than `visible`. A ball worn
    flat has crown 0 along its sliding direction; across it the crown is the
    depth of the groove the ball runs in.

    Parameters
    ----------
    height : ndarray, shape (n,)
        Worn surface along the profile, outward from its body, in m, at equal
        intervals.
    depth : ndarray, shape (n,)
        Depth worn off it, in m.
    visible : float, default 1e-8
        Smallest depth taken for wear, in m.

    Returns
    -------
    float
        Largest height over the chord, in m; 0 for a hollow or unworn profile.
    """
    if height.ndim != 1 or height.shape != depth.shape:
        raise ValueError(
            f"crown takes two profiles of one length, not shapes {height.shape} and {depth.shape}"
        )
    index = np.flatnonzero(depth > visible)
    if index.size < 2:
        return 0.0
    first, last = int(index[0]), int(index[-1])
    part = height[first : last + 1]
    chord = np.linspace(part[0], part[-1], part.size)
    return float(np.max(part - chord))
