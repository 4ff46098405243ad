"""The size of a wear scar, read off its depth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import make_interp_spline

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.measures import centre, vertex
from tribo.results.body import BodyResult

VISIBLE = 1e-3
"""Smallest depth taken for wear, or power of it, as a part of the largest."""
SCAR, TRACK = 1.0, 1.5
"""Powers of the distance from the edge with which depth begins: in a scar, across a track."""


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

    @property
    def diameters(self) -> tuple[float, float]:
        """Those along and across, in m."""
        return self.along, self.across


def scar_of(body: BodyResult, grid: Grid, save: int = -1) -> Scar:
    """Measure the scar of a body, or its track, at a save."""
    return scar(body.wear_depth[save], grid, TRACK if body.swept else SCAR)


def scar(depth: Array, grid: Grid, power: float = SCAR) -> Scar:
    """Measure a scar (ASTM D6425, DIN 51834: diameters along and across).

    Parameters
    ----------
    depth : ndarray, shape (nx, ny)
        Worn depth, in m; x along the sliding direction.
    grid : Grid
        The window.
    power : float, default 1
        Power of the distance from the edge with which the depth begins: `SCAR`, or `TRACK` for a
        body that is swept through the contact.

    Returns
    -------
    Scar
        With diameters 0 where nothing is worn.
    """
    along, across = (diameter(depth, axis, grid.spacing[axis], power) for axis in (0, 1))
    return Scar(
        along=along,
        across=across,
        mean_diameter=0.5 * (along + across),
        centre_depth=centre(depth),
        peak_depth=float(np.max(depth)),
        volume=float(np.sum(depth)) * grid.cell_area,
    )


def diameter(depth: Array, axis: int, spacing: float, power: float = SCAR) -> float:
    """Extent of a scar along `axis`, to a fraction of a cell.

    An edge lies where the parabola through the three outermost worn cells comes
    to 0: in a scar through their depths, as a ball worn flat has lost a
    paraboloid; across a track through their depths to the power 2/3, as the
    chord of the ball that wears it is cubed in its section. So it is good to a
    tenth of a cell, and to a third in the first nanometres under a Hertz
    contact. A cell is worn where that is more than a thousandth of its largest.

    Parameters
    ----------
    depth : ndarray, shape (nx, ny)
        Worn depth, in m.
    axis : int
        0 along the sliding direction, 1 across it.
    spacing : float
        Edge length of a cell along `axis`, in m.
    power : float, default 1
        As for `scar`.

    Returns
    -------
    float
        In m; 0 where nothing is worn.
    """
    ends = _ends(np.max(depth, axis=1 - axis), power)
    return 0.0 if ends is None else (ends[1] - ends[0]) * spacing


def crown(height: Array, depth: Array) -> float:
    """How far a worn profile bulges over the chord between the edges of its scar.

    The edges are those of `diameter`. A ball worn flat has crown 0 along its
    sliding direction; across it the crown is the depth of the groove the ball
    runs in.

    Parameters
    ----------
    height : ndarray, shape (n,)
        Worn surface along the profile, outward from its body, in m, at equal
        intervals.
    depth : ndarray, shape (n,)
        Depth worn off it, in m.

    Returns
    -------
    float
        Largest height over the chord, in m; 0 for a hollow or unworn profile.
    """
    if height.ndim != 1 or height.shape != depth.shape:
        raise ValueError(
            f"crown takes two profiles of one length, not shapes {height.shape} and {depth.shape}"
        )
    ends = _ends(depth, SCAR)
    if ends is None or depth.size < 3:
        return 0.0
    cells = np.arange(depth.size)
    # Unworn, the surface has no kink at the edges.
    feet = make_interp_spline(cells, height + depth, k=2)(ends)
    bulge = height - np.interp(cells, ends, feet)
    inside = np.flatnonzero((cells > ends[0]) & (cells < ends[1]))
    top = int(inside[np.argmax(bulge[inside])])
    return max(vertex(bulge[max(top - 1, 0) : top + 2]), 0.0)


def _ends(line: Array, power: float) -> tuple[float, float] | None:
    """Return the edges of what is worn of a line, counted in cells from the first's centre."""
    straight = np.maximum(line, 0.0) ** (1 / power)
    worn = np.flatnonzero(straight > VISIBLE * float(np.max(straight)))
    if worn.size == 0:
        return None
    first, last = int(worn[0]), int(worn[-1])
    if last - first + 1 < 3:
        return first - 0.5, last + 0.5
    below = _beyond(straight[first : first + 3], 0.5 if first == 0 else 1.0)
    above = _beyond(straight[last - 2 : last + 1][::-1], 0.5 if last == line.size - 1 else 1.0)
    return first - below, last + above


def _beyond(rim: Array, most: float) -> float:
    """Return how far beyond the first of three cells, inwards, the edge lies, in cells."""
    outer, middle, inner = (float(each) for each in rim)
    bend = 0.5 * (inner - 2 * middle + outer)
    fall = middle - outer - bend
    if fall <= 0:
        return 0.5
    root = max(fall**2 - 4 * bend * outer, 0.0) ** 0.5
    return min(2 * outer / (fall + root), most)
