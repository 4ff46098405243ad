"""The `winkler` contact solver: a foundation of independent springs."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi, sqrt
from typing import Annotated, Literal

import numpy as np
from pydantic import model_validator

from tribo.closed_forms import hertz
from tribo.contact.elastic import ElasticSolver
from tribo.contact.operator import Operator
from tribo.core.arrays import Array
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError
from tribo.core.material import Poisson
from tribo.core.table import Table
from tribo.core.units import Quantity

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


class Winkler(ElasticSolver):
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

    tolerance: Annotated[float, Quantity("1", above=1e-14, below=1e-2)] = 1e-12
    """Largest residual of the contact conditions, relative to load and displacement; springs reach
    a small one in a few iterations."""

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

    def check(self, system: ContactSystem) -> None:
        """Raise `CaseError` if the window is too small, or the foundation modulus unknown."""
        super().check(system)
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

    def _operator(self, system: ContactSystem, shape: tuple[int, int]) -> Operator:
        return Springs(shape, system.grid.spacing, self.foundation_modulus(system))


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
    depths = {
        "contact_radius": 0.5 * contact.semi_axes[0] * contact.semi_axes[1] * root,
        "peak_pressure": system.load * root / (pi * contact.peak_pressure),
        "approach": contact.approach,
    }
    return system.load * root / (pi * depths[match] ** 2)


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
    peaked = 0.75 * line_load / contact.peak_pressure
    half_width = contact.half_width if match == "contact_radius" else peaked
    return 1.5 * line_load / (curved * half_width**3)
