"""The first contact against Hertz's theory and the onset of yield."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from tribo.closed_forms import hertz
from tribo.core.contact import ContactSystem

AT_THE_CAP = 1 - 1e-9
END_PEAK = 1.05
"""Peak pressure over that at mid-length from which on the ends of a line are spoken of."""


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
        None without a hardness.
    """

    half_width_x: float
    half_width_y: float
    peak_pressure: float
    approach: float | None
    yield_ratio: float | None

    @property
    def is_line(self) -> bool:
        """Whether it is the contact of a cylinder."""
        return inf in (self.half_width_x, self.half_width_y)


def hertz_contact(system: ContactSystem) -> HertzContact | None:
    """Return Hertz's contact for the system's curvature and load.

    None where the surfaces state no curvature, or neither axis is curved. A
    line contact bears its load evenly over the window's length.
    """
    if system.curvature is None:
        return None
    cx, cy = system.curvature
    if cx < 0 or cy < 0 or cx + cy == 0:
        return None
    if cx == 0 or cy == 0:
        length = system.grid.size[0] if cx == 0 else system.grid.size[1]
        line = hertz.line(system.modulus, system.load / length, max(cx, cy))
        a, b = (inf, line.half_width) if cx == 0 else (line.half_width, inf)
        p0, approach, is_line = line.peak_pressure, None, True
    else:
        point = hertz.point(system.modulus, system.load, cx, cy)
        (a, b), p0, approach = point.semi_axes, point.peak_pressure, point.approach
        is_line = False
    ratio = None
    if system.cap is not None:
        ratio = p0 / hertz.first_yield_pressure(system.cap, line=is_line)
    return HertzContact(a, b, p0, approach, ratio)


def computed_pressure(
    system: ContactSystem, max_pressure: float, centre_pressure: float
) -> tuple[float, str]:
    """Return the computed pressure that Hertz's and the onset of yield are for, and it in words.

    The peak of a point contact, and the pressure of a line contact at mid-length: where a
    cylinder ends on a half-space the pressure is singular.

    Parameters
    ----------
    system : ContactSystem
        The bodies in contact.
    max_pressure, centre_pressure : float
        As computed, in Pa.
    """
    hertz = hertz_contact(system)
    if hertz is None or not hertz.is_line:
        return max_pressure, f"p max {1e-6 * max_pressure:.1f} MPa"
    words = f"p {1e-6 * centre_pressure:.1f} MPa at mid-length"
    if max_pressure > END_PEAK * centre_pressure:
        capped = system.cap is not None and max_pressure >= AT_THE_CAP * system.cap
        why = "the hardness" if capped else "grows as the grid is refined"
        words += f" and {1e-6 * max_pressure:.1f} MPa at the ends ({why})"
    return centre_pressure, words
