"""The first contact against Hertz's theory and the onset of yield."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import inf

import numpy as np

from tribo.closed_forms import hertz
from tribo.core.arrays import Array
from tribo.core.contact import ContactSystem
from tribo.core.words import readable, signed
from tribo.result.read import Result


@dataclass(frozen=True)
class HertzContact:
    """Hertz's contact of a system.

    Parameters
    ----------
    half_width_x, half_width_y : float
        Semi-axes, in m; infinite along a cylinder.
    peak_pressure : float
        In Pa.
    approach : float or None
        In m; None for a line contact, where it is not defined.
    yield_ratio : float or None
        Peak pressure over that at which yield begins beneath the surface;
        None unless both bodies have a hardness.
    load_ratio : float or None
        Load over the load of first yield, P/P_yield; None with the other ratio.
    """

    half_width_x: float
    half_width_y: float
    peak_pressure: float
    approach: float | None
    yield_ratio: float | None
    load_ratio: float | None

    @property
    def is_line(self) -> bool:
        """Whether it is the contact of a cylinder."""
        return inf in (self.half_width_x, self.half_width_y)

    def pressure(self, axis: int, position: Array) -> Array:
        """Return the pressure through the centre along an axis, in Pa, at positions in m."""
        inside = 1 - (position / (self.half_width_x, self.half_width_y)[axis]) ** 2
        return self.peak_pressure * np.sqrt(np.maximum(inside, 0.0))


def hertz_contact(system: ContactSystem) -> HertzContact | None:
    """Return Hertz's contact for the system's curvature and load.

    None where the surfaces state no curvature, neither axis is curved, or a body has an elastic
    layer. A line contact bears its load evenly over the window's length.
    """
    if system.coatings:
        return None
    cx, cy = system.curvature or (0.0, 0.0)
    if cx < 0 or cy < 0 or cx + cy == 0:
        return None
    is_line = cx == 0 or cy == 0
    if is_line:
        length = system.grid.size[0 if cx == 0 else 1]
        line = hertz.line(system.modulus, system.load / length, max(cx, cy))
        a, b = (inf, line.half_width) if cx == 0 else (line.half_width, inf)
        p0, approach = line.peak_pressure, None
    else:
        point = hertz.point(system.modulus, system.load, cx, cy)
        (a, b), p0, approach = point.semi_axes, point.peak_pressure, point.approach
    cap = system.cap
    ratio = None if cap is None else p0 / hertz.first_yield_pressure(cap, line=is_line)
    # A ball's pressure grows as the cube root of the load, a cylinder's as the square root.
    loads = None if ratio is None else ratio ** (2 if is_line else 3)
    return HertzContact(a, b, p0, approach, ratio, loads)


def hertz_half_width(system: ContactSystem) -> float | None:
    """Return half the length of Hertz's contact along x, in m; None where it has no such."""
    hertz = hertz_contact(system)
    return hertz.half_width_x if hertz is not None and hertz.half_width_x < inf else None


def softer_known(system: ContactSystem, hardness: Mapping[str, float | None]) -> ContactSystem:
    """Return the system, without its cap if a body has no hardness: the softer one is unknown."""
    return system if all(hardness.values()) else replace(system, cap=None)


def first_hertz(result: Result) -> HertzContact | None:
    """Return Hertz's contact for the first save of a result; None where it is another."""
    if result.case_tables.get("begin"):
        return None
    hardness: dict[str, float | None] = {}
    for name, body in result.case_tables["bodies"].items():
        layers = body.get("layers") or ()
        # A result's system does not keep elastic layers.
        if any(each.get(key) is not None for each in layers for key in ("young", "poisson")):
            return None
        top = next((each.get("hardness") for each in layers), None)
        hardness[name] = top or body["material"].get("hardness")
    return hertz_contact(softer_known(result.system, hardness))


def compared(
    system: ContactSystem,
    theory: HertzContact | None,
    max_pressure: float,
    centre_pressure: float,
) -> tuple[float | None, str]:
    """Return a computed pressure over the pressure of first yield, and beside Hertz's in words.

    The pressure, in Pa, is the peak of a point contact, and of a line contact the pressure at
    mid-length: where a cylinder ends on a half-space, it is singular and grows as the grid is
    refined. The ratio is None without the `theory` or a hardness.
    """
    pressure, words = max_pressure, f"p max {in_mpa(max_pressure)}"
    alike = hertz_contact(system)
    if alike is not None and alike.is_line:
        pressure = centre_pressure
        words = f"p {in_mpa(pressure)} at mid-length, {in_mpa(max_pressure)} at most"
    if theory is None:
        return None, f"{words}; Hertz's theory has no solution for it"
    off = signed(100 * (pressure / theory.peak_pressure - 1), 2)
    words = f"{words}, Hertz {in_mpa(theory.peak_pressure)} ({off} %)"
    if system.cap is None or theory.load_ratio is None:
        return None, words
    first = hertz.first_yield_pressure(system.cap, line=theory.is_line)
    return pressure / first, (
        f"{words}; yield: {100 * pressure / first:.0f} % of the {in_mpa(first)} at which the "
        f"softer body first yields beneath the surface (P/P_yield {theory.load_ratio:.2g})"
    )


def in_mpa(pressure: float) -> str:
    """Return a pressure, in Pa, in words."""
    return f"{readable(1e-6 * pressure, '.1f')} MPa"
