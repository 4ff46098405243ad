"""The scar in a depth map, and the material piled up beside it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.ndimage as ndimage
from tribo import Array, CaseError, Mask
from tribo.kernel_api import interpolated

from tribo_scar.alignment import robust_deviation
from tribo_scar.registration import BLURS, DEEP, ROUNDED, Registration
from tribo_scar.smoothing import smoothed
from tribo_scar.widths import LOWEST, WidthReading, track_across

SPOT = 0.1
"""Part of the largest scar's volume below which a worn area is left out."""
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
    # Smoothing has the scar's edge lie within a thin ridge.
    fine = smoothed(found.depth, BLURS[-1])
    margin = scar & ~ndimage.binary_erosion(core, iterations=MARGIN) & (fine < 0)
    thin = ndimage.binary_propagation(margin & (fine < -DEEP * _noise(fine, found)), mask=margin)
    scar = ndimage.binary_propagation(core & ~thin, mask=scar & ~thin)
    piled = ndimage.binary_dilation(piled | thin, iterations=MARGIN) & ~scar
    # The edge cuts off a scar whose width cannot be read.
    deep = core & (smooth > LOWEST * np.max(smooth[core]))
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
    missing = ndimage.binary_opening(np.pad(~known, 2 * MARGIN, constant_values=True), iterations=2)
    places, _ = ndimage.label(missing)
    outside, scar = places == places[MARGIN, MARGIN], np.pad(scar, 2 * MARGIN)
    # Pixels outside that touch the scar along x, and along y.
    touched = [
        ndimage.binary_dilation(scar, line) & outside for line in (np.ones((3, 1)), np.ones((1, 3)))
    ]
    if is_open[0] != is_open[1]:
        axis = is_open.index(True)
        # The common area is ragged at the ends of a track.
        touched = [np.moveaxis(touched[1 - axis], axis, 0)[4 * MARGIN : -4 * MARGIN]]
    return bool(np.count_nonzero(touched) > MARGIN)
