"""Temperature rise under a circular heat source on a half-space, resting or moving."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import erf, ive, roots_sh_legendre
from tribo import Array

Profile = Literal["uniform", "parabolic"]
Rise = Literal["mean", "maximum"]


@dataclass(frozen=True)
class SpeedLimits:
    """ΔT K/(q a) of a resting source, and ΔT K √Pe/(q a) of a fast one."""

    static: float
    fast: float


LIMITS: dict[tuple[Profile, Rise], SpeedLimits] = {
    ("uniform", "maximum"): SpeedLimits(1.0, 2 / math.sqrt(math.pi)),
    ("uniform", "mean"): SpeedLimits(8 / (3 * math.pi), 0.688546),
    ("parabolic", "maximum"): SpeedLimits(3 * math.pi / 8, 1.309512),
    ("parabolic", "mean"): SpeedLimits(9 * math.pi / 32, 0.717543),
}
"""Exact limits after Jaeger. The fast means are 8 B(1/2, 7/4)/(3 π^1.5) and
3.2 B(1/2, 9/4)/π^1.5; the fast parabolic maximum was integrated numerically."""


NODES, WEIGHTS = roots_sh_legendre(32)
"""Gauss's rule from 0 to 1: with 32 points `kept_per_power` is exact to 3e-6 for Pe ≤ 10, 1e-4 for
100."""
FAR = 1e3
"""Age s, in lengths or last passes, beyond which heat adds a thousandth of what is kept."""


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


def kept_per_power(
    radius: float, conductivity: float, peclet: float, track: float, turns_back: bool
) -> float:
    """Return the rise from the heat of earlier passes, per heat flow, in K/W.

    It is added to `rise_per_power`, the rise of a source that never returns: heat of the age
    t = s² a²/(4κ) warms the contact by

        ΔT = Q/(π^1.5 a K) ∫ W(s) ds/(1 + s²)        from 0 to ∞, β = 1/(1 + s²)

    with d = v t/a the distance slid since then and ℓ the track, in radii. Heat that is younger
    than a pass lies where the source passed last; older heat is spread evenly over the track.

        to and fro    d < ℓ     W = √(π/β) erf(d √β)/(2ℓ) − (d/ℓ) exp(−β d²)
                      d > ℓ     W = (√π x erf x − 1 + exp(−x²))/x² − exp(−β d²), x = ℓ √β
        round         d < ℓ/2   W = 0
                      d > ℓ/2   W = exp(−x²/2π²) I₀(x²/2π²) − exp(−β d²)

    It is the mean over the cycle, once that is steady (t of some ℓ² a²/κ), at a steady speed, for
    a source with the same ⟨y²⟩ as the disc. Against Green's function over the disc's square, for
    Pe up to 50, the whole rise is right to 1.5 % from ℓ = 10 on and to 3.2 % from 2 on.

    Parameters
    ----------
    radius, conductivity, peclet : float
        As of `rise_per_power`.
    track : float
        Length of the track, in m: the stroke, or once round a circle; may be infinite.
    turns_back : bool
        Whether the source moves to and fro along it, rather than round it.

    References
    ----------
    Carslaw, H. S., Jaeger, J. C. (1959), Conduction of heat in solids, 2nd ed., Oxford, 10.4: the
    instantaneous source that is integrated here.
    """
    if peclet == 0 or math.isinf(track):
        return 0.0
    length = track / radius
    last = math.sqrt((2 if turns_back else 1) * length / peclet)

    def younger(d: Array, beta: Array) -> Array:
        back = 0.5 / length * np.sqrt(math.pi / beta) * erf(d * np.sqrt(beta))
        return np.asarray(back - d / length * np.exp(-beta * d**2))

    def older(d: Array, beta: Array) -> Array:
        x = length * np.sqrt(beta)
        spread = ive(0, 0.5 * (x / math.pi) ** 2)
        if turns_back:
            spread = (math.sqrt(math.pi) * x * erf(x) + np.expm1(-(x**2))) / x**2
        return np.asarray(spread - np.exp(-beta * d**2))

    def integral(weight: Callable[[Array, Array], Array], least: float, most: float) -> float:
        low, high = math.asinh(least), math.asinh(most)
        s = np.sinh(low + (high - low) * NODES)
        values = weight(0.5 * peclet * s**2, 1 / (1 + s**2)) / np.sqrt(1 + s**2)
        return (high - low) * float(np.sum(WEIGHTS * values))

    total = integral(older, last, FAR * max(last, length))
    if turns_back:
        total += integral(younger, 0.0, last)
    return float(total / (math.pi**1.5 * radius * conductivity))


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
