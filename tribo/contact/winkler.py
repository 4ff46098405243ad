"""The `winkler` contact solver: a foundation of independent springs, solved to round-off."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi, sqrt
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import model_validator

from tribo.closed_forms import hertz
from tribo.contact.operator import Operator
from tribo.contact.projection import balance
from tribo.contact.residuals import check_bearable, check_finite, residuals
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array, Mask
from tribo.core.box import Box, around
from tribo.core.contact import ContactProblem, ContactSolution, ContactSystem
from tribo.core.errors import CaseError, NumericalError
from tribo.core.material import Poisson
from tribo.core.table import Table
from tribo.core.units import Quantity

_ROUND_OFF = 4 * float(np.finfo(np.float64).eps)
_MOST_PASSES = 200


def solve_foundation(
    problem: ContactProblem, modulus: float, cap: float | None, guess: float | None = None
) -> ContactSolution:
    """Solve contact on a foundation whose pressure is `modulus` times the depth.

    With C = 1/K_w + local the pressure is clip((δ − gap − swept P)/C, 0, cap), where P(y) is the
    line load of its row. P at a given δ, and δ at a given load, are roots of increasing piecewise
    linear functions; Newton's method within a bracket finds them in finitely many passes.

    Exact to round-off. `modulus` is K_w, in Pa/m, `cap` the largest pressure, in Pa, and `guess` an
    approach to start from, in m. It raises as `tribo.contact.bounded_cg.solve_together`.
    """
    gap, grid = problem.gap, problem.system.grid
    limit = np.inf if cap is None else cap
    total = problem.load / grid.cell_area
    check_bearable(problem.load, grid.cell_area * gap.size, limit)
    check_finite(gap)

    springs = _Rows(problem, modulus, limit)
    low = float(np.min(gap))
    # Where the lowest cell alone would carry the load, or all cells reach the limit.
    alone, full = low + total * springs.softest, float(np.max(gap)) + limit * springs.softest
    bound = alone if total < limit else full
    # Somewhat beyond, for Newton's method may land on the bound itself.
    high = low + 1.01 * (bound - low)
    approach = guess if guess is not None and low < guess < high else 0.5 * (low + high)
    for passes in range(1, _MOST_PASSES + 1):
        line_loads, slopes = springs.line_loads(approach)
        excess = float(np.sum(line_loads)) * grid.spacing[1] / problem.load - 1.0
        if abs(excess) <= _ROUND_OFF:
            return springs.solution(approach, line_loads, total, passes)
        if excess > 0:
            high = approach
        else:
            low = approach
        slope = float(np.sum(slopes)) * grid.spacing[1] / problem.load
        following = approach - excess / slope if slope > 0 else np.inf
        # The approach itself has a last bit; `balance` spreads what is left over.
        if abs(following - approach) <= 2 * np.spacing(abs(approach)):
            return springs.solution(approach, line_loads, total, passes)
        if not low < following < high:
            following = 0.5 * (low + high)
        approach = following
    raise NumericalError(
        f"the load of the foundation is still off by {excess:.1e} after {_MOST_PASSES} passes; "
        "check the gap and the wear of the step for extreme values"
    )


class _Rows:
    """Rows of springs, one for each y, coupled along x by the swept wear."""

    def __init__(self, problem: ContactProblem, modulus: float, limit: float) -> None:
        gap = problem.gap
        self.gap = gap
        self.limit = limit
        self.dx = problem.system.grid.spacing[0]
        self.softness = np.full(gap.shape, 1.0 / modulus)
        self.swept = np.zeros(gap.shape[1])
        if problem.wear is not None:
            self.softness += problem.wear.local
            self.swept = problem.wear.swept
        self.softest = float(np.max(self.softness)) + self.dx * gap.shape[0] * float(
            np.max(self.swept)
        )

    def pressure(self, approach: float, line_loads: Array) -> Array:
        depth = approach - self.gap - self.swept * line_loads
        return np.asarray(np.clip(depth / self.softness, 0.0, self.limit))

    def line_loads(self, approach: float) -> tuple[Array, Array]:
        """Return the line load per row, in N/m, and its derivative by the approach."""
        loads = np.zeros(self.gap.shape[1])
        low, high = loads, self.dx * np.sum(self.pressure(approach, loads), axis=0)
        loads = high
        for _ in range(_MOST_PASSES):
            pressure = self.pressure(approach, loads)
            stiffness = np.where((pressure > 0) & (pressure < self.limit), 1 / self.softness, 0.0)
            width = self.dx * np.sum(stiffness, axis=0)
            excess = loads - self.dx * np.sum(pressure, axis=0)
            settled = np.abs(excess) <= _ROUND_OFF * high
            low, high = np.where(excess < 0, loads, low), np.where(excess > 0, loads, high)
            following = loads - excess / (1.0 + self.swept * width)
            inside = (low < following) & (following < high)
            following = np.where(inside, following, 0.5 * (low + high))
            following = np.where(settled, loads, following)
            if np.array_equal(following, loads):
                break
            loads = following
        return loads, width / (1.0 + self.swept * width)

    def solution(
        self, approach: float, line_loads: Array, total: float, passes: int
    ) -> ContactSolution:
        p = balance(self.pressure(approach, line_loads), np.asarray(total), self.limit)
        displacement = self.softness * p + self.swept * self.dx * np.sum(p, axis=0)
        deepest = np.maximum(approach - self.gap - displacement, 0.0)
        return ContactSolution(
            pressure=p,
            approach=approach,
            overlap=np.where(p >= self.limit, deepest, 0.0),
            iterations=passes,
            residuals=residuals(p, self.gap, displacement, approach, total, self.limit),
        )


Match = Literal["contact_radius", "peak_pressure", "approach"]


@dataclass(frozen=True)
class Springs:
    """Independent springs under pressure: an `Operator`."""

    shape: tuple[int, int]
    """Cells (nx, ny) of the box."""
    spacing: tuple[float, float]
    """Edge lengths of a cell along x and y, in m."""
    modulus: float
    """Foundation modulus K_w, in Pa/m."""

    def apply(self, pressure: Array) -> Array:
        """Return p/K_w; see `Operator.apply`."""
        return pressure / self.modulus

    def symbol(self) -> Array:
        """Return 1/K_w for every mode."""
        return np.full((self.shape[0], self.shape[1] // 2 + 1), 1.0 / self.modulus)


class FoundationLayer(Table):
    """A thin elastic layer bonded to a rigid body (Johnson 1985, Contact Mechanics, section 5.8).

    Examples
    --------
    >>> rubber = tribo.FoundationLayer(thickness="1 mm", young="5 MPa", poisson=0.45)
    >>> round(rubber.foundation_modulus / 1e9, 1)  # MPa per mm of depth
    19.0
    """

    thickness: Annotated[float, Quantity("m", above=0, usual=(1e-9, 0.1))]
    """Thickness of the layer."""

    young: Annotated[float, Quantity("Pa", above=0, usual=(1e4, 2e12))]
    """Young's modulus of the layer."""

    poisson: Poisson
    """Poisson's ratio of the layer."""

    @property
    def foundation_modulus(self) -> float:
        """Pressure per depth of a layer that cannot spread sideways, in Pa/m."""
        nu = self.poisson
        return self.young * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * self.thickness)


class Winkler(ContactSolver):
    """p = K_w times the local overlap, at most the hardness: independent springs.

    Valid for a thin compliant layer on a stiff base (`layer`). For a half-space
    it is a fit: matched to one quantity of the first contact, it misses the
    others (Põdra & Andersson 1997, Wear 207, 79-85).

    Examples
    --------
    >>> grid = tribo.Grid("0.4 mm", 32)
    >>> system = tribo.ContactSystem(grid, modulus=115e9, load=10.0, curvature=(200.0, 200.0))
    >>> radius = tribo.Winkler(match="contact_radius").foundation_modulus(system)
    >>> peak = tribo.Winkler(match="peak_pressure").foundation_modulus(system)
    >>> round(peak / radius, 4)  # Hertz's peak pressure needs softer springs than his radius
    0.5625
    """

    type = "winkler"

    modulus: Annotated[float, Quantity("Pa/m", above=0, usual=(1e6, 1e20))] | None = None
    """Foundation modulus K_w, pressure per depth."""

    layer: FoundationLayer | None = None
    """A bonded layer from which the foundation modulus follows."""

    match: Match | None = None
    """What of Hertz's contact at the case's load to reproduce: the size of the contact (the
    default when neither `modulus` nor `layer` is given), the peak pressure or the approach."""

    @model_validator(mode="after")
    def _one_source(self) -> Winkler:
        given = [name for name in ("modulus", "layer", "match") if getattr(self, name) is not None]
        if len(given) > 1:
            raise ValueError(
                f"{' and '.join(given)} are given, but each alone sets the foundation modulus. "
                "Keep one of modulus, layer and match"
            )
        return self

    @property
    def layer_thickness(self) -> float:
        """Thickness of the `layer`, in m; infinite without one."""
        return inf if self.layer is None else self.layer.thickness

    accepts_wear_compliance: ClassVar[bool] = True
    honours_cap: ClassVar[bool] = True
    takes_coatings: ClassVar[bool] = True

    def check(self, system: ContactSystem) -> None:
        """Raise `CaseError` if the foundation modulus cannot be found from `system`."""
        if system.coatings and self.modulus is None and self.layer is None:
            raise CaseError(
                "Hertz's contact, to which the foundation modulus is matched, knows no elastic "
                "layer; give modulus or layer, or leave young and poisson out of the body's layers"
            )
        self.foundation_modulus(system)

    def foundation_modulus(self, system: ContactSystem) -> float:
        """Return K_w, in Pa/m; `CaseError` if it is to match Hertz's contact, and there is none."""
        if self.modulus is not None:
            return self.modulus
        if self.layer is not None:
            return self.layer.foundation_modulus
        return matched_modulus(system, self.match or "contact_radius")

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve one contact problem to round-off; see `ContactSolver.solve`."""
        return solve_foundation(
            problem,
            self.foundation_modulus(problem.system),
            problem.system.cap,
            None if start is None else start.approach,
        )

    def smallest_compliance(self, system: ContactSystem) -> float:
        """Return 1/K_w, in m/Pa."""
        return 1.0 / self.foundation_modulus(system)

    def operator(self, system: ContactSystem, touching: Mask) -> tuple[Box, Operator]:
        """Return the springs on a box around what touches; see `ContactSolver.operator`."""
        box = around(touching, 0)
        return box, Springs(box.shape, system.grid.spacing, self.foundation_modulus(system))


def matched_modulus(system: ContactSystem, match: Match) -> float:
    """Return the foundation modulus, in Pa/m, that shares one feature with Hertz's contact.

    On a paraboloid of curvatures cx, cy a foundation carries F = π K_w δ²/√(cx cy) on an ellipse of
    area 2πδ/√(cx cy) with the peak K_w δ; on a cylinder of curvature c, F' = (4/3) K_w δ b with
    b = √(2δ/c).

    `system` gives curvatures, load and contact modulus; for a line contact also the window, whose
    length along the line bears the load. For an ellipse "contact_radius" keeps its area, for a line
    its half-width. `CaseError` if the surfaces state no convex curvature, or for the approach of a
    line contact, which half-spaces do not have.
    """
    curvature = system.curvature
    if curvature is None or min(curvature) < 0 or max(curvature) == 0:
        what = "state no curvature" if curvature is None else f"have the curvatures {curvature} 1/m"
        raise CaseError(
            f"the foundation modulus is to match Hertz's {match.replace('_', ' ')}, but the "
            f"surfaces {what}. Give modulus (in Pa/m) or layer instead"
        )
    if min(curvature) == 0:
        return _matched_line(system, curvature, match)
    root = sqrt(curvature[0] * curvature[1])
    contact = hertz.point(system.modulus, system.load, *curvature)
    if match == "peak_pressure":
        return pi * contact.peak_pressure**2 / (system.load * root)
    depth = contact.approach
    if match == "contact_radius":
        depth = 0.5 * contact.semi_axes[0] * contact.semi_axes[1] * root
    return system.load * root / (pi * depth**2)


def _matched_line(system: ContactSystem, curvature: tuple[float, float], match: Match) -> float:
    along = 1 if curvature[1] == 0 else 0
    line_load = system.load / system.grid.size[along]
    curved = max(curvature)
    contact = hertz.line(system.modulus, line_load, curved)
    if match == "approach":
        raise CaseError(
            "the approach of a line contact between half-spaces has no finite value to match. "
            "Use match = 'contact_radius' or 'peak_pressure', or give modulus or layer"
        )
    if match == "contact_radius":
        return 1.5 * line_load / (curved * contact.half_width**3)
    depth = 0.5 * curved * (0.75 * line_load / contact.peak_pressure) ** 2
    return contact.peak_pressure / depth
