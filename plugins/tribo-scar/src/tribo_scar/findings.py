"""Warnings of faults in the maps of a scar."""

from __future__ import annotations

import math
import warnings

import numpy as np
import scipy.ndimage as ndimage
from tribo import Array, CaseError, Heights, Mask, Sphere, TriboWarning
from tribo.kernel_api import without_form

from tribo_scar.registration import variance_inflation
from tribo_scar.worn_area import WornArea

ZEROS = 10
"""Number of zeros over the number of any other height, above which zeros may be missing values."""
CURVED = 20.0
"""Sag of the map, relative to its relief, above which the radius of its surface is known."""
FEWEST = 100
"""Least pixels beside a scar to search for a form."""
ORDER = 4
"""Order of the polynomial of the form."""
BENT = 40.0
"""χ² of its 12 terms beyond a tilt, which chance exceeds once in 10⁴ maps."""
GAP = 0.15
"""Part of the volume in one gap of the map above which it is reported."""
WIDE = 5
"""Pixels of a gap along x and y at least."""
RADIUS_OFF = 0.05
"""Relative difference of a radius beyond which the surface is not the ball's."""


def warn(words: str) -> None:
    """Warn at the line that measures a scar."""
    warnings.warn(words, TriboWarning, stacklevel=4)


def warn_of_zeros(heights: Heights, which: str) -> None:
    """Warn of many heights of exactly 0, which may stand for missing values."""
    known = heights.heights[np.isfinite(heights.heights)]
    values, counts = np.unique(known, return_counts=True)
    if values.size == 1:
        words = f"every height of the map {which} is {known[0]:g} m"
        if which == "after":
            raise CaseError(f"{words}: nothing was measured; save it again")
        warn(f"{words}, an ideal flat; if it was measured, save it again")
    zeros, others = (int(np.max(counts[each], initial=0)) for each in (values == 0, values != 0))
    if zeros > ZEROS * others and 2 * zeros < known.size:
        warn(
            f"{zeros} heights of the map {which} are exactly 0; put NaN where nothing was measured"
        )


def check_scales(before: Heights, after: Heights) -> None:
    """Refuse maps whose numbers of pixels along both axes have a whole ratio above 1."""
    fewer, more = sorted((before.heights.shape, after.heights.shape))
    ratio = more[0] // fewer[0]
    if ratio > 1 and more == tuple(ratio * n for n in fewer):
        raise CaseError(
            f"one map has {ratio} times as many pixels along both axes as the other: if both show "
            "the same area, average the finer one over blocks, or state each pitch in its file; "
            "else cut the larger one"
        )


def warn_of_form(unworn: Array, sure: float, form: int, *, ideal: bool) -> None:
    """Warn if the unworn surfaces differ by a form, beyond relief and noise.

    Not if its standard deviation is below the uncertainty `sure` of the scar's mean depth, in m.
    A form of the order `form` was taken off.
    """
    if _is_covered(unworn):
        warn(
            f"fewer than {FEWEST} pixels lie beside the scar, which its depths are measured "
            "against; measure a larger area, or with smaller pixels"
        )
        return
    rest = without_form(unworn, ORDER)
    left, count = float(np.nanvar(rest)), np.count_nonzero(np.isfinite(unworn))
    by_chance = BENT * left * variance_inflation(rest) / count
    if np.nanvar(unworn) - left > max(by_chance, sure**2):
        doubt = (
            "check the shape given and the pitch"
            if ideal
            else "check that the maps belong together"
        )
        what, off = (
            ("tilt", ", or take a curvature off with form 2") if form == 1 else ("curvature", "")
        )
        warn(
            f"the unworn surfaces differ by more than a {what}: {doubt}{off}; volume and depth are "
            "off by more than their uncertainties"
        )


def _is_covered(unworn: Array) -> bool:
    """Whether a scar covers almost all of a map."""
    return bool(np.count_nonzero(np.isfinite(unworn)) < FEWEST)


def may_be_ball(after: Heights, scar: Mask, radius: float) -> bool:
    """Whether the unworn surface may be a ball; warn if not, or of another radius."""
    unworn = np.where(scar, np.nan, after.heights)
    if _is_covered(unworn):
        # It is not known.
        return True
    rest = without_form(unworn)
    found, noise = radius_across(unworn - rest, after.pitch), float(np.nanstd(rest))
    sag = after.grid.size[1] ** 2 / (8 * min(radius, found))
    if sag <= CURVED * noise:
        return True
    found *= radius / _of_ball(after, scar, radius)
    if abs(math.log(found / radius)) > RADIUS_OFF:
        warn(
            f"the unworn surface has a radius of {1e3 * found:.4g} mm, and the ball one of "
            f"{1e3 * radius:.4g} mm: the formulas for a scar on a ball are left out; check radius "
            "and pitch"
        )
        return False
    return True


def _of_ball(after: Heights, scar: Mask, radius: float) -> float:
    """Return the radius read off a ball's surface, which is smaller where it is steep."""
    try:
        ball = np.where(scar, np.nan, Sphere(radius=radius).height(after.grid))
    except CaseError:
        return radius
    return radius_across(ball - without_form(ball), after.pitch)


def warn_of_area(worn: WornArea, *, within: bool) -> None:
    """Warn of a scar that an edge of the map, or `within` it, cuts off, and of its shape."""
    if worn.cut_off:
        edge = "the area common to both maps" if within else "what was measured"
        warn(
            f"the edge of {edge} cuts the scar off: volume and depth belong to the part within, "
            "widths and formulas are left out; measure a larger area"
            f"{', the same before and after' if within else ''}"
        )
    elif (part := _in_a_gap(worn)) > GAP:
        warn(
            f"{100 * part:.0f} % of the volume lies in one gap of the map, interpolated from the "
            "depths around it: too much if the gap is unworn, as in the middle of a circular track"
        )
    if worn.several:
        warn(
            f"{worn.count} areas are worn: volume is of all, depth is of the deepest, and widths "
            "and formulas are left out; cut the maps to one of them for these"
        )
    if worn.is_ring:
        warn(
            "the scar encloses an unworn area, as a whole circular track does: widths belong to "
            "its outline, the largest depth is rough, and formulas are left out; cut the maps to "
            "a part of the track for these"
        )


def _in_a_gap(worn: WornArea) -> float:
    """Return the part of the volume in the largest gap of a scar, as in the middle of a ring."""
    # Not of pixels that are missing here and there, however many.
    missing = ndimage.binary_opening(worn.scar & ~worn.known, np.ones((WIDE, WIDE)))
    gaps, count = ndimage.label(missing)
    volumes = ndimage.sum(worn.depth, gaps, np.arange(1, count + 1))
    return float(np.max(volumes, initial=0.0) / np.sum(worn.depth[worn.scar]))


def radius_across(form: Array, pitch: tuple[float, float]) -> float:
    """Return the radius of the form of a surface across the sliding direction, in m."""
    bend = float(np.nanmean(np.diff(form, 2, axis=1))) / pitch[1] ** 2
    return math.inf if bend >= 0 else -1 / bend
