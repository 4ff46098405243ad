"""Diameters and crown of a wear scar, from its depth."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import scipy

from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.core.measures import vertex
from tribo.result.read import Result

VISIBLE = 1e-4
"""Depth, relative to the largest, above which a cell is worn."""
STEEPEST = 2.0
"""Largest exponent of the depth in the distance from the edge."""


class Scar(NamedTuple):
    """A wear scar as a microscope sees it, 0 wide where nothing is worn.

    Parameters
    ----------
    along, across : float
        Diameters d∥ and d⊥ along and across the sliding direction, in m.
    """

    along: float
    across: float

    @property
    def mean_diameter(self) -> float:
        """Mean of the two, the wear scar diameter WSD of ASTM D6425, in m."""
        return 0.5 * (self.along + self.across)


def scar(depth: Array, grid: Grid) -> Scar:
    """Measure a scar (ASTM D6425, DIN 51834: diameters along and across).

    Parameters
    ----------
    depth : ndarray, shape (nx, ny)
        Worn depth, in m; x along the sliding direction.
    grid : Grid
        The window.
    """
    return Scar(*(diameter(depth, axis, grid.spacing[axis]) for axis in (0, 1)))


def diameter(depth: Array, axis: int, spacing: float) -> float:
    """Extent of a scar along `axis`, to a fraction of a cell.

    An edge lies where the parabola through the three outermost worn cells
    reaches 0, as a ball worn flat has lost a paraboloid. Grooves, and scars of elastic
    bodies, end in a flat toe: there the parabola goes through a root of the depths,
    whose exponent follows from a fourth cell. The error is a tenth of a cell for a
    scar ten cells wide, and a third of a cell in its first nanometres. A cell is
    worn if it is deeper than 10⁻⁴ of the largest depth.

    Parameters
    ----------
    depth : ndarray, shape (nx, ny)
        Worn depth, in m.
    axis : int
        0 along the sliding direction, 1 across it.
    spacing : float
        Edge length of a cell along `axis`, in m.

    Returns
    -------
    float
        In m; 0 where nothing is worn.
    """
    ends = _ends(np.max(depth, axis=1 - axis))
    return 0.0 if ends is None else (ends[1] - ends[0]) * spacing


def removed(result: Result, name: str) -> Array:
    """Return the depth of a body's surface below its first surface at each save, in m."""
    body = result.body(name)
    return np.asarray(body.wear_depth + body.plastic_depth)


def scar_mask(depth: Array) -> Mask:
    """Return the cells worn deeper than a thousandth of the largest depth."""
    deepest = float(np.max(depth, initial=0.0))
    return np.asarray(depth > 1e-3 * deepest)


def crown(height: Array, depth: Array) -> float:
    """Height of a worn profile over the chord between the edges of its scar.

    The edges are as in `diameter`. A ball worn flat has crown 0 along its
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
    ends = _ends(depth)
    if ends is None or depth.size < 3:
        return 0.0
    cells = np.arange(depth.size)
    # Unworn, the surface has no kink at the edges.
    feet = scipy.interpolate.make_interp_spline(cells, height + depth, k=2)(ends)
    bulge = height - np.interp(cells, ends, feet)
    inside = np.flatnonzero((cells > ends[0]) & (cells < ends[1]))
    top = int(inside[np.argmax(bulge[inside])])
    return max(vertex(bulge[max(top - 1, 0) : top + 2]), 0.0)


def _ends(line: Array) -> tuple[float, float] | None:
    """Return the edges of the scar on a line, in cells from the centre of the first."""
    index = np.flatnonzero(line > VISIBLE * max(float(np.max(line)), 0.0))
    if index.size == 0:
        return None
    first, last = int(index[0]), int(index[-1])
    worn = np.maximum(line[first : last + 1], 0.0)
    below = min(_extrapolated(worn[:4]), 0.5 if first == 0 else 1.0)
    above = min(_extrapolated(worn[:-5:-1]), 0.5 if last == line.size - 1 else 1.0)
    return first - below, last + above


def _extrapolated(cells: Array) -> float:
    """Return the distance of the edge beyond the first cell; a half if cells do not deepen."""
    if cells.size < 3 or cells[1] <= cells[0]:
        return 0.5

    def toe(power: float) -> float:
        """Return how much further out the inner three cells put the edge than the outer three."""
        straight = cells ** (1 / power)
        return _root(straight[1:]) - 1 - _root(straight[:3])

    power = 1.0
    if cells.size == 4 and toe(1.0) < 0:
        power = STEEPEST
        if toe(STEEPEST) > 0:
            power = float(scipy.optimize.brentq(toe, 1.0, STEEPEST, xtol=1e-4))
    return _root(cells[:3] ** (1 / power))


def _root(three: Array) -> float:
    """Return the distance beyond the first of three values at which their parabola reaches 0.

    It is 3 at most.
    """
    outer, middle, inner = (float(each) for each in three)
    bend = 0.5 * (inner - 2 * middle + outer)
    fall = middle - outer - bend
    if fall <= 0:
        return 3.0
    return min(2 * outer / (fall + math.sqrt(max(fall**2 - 4 * bend * outer, 0.0))), 3.0)
