"""The scar in a depth map, and the material piled up beside it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.ndimage as ndimage
from tribo import Array, CaseError, Mask
from tribo.kernel_api import interpolated, smoothed

from tribo_scar.alignment import robust_deviation
from tribo_scar.registration import DEEP, ROUNDED, Registration
from tribo_scar.widths import WidthReading, track_across

SPOT = 0.1
"""Part of the largest scar's volume below which a worn area is left out."""
EDGE = 0.05
"""Part of the largest depth above which the edge of the map cuts a scar off."""
ENCLOSED = 0.1
"""Unworn part within the outline of a scar, above which the scar is a ring."""
FINE = 0.7
"""Width of the Gaussian for ridges of a few pixels, in pixels."""
RELIEF = 1.0
"""Width of the Gaussian that separates relief from the curvature of a worn surface, in pixels."""
BORDER, STEEP = 2, 2.0
"""Pixels on each side of the border of a scar with what is piled up that are sorted by their sign,
and the least slope there, in standard deviations of the noise per pixel."""
RIDGE = 4
"""Pixels of such a ridge beyond noise, at least; fewer are outliers."""
ALONG = 0.1
"""Part of its length that a track may run along the edge of the map."""
MARGIN = 4
"""Pixels added around the scar, by which smoothing widens it."""


@dataclass(frozen=True)
class WornArea:
    """The scar of a registered pair of maps; arrays have the shape (nx, ny), lengths are in m."""

    smooth: Array
    """Smoothed depths."""
    depth: Array
    """Depths, with missing pixels interpolated."""
    known: Mask
    core: Mask
    """Pixels with significant wear."""
    scar: Mask
    piled: Mask
    noise: float
    """Standard deviation of the smoothed depths of unworn pixels."""
    count: int
    """Number of separate areas."""
    is_open: list[bool]
    """Whether it reaches both edges of the map, along x and along y."""
    cut_off: bool
    """Whether it extends beyond the edge, other than at the ends of a track."""
    is_ring: bool
    """Whether it encloses an unworn area, as a whole circular track does."""
    track: WidthReading | None
    """Width across a track; None for a scar that ends within the map."""
    length: float | None
    """Length of a track within the map, along its direction."""

    @property
    def several(self) -> bool:
        """Whether several scars lie apart; the pieces of a track are one."""
        return self.count > 1 and self.track is None


def worn_area(found: Registration, pitch: tuple[float, float], *, ideal: bool) -> WornArea:
    """Return the worn area; `CaseError` if nothing is. The map before may be an ideal shape."""
    smooth, known = smoothed(found.depth), np.isfinite(found.depth)
    depth = _filled(found.depth, smooth, known)
    noise = _noise(smooth, found)
    core = _largest(smooth, smooth > DEEP * noise)
    piled = _largest(-smooth, -smooth > DEEP * noise)
    if not core.any():
        doubt = "check the shape given" if ideal else "check that both maps are of one body"
        why = f"if over half of the map is worn, measure a larger area; or {doubt}"
        if piled.any():
            why = (
                "but a part stands up; give the map of before first, and heights that count upwards"
            )
        raise CaseError(
            f"no scar was found: no depth exceeds {1e6 * DEEP * noise:.3g} µm, {DEEP:g} times the "
            f"other differences; {why}"
        )
    is_open = [
        all(bool(np.any(core.take(end, axis))) for end in (range(MARGIN), range(-MARGIN, 0)))
        for axis in (0, 1)
    ]
    # Not into what is piled up beside it.
    further = MARGIN + _shallow(smooth, core, DEEP * noise)
    scar = ndimage.binary_dilation(core, iterations=further, mask=core | ~piled)
    track, length = None, None
    if is_open[0] != is_open[1]:
        axis = is_open.index(True)
        seen = np.where(known, found.depth, smooth)
        band, track, length = track_across(seen, core, found.worn, noise, axis, pitch)
        scar = ndimage.binary_dilation(band, iterations=MARGIN, mask=band | ~piled)
    _, count = ndimage.label(scar)
    # Smoothing has the scar's edge lie within such a ridge.
    fine, level = smoothed(found.depth, FINE), smoothed(found.depth, RELIEF)
    inner = ndimage.binary_erosion(core, iterations=MARGIN)
    thin = _thin_ridges(found, fine, robust_deviation((fine - level)[inner]), scar & ~inner)
    scar = ndimage.binary_propagation(core & ~thin, mask=scar & ~thin)
    piled = ndimage.binary_dilation(piled | thin, iterations=MARGIN) & ~scar
    rough = robust_deviation((found.depth - level)[inner & known])
    between, lost = _border(fine, max(found.noise, rough), scar, piled), depth > 0
    scar, piled = np.where(between, lost, scar), np.where(between, ~lost, piled)
    deep = core & (smooth > EDGE * np.max(smooth[core]))
    enclosed = ndimage.binary_fill_holes(deep) & ~deep & known
    return WornArea(
        smooth=smooth,
        depth=depth,
        known=known,
        core=core,
        scar=scar,
        piled=piled,
        noise=noise,
        count=count,
        is_open=is_open,
        cut_off=_is_cut_off(deep, known, is_open),
        is_ring=bool(np.count_nonzero(enclosed) > ENCLOSED * np.count_nonzero(core)),
        track=track,
        length=length,
    )


def _noise(depth: Array, found: Registration) -> float:
    """Return the standard deviation of a smoothed depth where it is not worn, in m.

    Robust, as a low ridge beside the scar may have been left in. Maps without noise have rounding.
    """
    unworn = depth[found.unworn]
    least = ROUNDED * float(np.nanmax(np.abs(depth)))
    return max(robust_deviation(unworn), least) if unworn.size else found.noise


def _thin_ridges(found: Registration, fine: Array, relief: float, margin: Mask) -> Mask:
    """Return the ridges in the margin of a scar, too thin for `_largest`.

    Beyond noise, and beyond the relief of the worn surface, whose tops are no ridges.
    """
    noise, up = max(_noise(fine, found), relief), margin & (fine < 0)
    tops, count = ndimage.label(up & (fine < -DEEP * noise), np.ones((3, 3)))
    sizes = np.bincount(tops.ravel(), minlength=count + 1)
    ridges: Mask = ndimage.binary_propagation((tops > 0) & (sizes[tops] >= RIDGE), mask=up)
    return ridges


def _border(fine: Array, noise: float, scar: Mask, piled: Mask) -> Mask:
    """Return pixels at the border of a scar and piled-up material, to be sorted by their sign.

    Smoothing moves that border. Where it is not steep, the signs of noise, and of the relief of the
    worn surface, would add up.
    """
    of_scar, of_piled = (ndimage.binary_dilation(e, iterations=BORDER) for e in (scar, piled))
    slope = np.hypot(*np.gradient(fine))
    border: Mask = of_scar & of_piled & (slope > STEEP * noise)
    return border


def _filled(depth: Array, smooth: Array, known: Mask) -> Array:
    """Return depths with missing ones interpolated: single ones as they are, in holes smoothed."""
    holes = ndimage.binary_opening(~known, np.ones((3, 3)))
    of_holes = interpolated(np.where(known, smooth, np.nan), holes)
    return np.where(holes, of_holes, interpolated(depth, ~known & ~holes))


def _largest(depth: Array, marked: Mask) -> Mask:
    """Return the connected areas whose volume is at least a tenth of the largest's."""
    places, count = ndimage.label(ndimage.binary_opening(marked, iterations=2))
    volumes = np.array(ndimage.sum(depth, places, np.arange(1, count + 1)))
    kept = 1 + np.flatnonzero(volumes >= SPOT * np.max(volumes, initial=0.0))
    filled: Mask = ndimage.binary_fill_holes(np.isin(places, kept))
    return filled


def _shallow(smooth: Array, core: Mask, level: float) -> int:
    """Return the distance in pixels from a level to the end of a parabolic scar."""
    reach = float(np.max(ndimage.distance_transform_edt(core)))
    deep = 1 - level / float(np.max(smooth[core]))
    return math.ceil(reach * (1 / math.sqrt(deep) - 1))


def _is_cut_off(scar: Mask, known: Mask, is_open: list[bool]) -> bool:
    """Return whether the edge of what is known cuts off a scar, other than a track's ends."""
    # Without the holes that missing pixels leave at the edge.
    missing = ndimage.binary_opening(np.pad(~known, 8, constant_values=True), iterations=2)
    places, _ = ndimage.label(missing)
    outside, scar = places == places[4, 4], np.pad(scar, 8)
    # Pixels outside that touch the scar along x, and along y.
    touched = [
        ndimage.binary_dilation(scar, line) & outside for line in (np.ones((3, 1)), np.ones((1, 3)))
    ]
    if is_open[0] != is_open[1]:
        axis = is_open.index(True)
        # The common area is ragged at the ends of a track.
        beside = np.moveaxis(touched[1 - axis], axis, 0)[16:-16]
        return bool(np.count_nonzero(beside) > ALONG * known.shape[axis])
    return bool(np.count_nonzero(touched) > 2)
