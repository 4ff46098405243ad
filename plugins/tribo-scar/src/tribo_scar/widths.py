"""Widths of a measured scar, and the band that a track covers."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import scipy.ndimage as ndimage
from tribo import Array, CaseError, Mask

from tribo_scar.registration import DEEP

LOWEST, HIGHEST = 0.05, 0.3
"""Parts of the largest depth between which a width is read: as low as noise allows."""
LINES = 5
"""Lines through the middle of a scar whose mean is its profile: they halve the noise."""
PIXEL = 0.6
"""Standard uncertainty of a width by pixels, half of one on either side, in pixels."""
STEEP = 1.2
"""Difference of the widths at the lowest level and at half of the depth, in pixels, below which
both sides fall within one."""
BESIDE = 0.1
"""Part of a line along a track that may be worn where it tells the noise."""


class WidthReading(NamedTuple):
    """A width and its standard uncertainty, in m; infinite along a track."""

    value: float
    uncertainty: float


def scar_width(
    depth: Array, smooth: Array, scar: Mask, noise: float, axis: int, pitch: float
) -> WidthReading:
    """Return the width along an axis of a scar that ends within the map, through its middle.

    It is read off the mean of five lines. `noise` is the standard deviation of such a mean beside
    the scar, in m.
    """
    even = np.moveaxis(np.where(scar, smooth, np.minimum(smooth, 0.0)), axis, 0)
    weights = np.sum(np.maximum(even, 0.0), axis=0)
    middle = round(float(np.average(np.arange(even.shape[1]), weights=weights)))
    near = slice(max(middle - LINES // 2, 0), middle + LINES // 2 + 1)
    lines = np.moveaxis(np.where(scar, depth, np.nan), axis, 0)[:, near]
    known = np.isfinite(lines)
    # Where none of the lines was measured the smoothed ones stand in.
    total, count = np.sum(lines, axis=1, where=known), np.sum(known, axis=1)
    profile = np.where(count > 0, total / np.maximum(count, 1), np.mean(even[:, near], axis=1))
    return _read(profile, noise, pitch)


def track_across(
    depth: Array,
    core: Mask,
    worn: Mask,
    noise: float,
    axis: int,
    pitch: tuple[float, float],
) -> tuple[Mask, WidthReading, float]:
    """Return the band of a track, straight or an arc, along an axis, its width and length in m.

    The mean profile along the track has less noise than single depths, and shows wear beyond the
    pixels with significant wear, `core`. Noise is measured beside the pixels `worn`. Where hardly
    any line is beside the track `noise` is taken, the standard deviation of smoothed depths in m.
    """
    lines, inside, touched = (np.moveaxis(each, 1 - axis, 0) for each in (depth, core, worn))
    deep = np.where(inside, np.maximum(lines, 0.0), 0.0)
    places = np.arange(len(lines))[:, None]
    middles = np.sum(places * deep, axis=0) / np.maximum(np.sum(deep, axis=0), 1e-300)
    along = np.arange(lines.shape[1]) - 0.5 * (lines.shape[1] - 1)
    *bend, slope, _ = np.polyfit(along, middles, 2, w=np.sum(deep, axis=0))
    course = np.polyval([*bend, slope, 0.0], along)
    at = np.broadcast_arrays(places + course, np.arange(lines.shape[1]))
    straight, core_part, worn_part = (
        ndimage.map_coordinates(each.astype(float), at, order=1, mode="nearest")
        for each in (lines, inside, touched)
    )
    profile, beside = np.mean(straight, axis=1), np.mean(worn_part, axis=1) < BESIDE
    if np.count_nonzero(beside) > LINES:
        noise = float(np.std(profile[beside]))
    along_core = np.flatnonzero(np.mean(core_part, axis=1) > BESIDE)
    if not along_core.size:
        raise CaseError(
            "the worn area crosses the map, but along no line; check that both maps show the same "
            "body"
        )
    first, last = along_core[[0, -1]]
    shallow = np.flatnonzero(profile <= noise)
    first = int(np.max(shallow[shallow < first], initial=-1)) + 1
    last = int(np.min(shallow[shallow > last], initial=len(profile))) - 1
    across = places - course
    band = np.moveaxis((across >= first) & (across <= last), 0, 1 - axis)
    within = np.where((places[:, 0] >= first) & (places[:, 0] <= last), profile, 0.0)
    askew = math.cos(math.atan(slope * pitch[1 - axis] / pitch[axis]))
    steps = np.gradient(course) * pitch[1 - axis]
    length = float(np.sum(np.hypot(steps, pitch[axis])))
    return band, _read(within, noise, askew * pitch[1 - axis]), length


def _read(profile: Array, noise: float, pitch: float) -> WidthReading:
    """Return the width of a profile: where the parabola through two of its levels reaches 0.

    The depth of a ball worn flat is a parabola. The deviation of another scar shows in the parabola
    through higher levels. Sides that fall within a pixel end at half of the depth.
    """
    peak = float(np.max(profile))
    if peak <= 0:
        raise CaseError("the scar has no mean depth; give the map of before first")
    half = _crossed(profile, 0.5 * peak)
    low = min(max(LOWEST, DEEP * noise / peak), HIGHEST)
    levels = (low, 2 * low, min(4 * low, 0.9))
    squares = [_crossed(profile, level * peak) ** 2 for level in levels]
    if math.sqrt(squares[0]) - half < STEEP:
        return WidthReading(pitch * half, pitch * PIXEL)
    width, other = (
        math.sqrt(max((high * wide - low * narrow) / (high - low), 0.0))
        for low, high, wide, narrow in zip(levels, levels[1:], squares, squares[1:], strict=False)
    )
    # Noise moves the edge by about half of its part of the peak, and the parabola doubles it.
    of_noise = width * noise / peak
    return WidthReading(pitch * width, pitch * math.hypot(width - other, of_noise, PIXEL))


def _crossed(profile: Array, level: float) -> float:
    """Return the distance between the first and last crossing of a level, in pixels."""
    ends = []
    for line in (profile, profile[::-1]):
        first = int(np.argmax(line >= level))
        outer = max(first - 1, 0)
        ends.append(float(np.interp(level, line[[outer, first]], [outer, first])))
    return profile.size - 1 - sum(ends)
