"""A contact problem and its solution."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from tribo.core.arrays import Array, Cell, Region, bounds, region
from tribo.core.box import Box
from tribo.core.coating import Coating
from tribo.core.grid import Grid
from tribo.core.material import Material


@dataclass(frozen=True)
class WearCompliance:
    """The wear of an implicit step, as additional compliance.

    It adds to the elastic displacement ``K p`` the depth that the step wears
    away, so that the operator becomes::

        A p = K p + local * p + swept * dx * sum_x(p)

    which is symmetric and positive definite whenever K is.

    Parameters
    ----------
    local : ndarray, shape (nx, ny)
        Depth per pressure on bodies that are stationary in the contact frame,
        in m/Pa; not negative.
    swept : ndarray, shape (ny,)
        Depth per line load on bodies swept through the contact, in 1/Pa;
        not negative.

    Examples
    --------
    >>> k, slid = 1e-15, 2.0  # Archard's law, in 1/Pa, over 2 m
    >>> ball = tribo.WearCompliance(local=np.full((1, 1), k * slid), swept=np.zeros(1))
    >>> float(1e6 * ball.depth(np.full((1, 1), 1e9), dx=1e-5)[0, 0].round(9))  # µm
    2.0
    """

    local: Array
    swept: Array

    def depth(self, pressure: Array, dx: float) -> Array:
        """Return the depth worn under `pressure` (nx, ny) on cells `dx` long, in m."""
        return np.asarray(self.local * pressure + self.swept * (dx * np.sum(pressure, axis=0)))

    def on(self, box: Box) -> WearCompliance:
        """Return its part on a box."""
        return WearCompliance(self.local[box.slices], self.swept[box.slices[1]])

    def typical(self, length: float) -> tuple[float, float]:
        """Return its mean depths per pressure, in m/Pa: by a cell, and by rows of a length (m)."""
        return mean_where_positive(self.local), length * mean_where_positive(self.swept)


@dataclass(frozen=True)
class CycleCompliance:
    """The wear of an implicit step at the positions of a cycle, as additional compliance.

    The wear of a body at one position changes its gap at the others. With Tₘ cutting the window out
    of the body's own surface at position m, and ωₘ the share of the path spent there::

        (A p)ₘ = K pₘ + Σ over bodies Tₘ c Σₙ ωₙ Tₙᵀ pₙ

    which is symmetric and positive definite in the product Σₘ ωₘ pₘᵀ qₘ whenever K is.

    Parameters
    ----------
    shares : ndarray, shape (positions,)
        ω, which add up to 1.
    bodies : sequence of (ndarray, sequence of Cell)
        For each body that wears: c, shape (rows, ny), its depth per pressure on its own surface,
        in m/Pa, not negative; and the cell at which the window begins there, by position. Rows and
        columns are counted round.
    rows : slice
        Rows of the window in which there is pressure.
    mirrored : bool, optional
        Whether each position stands for another too, that mirrors it along x; one in the middle of
        the cycle for itself, twice.

    Examples
    --------
    >>> disk = np.full((3, 1), 1e-15)  # 3 rows, of which the window is on 2 at a time
    >>> cycle = tribo.CycleCompliance(np.array([0.5, 0.5]), [(disk, [(0, 0), (1, 0)])], slice(0, 2))
    >>> worn = cycle.depth(np.full((2, 2, 1), 1e9), dx=1e-5)
    >>> (1e6 * worn[:, :, 0]).round(3).tolist()  # µm: both positions wear the middle row
    [[0.5, 1.0], [1.0, 0.5]]
    """

    shares: Array
    bodies: Sequence[tuple[Array, Sequence[Cell]]]
    rows: slice
    mirrored: bool = False

    def depth(self, pressure: Array, dx: float) -> Array:
        """Return the depth worn under `pressure` (positions, nx, ny); it does not depend on dx."""
        worn = self.gather(pressure)
        for own, (compliance, _) in zip(worn, self.bodies, strict=True):
            own *= compliance
        return self.see(worn, pressure.shape)

    def gather(self, fields: Array) -> list[Array]:
        """Return Σₙ ωₙ Tₙᵀ of fields (positions, nx, ny) on each body's own surface."""
        gathered = [np.zeros_like(compliance) for compliance, _ in self.bodies]
        # All bodies at one position after the other: its part stays in the processor's cache.
        for share, part, regions in zip(
            self.shares, fields, self._windows(fields.shape), strict=True
        ):
            weighed = share * part
            for own, here in zip(gathered, regions, strict=True):
                own[here] += weighed
        return [own + own[::-1] for own in gathered] if self.mirrored else gathered

    def see(self, of_bodies: Sequence[Array], shape: tuple[int, ...]) -> Array:
        """Return the sum of Tₘ of the bodies' fields at each position, of `shape`."""
        seen = np.zeros(shape)
        for part, regions in zip(seen, self._windows(shape), strict=True):
            for own, here in zip(of_bodies, regions, strict=True):
                part += own[here]
        return seen

    def _windows(self, shape: tuple[int, ...]) -> list[list[Any]]:
        """Return the index of the window on each body's own surface, by position; found once."""
        if shape not in self._indices:
            self._indices[shape] = [
                [
                    region(own, (self.rows.start + cells[m][0], cells[m][1]), shape[1:])
                    for own, cells in self.bodies
                ]
                for m in range(shape[0])
            ]
        return self._indices[shape]

    @cached_property
    def _indices(self) -> dict[tuple[int, ...], list[list[Any]]]:
        return {}

    def on(self, box: Box) -> CycleCompliance:
        """Return its part on a box of the window."""
        along, columns = box.slices
        return replace(self.beside(columns), rows=along)

    def beside(self, columns: slice) -> CycleCompliance:
        """Return its part on some columns of the window."""
        bodies: list[tuple[Array, Sequence[Cell]]] = []
        for compliance, cells in self.bodies:
            if any(column for _, column in cells):
                moved = [(row, column + columns.start) for row, column in cells]
                bodies.append((compliance, moved))
            else:
                bodies.append((compliance[:, columns], cells))
        return replace(self, bodies=bodies)


def mean_where_positive(values: Array) -> float:
    """Return the mean of the positive values: where nothing touches most laws have none."""
    count = int(np.count_nonzero(values > 0))
    return float(np.sum(values)) / count if count else 0.0


@dataclass(frozen=True)
class ContactSystem:
    """The constants of a contact during a run.

    Parameters
    ----------
    grid : Grid
        The window.
    modulus : float
        Contact modulus E* of the two half-spaces, 1/E* = Σ(1 − ν²)/E, in Pa.
    load : float
        Normal load of the first contact, in N.
    cap : float or None
        Largest pressure the softer body bears, in Pa; None where both bodies
        stay elastic.
    curvature : tuple of float or None
        Curvature of the initial gap at its lowest point along x and y, in
        1/m; None where the surfaces do not state one.
    materials : Mapping[str, Material]
        The bodies' materials, by name; empty where only E* is known.
    coatings : Mapping[str, Coating]
        The elastic layers on them, by name of the body; `modulus` does not know of these.

    Examples
    --------
    >>> layer = tribo.Material(young="300 GPa", poisson=0.2)
    >>> hard = tribo.Coating(2e-6, layer, base=tribo.materials["100Cr6"])
    >>> system = tribo.ContactSystem(tribo.Grid("1 mm", 64), 115e9, 10.0, coatings={"ball": hard})
    >>> round(1e-9 * system.surface_modulus)  # in GPa, above the modulus of steel on steel
    132
    """

    grid: Grid
    modulus: float
    load: float
    cap: float | None = None
    curvature: tuple[float, float] | None = None
    materials: Mapping[str, Material] = field(default_factory=dict)
    coatings: Mapping[str, Coating] = field(default_factory=dict)

    @property
    def surface_modulus(self) -> float:
        """Contact modulus of the materials at the surface of both bodies, in Pa."""
        if not self.coatings:
            return self.modulus
        compliance = 1 / self.modulus
        for coating in self.coatings.values():
            compliance += 1 / coating.modulus - (1 - coating.base.poisson**2) / coating.base.young
        return 1 / compliance


@dataclass(frozen=True)
class ContactProblem:
    """Find the pressure that carries `load` across `gap`.

    The conditions are, with g = gap + A p − approach::

        g >= 0 where p = 0
        g  = 0 where 0 < p < cap
        g <= 0 where p = cap
        sum(p) * cell_area = load

    Parameters
    ----------
    system : ContactSystem
        The constants of the run.
    gap : ndarray, shape (nx, ny)
        Undeformed gap, worn and plastically deformed so far, in m, up to a
        constant.
    load : float
        Normal load, in N; positive.
    wear : WearCompliance, optional
        Wear of the step that this solve is part of.
    cap : ndarray, shape (nx, ny), optional
        Largest pressure at each point, in Pa, in place of the system's: it differs where a layer is
        worn through. Given only to solvers with `takes_cap_map`.

    Examples
    --------
    >>> grid = tribo.Grid("0.4 mm", 64)
    >>> system = tribo.ContactSystem(grid, modulus=115e9, load=10.0)
    >>> gap = -tribo.Sphere(radius="5 mm").height(grid)
    >>> solution = tribo.DcFft().solve(tribo.ContactProblem(system, gap, load=10.0))
    >>> float(f"{1e-6 * solution.pressure.max():.3g}")  # in MPa; Hertz: 1008
    1010.0
    """

    system: ContactSystem
    gap: Array
    load: float
    wear: WearCompliance | None = None
    cap: Array | None = None


@dataclass(frozen=True)
class Residuals:
    """Errors of a solution in the conditions of its problem.

    Parameters
    ----------
    force : float
        \\|sum(p) * cell_area − load\\| / load.
    complementarity : float
        sum(p * \\|g\\|) / (sum(p) * scale), where at the cap only an open gap
        counts, and ``scale`` is the largest displacement under pressure, or
        the range of the gap there if that is more.
    penetration : float
        Largest overlap where there is no pressure, over ``scale``.

    Examples
    --------
    >>> tribo.Residuals(force=1e-12, complementarity=3e-9, penetration=0.0).worst
    3e-09
    """

    force: float
    complementarity: float
    penetration: float

    @property
    def worst(self) -> float:
        """The largest of the three."""
        return max(self.force, self.complementarity, self.penetration)


@dataclass(frozen=True)
class ContactSolution:
    """The pressure in a contact.

    Parameters
    ----------
    pressure : ndarray, shape (nx, ny)
        Contact pressure, in Pa; 0 outside the contact.
    approach : float
        Rigid approach δ, in the gap's own zero, in m.
    overlap : ndarray, shape (nx, ny)
        Depth by which the bodies overlap where the pressure is at the cap:
        the plastic displacement of this solution, in m; 0 elsewhere.
    iterations : int
        Iterations on the full grid.
    residuals : Residuals
        Conditions at exit.

    Examples
    --------
    >>> grid = tribo.Grid("0.4 mm", 64)
    >>> system = tribo.ContactSystem(grid, modulus=115e9, load=10.0)
    >>> gap = -tribo.Sphere(radius="5 mm").height(grid)
    >>> solution = tribo.DcFft().solve(tribo.ContactProblem(system, gap, load=10.0))
    >>> round(1e6 * solution.approach, 2)  # in µm; Hertz: 0.95
    0.95
    """

    pressure: Array
    approach: float
    overlap: Array
    iterations: int
    residuals: Residuals

    @cached_property
    def extent(self) -> Region:
        """The smallest part of the window with all cells under pressure."""
        return bounds(self.pressure > 0)
