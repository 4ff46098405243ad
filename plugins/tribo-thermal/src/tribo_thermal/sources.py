"""Temperature rise under a circular heat source on a half-space, resting or moving."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from tribo import Array

Profile = Literal["uniform", "parabolic"]
Rise = Literal["mean", "maximum"]


@dataclass(frozen=True)
class Limits:
    """ΔT K/(q a) of a resting source, and ΔT K √Pe/(q a) of a fast one."""

    static: float
    fast: float


LIMITS: dict[tuple[Profile, Rise], Limits] = {
    ("uniform", "maximum"): Limits(1.0, 2 / math.sqrt(math.pi)),
    ("uniform", "mean"): Limits(8 / (3 * math.pi), 0.688546),
    ("parabolic", "maximum"): Limits(3 * math.pi / 8, 1.309512),
    ("parabolic", "mean"): Limits(9 * math.pi / 32, 0.717543),
}
"""Exact limits after Jaeger. The fast means are 8 B(1/2, 7/4)/(3 π^1.5) and
3.2 B(1/2, 9/4)/π^1.5; the fast parabolic maximum was integrated numerically."""


def rise_per_power(
    radius: float, conductivity: float, peclet: float, profile: Profile, rise: Rise
) -> float:
    """Return the temperature rise per heat flow into a half-space, in K/W.

    ΔT = (q a/K) / √(1/c₀² + Pe/c₁²), with q = Q/(π a²), joins the static limit
    c₀ q a/K and the fast limit c₁ q a/(K √Pe) in the form of Tian & Kennedy,
    whose 2.32/√(π (1.234 + Pe)) is the parabolic maximum. Against Jaeger's
    integral it is right to 2.3 % for the maximum and 4.9 % for the mean, at
    any Pe. The rise is quasi-steady: valid once the source has rested for
    some a²/κ or moved by some radii.

    Parameters
    ----------
    radius : float
        Radius a of the source, in m.
    conductivity : float
        Thermal conductivity K, in W/(m K).
    peclet : float
        Péclet number Pe = v a/(2κ); 0 for a source at rest.
    profile : {"uniform", "parabolic"}
        Flux q, or 1.5 q √(1 − r²/a²) as under Hertz's pressure.
    rise : {"mean", "maximum"}
        Over the source.

    References
    ----------
    Tian, X., Kennedy, F. E. (1994), Maximum and average flash temperatures in
    sliding contacts, J. Tribology 116, 167-174. Jaeger, J. C. (1942), Moving
    sources of heat and the temperature at sliding contacts, Proc. R. Soc. NSW
    76, 203-224.
    """
    limits = LIMITS[profile, rise]
    factor = 1 / math.sqrt(1 / limits.static**2 + peclet / limits.fast**2)
    return factor / (math.pi * radius * conductivity)


def source_radius(pressure: Array, cell_area: float, profile: Profile) -> float:
    """Return the radius of the circle that has the contact's (Σp)²/Σp², in m.

    It is exact for a contact with the pressure of `profile` and, unlike a
    count of cells, smooth in the pressure.

    Parameters
    ----------
    pressure : ndarray
        Contact pressure, in Pa; not 0 everywhere.
    cell_area : float
        Area of a cell, in m².
    profile : {"uniform", "parabolic"}
        Shape of the pressure; for the parabolic one (Σp)²/Σp² is 8/9 of the area.
    """
    area = float(np.sum(pressure)) ** 2 / float(np.sum(pressure**2)) * cell_area
    return math.sqrt((9 / 8 if profile == "parabolic" else 1.0) * area / math.pi)
