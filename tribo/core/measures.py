"""Scalars read off a contact: centre, half-widths, area, depths, volumes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from tribo.core.arrays import Array, Mask
from tribo.core.contact import ContactSolution, Residuals
from tribo.core.grid import Grid


@dataclass(frozen=True)
class BodyMeasures:
    """Depths in m and the worn volume in m³ of one body.

    The volume belongs to the whole scar, or to the whole track.

    Examples
    --------
    >>> ball = tribo.BodyMeasures(4e-6, 4e-6, wear_volume=3e-13, max_plastic_depth=0.0)
    >>> force, path = 100.0, 10.0
    >>> round(1e9 * ball.wear_volume / (force * path), 12)  # specific wear rate in mm³/(N m)
    3e-07
    """

    max_wear_depth: float
    centre_wear_depth: float
    wear_volume: float
    max_plastic_depth: float


@dataclass(frozen=True)
class Invariants:
    """Errors of a step in its invariants, 0 if they hold.

    Parameters
    ----------
    volume : float
        Difference of the volume that a body lost in the step from the volume by its law,
        relative to the latter; the worst body's.
    regrowth : float
        Depth by which a point has grown back, in m.

    Examples
    --------
    >>> tribo.Invariants(regrowth=1e-9).regrowth > 0  # a run stops
    True
    """

    volume: float = 0.0
    regrowth: float = 0.0


@dataclass(frozen=True)
class Measures:
    """Scalars of one moment, in SI units, as the columns of a result describe them.

    Examples
    --------
    >>> class Peak(tribo.Observer):
    ...     type = "my.peak"
    ...     def on_finish(self, snapshot, reason):
    ...         print(f"{1e-6 * snapshot.measures.max_pressure:.0f} MPa")
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> result = case.run(observers=[Peak()])
    2146 MPa
    """

    time: float
    distance: float
    load: float
    load_distance: float
    max_pressure: float
    centre_pressure: float
    half_width_x: float
    half_width_y: float
    area: float
    plastic_area: float
    approach: float
    residuals: Residuals
    contact_solves: int
    solver_iterations: int
    bodies: Mapping[str, BodyMeasures]
    invariants: Invariants = field(default_factory=Invariants)
    friction_force: float = math.nan
    friction_energy: float = math.nan


def centre(field: Array) -> float:
    """Mean of the middle 1, 2 or 4 cells of `field`; an axis of length 1 is kept."""
    nx, ny = field.shape
    middle = field[(nx - 1) // 2 : nx // 2 + 1, (ny - 1) // 2 : ny // 2 + 1]
    return float(np.mean(middle))


def half_widths(contact: ContactSolution, grid: Grid) -> tuple[float, float]:
    """Half the extent of {p > 0} along x and along y, in m."""
    (rows, columns), (dx, dy) = contact.extent, grid.spacing
    return 0.5 * (rows.stop - rows.start) * dx, 0.5 * (columns.stop - columns.start) * dy


def contact_area(pressure: Array | Mask, grid: Grid) -> float:
    """Area of the cells that carry pressure, or that a mask has, in m²."""
    return int(np.count_nonzero(pressure > 0)) * grid.cell_area


def reaches_border(pressure: Array) -> bool:
    """Whether the contact reaches the border of the window."""
    edges = pressure[0], pressure[-1], pressure[:, 0], pressure[:, -1]
    return any(bool((edge > 0).any()) for edge in edges)


def vertex(three: Array) -> float:
    """Top of the parabola through three values at equal intervals, the middle one the largest.

    The largest value where there are fewer, as at a border, or where they do not bend.
    """
    if three.size < 3:
        return float(np.max(three))
    before, top, after = (float(each) for each in three)
    bend = 2 * top - before - after
    return top + (after - before) ** 2 / (8 * bend) if bend > 0 else top


def between_cells(field: Array) -> float:
    """Height of a smooth field's top above its largest cell, by parabolas through neighbours."""
    i, j = np.unravel_index(np.argmax(field), field.shape)
    top = float(field[i, j])
    along, across = field[max(i - 1, 0) : i + 2, j], field[i, max(j - 1, 0) : j + 2]
    return vertex(along) + vertex(across) - 2 * top
