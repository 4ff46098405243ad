"""The size of a wear scar, read off its depth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array, bounds
from tribo.core.grid import Grid
from tribo.core.measures import centre, lengths

VISIBLE_DEPTH = 1e-8
"""Smallest depth taken for wear, in m: about the roughness of a polished flat."""


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
    along, across = lengths(bounds(worn), grid)
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
