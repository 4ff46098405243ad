"""What a lab reads of a scar measured before and after a test."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy.ndimage as ndimage
from scipy.interpolate import griddata

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError
from tribo.lab.ball import ball_cap_volume, conforming_ball_volume, flat_along_ball_volume
from tribo.lab.heights import Heights, of_shape
from tribo.lab.inferred import InferredVolume
from tribo.lab.registration import Registration, register, smoothed
from tribo.lab.track import circular_groove_area, planimetric_volume, reciprocating_track_volume
from tribo.surfaces.surface import Surface

DEEP = 4.0
"""Standard deviations of noise from which on a depth is a scar."""
MOST = 0.65
"""Part of the map that a scar may cover, with the pixels beside it."""
SPOT = 0.1
"""Part of the largest scar's volume below which what is worn is left out as a spot."""
LEVELS = 0.2, 0.4
"""Of the largest depth, at which the width is read."""
BESIDE = 4
"""Pixels by which what is shallower than the noise is taken in."""


@dataclass(frozen=True)
class MeasuredScar:
    """A measured scar, its sizes with standard uncertainties, and what formulas make of it.

    Parameters
    ----------
    registration : Registration
        How the maps lie on each other, with the depth map, where both reach.
    part : tuple of slice
        Which pixels of the map after those are, along x and y.
    after : Heights
        The map after the test, where both reach.
    scar : ndarray of bool, shape (nx, ny)
        The pixels of the scar.
    volume, volume_uncertainty : float
        Lost in the scar, within the map, in m³.
    piled_up : float
        Volume above the surface before, within the map, in m³.
    depth, depth_uncertainty : float
        The largest depth, of means over some pixels, in m.
    along, across : float
        Widths along and across the sliding direction, in m; infinite where it goes on beyond both
        edges of the map, as a track does.
    missing : float
        Part of the scar's pixels that are missing; their depth is that of their neighbours.
    inferred : tuple of InferredVolume
        Volumes by formulas, and how far each is off the measured one.
    """

    registration: Registration
    part: tuple[slice, slice]
    after: Heights
    scar: Mask
    volume: float
    volume_uncertainty: float
    piled_up: float
    depth: float
    depth_uncertainty: float
    along: float
    across: float
    missing: float
    inferred: tuple[InferredVolume, ...]

    @property
    def depths(self) -> Array:
        """The depth map, shape (nx, ny), in m; NaN where missing."""
        return self.registration.depth

    @property
    def is_track(self) -> bool:
        """Whether it goes on beyond two edges of the map."""
        return math.isinf(self.along) or math.isinf(self.across)

    @property
    def section(self) -> float | None:
        """Mean area of a track's section, in m²; None of a scar that ends in the map."""
        if not self.is_track:
            return None
        axis = 0 if math.isinf(self.along) else 1
        return self.volume / self.after.grid.size[axis]

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data, in SI units, without the maps."""
        found = self.registration
        return {
            "volume_m3": self.volume,
            "volume_uncertainty_m3": self.volume_uncertainty,
            "piled_up_m3": self.piled_up,
            "depth_m": self.depth,
            "depth_uncertainty_m": self.depth_uncertainty,
            "along_m": self.along,
            "across_m": self.across,
            "is_track": self.is_track,
            "section_m2": self.section,
            "missing": self.missing,
            "noise_m": found.noise,
            "shift_m": list(found.shift),
            "shift_uncertainty_m": list(found.shift_uncertainty),
            "rotation_rad": found.rotation,
            "rotation_uncertainty_rad": found.rotation_uncertainty,
            "inferred_volumes": [each._asdict() for each in self.inferred],
        }


def measured_scar(
    before: Heights | Surface,
    after: Heights,
    *,
    radius: float | None = None,
    track_length: float | None = None,
    form: int = 1,
) -> MeasuredScar:
    """Measure the scar between two height maps, or an ideal shape and a map.

    Parameters
    ----------
    before : Heights or Surface
        The surface before the test, or the shape that it had.
    after : Heights
        The same after the test, x along the sliding direction.
    radius : float, optional
        Radius of the ball, in m, for the formulas of standards that need it.
    track_length : float, optional
        Length of the whole track, in m: the stroke, or 2πr. The map's own if left out.
    form : int, optional
        Order of the polynomial that is taken off the difference besides: 1 a tilt, 2 a curvature as
        well, as that of an instrument, or of a ball whose radius is not known well.

    Raises
    ------
    CaseError
        If the maps cannot be laid on each other (see `register`), or nothing is worn.

    Examples
    --------
    >>> import tribo
    >>> maps = [tribo.read_heights(f, (1e-6, 1e-6)) for f in ("a.npy", "b.npy")]  # doctest: +SKIP
    >>> tribo.measured_scar(*maps, radius=5e-3).volume  # doctest: +SKIP
    """
    if form not in (1, 2):
        raise CaseError(f"form is 1 (a tilt) or 2 (a curvature as well), not {form}", "form")
    first = of_shape(before, after) if isinstance(before, Surface) else before
    found = register(first, after, form)
    part = _in_common(found.depth)
    found, after = _cut(found, part), Heights(after.heights[part], after.pitch)
    covered = float(np.mean(found.worn))
    if covered > MOST:
        raise CaseError(
            f"what differs covers {100 * covered:.0f} % of the map, too much to lay the maps on "
            "each other by the rest; measure a larger area, half of it unworn"
        )
    dx, dy = after.pitch
    smooth = smoothed(found.depth)
    sides = np.isfinite(found.depth) & ~found.worn
    noise = max(float(np.std(smooth[sides])), 1e-300) if sides.any() else found.noise
    core = _largest(smooth, smooth > DEEP * noise)
    if not core.any():
        raise CaseError(
            f"nothing is worn {1e9 * DEEP * noise:.3g} nm deep, {DEEP:g} times the noise of means "
            "over some pixels; if there is a scar it fills the map, or the map before is another's"
        )
    scar = ndimage.binary_dilation(core, iterations=BESIDE)
    known = np.isfinite(found.depth)
    depth = _interpolated(found.depth, smooth, scar)
    area = dx * dy
    volume = area * float(np.sum(depth[scar]))
    piled = _largest(-smooth, (-smooth > DEEP * noise) & ~scar) & ~scar
    lost = [np.any(core[[0, -1]], axis=1).all(), np.any(core[:, [0, -1]], axis=0).all()]
    along, across = (
        math.inf if lost[axis] else _width(smooth, core, axis, after.pitch[axis], lost[1 - axis])
        for axis in (0, 1)
    )
    top = np.unravel_index(int(np.argmax(np.where(core, smooth, -np.inf))), core.shape)
    of_fit = found.uncertainty[top] ** 2 - found.noise**2 if known[top] else 0.0
    whole = MeasuredScar(
        registration=found,
        part=part,
        after=after,
        scar=scar,
        volume=volume,
        volume_uncertainty=area * _of_sum(found, scar),
        piled_up=-area * float(np.sum(depth[piled])),
        depth=float(smooth[top]),
        depth_uncertainty=math.sqrt(noise**2 + max(float(of_fit), 0.0)),
        along=along,
        across=across,
        missing=float(np.mean(~known[scar])),
        inferred=(),
    )
    inferred = tuple(_inferred(whole, smooth, core, radius, track_length))
    return replace(whole, inferred=inferred)


def _in_common(depth: Array) -> tuple[slice, slice]:
    """Return the lines along x and y of which half is known, from the first to the last."""
    known = np.isfinite(depth)
    ends = []
    for axis in (0, 1):
        part = np.mean(known, axis=1 - axis)
        lines = np.flatnonzero(part >= 0.5 * np.max(part))
        ends.append(slice(int(lines[0]), int(lines[-1]) + 1))
    return ends[0], ends[1]


def _cut(found: Registration, part: tuple[slice, slice]) -> Registration:
    return replace(
        found,
        depth=found.depth[part],
        uncertainty=found.uncertainty[part],
        worn=found.worn[part],
        slopes=found.slopes[:, *part],
    )


def _interpolated(depth: Array, smooth: Array, scar: Mask) -> Array:
    """Return the depth with what is missing in the scar interpolated from around it."""
    missing = np.isnan(depth)
    wanted = missing & scar
    whole = np.where(missing, 0.0, depth)
    if wanted.any():
        rim = ndimage.binary_dilation(wanted, iterations=2) & ~missing
        places = np.argwhere(rim)
        for method in ("nearest", "linear"):
            if method == "linear" and (len(places) < 4 or np.min(np.ptp(places, axis=0)) == 0):
                break
            values = griddata(places, smooth[rim], np.argwhere(wanted), method=method)
            whole[wanted] = np.where(np.isfinite(values), values, whole[wanted])
    return whole


def _of_sum(found: Registration, scar: Mask) -> float:
    """Return the standard uncertainty of the sum of depths in a scar, in m.

    What is missing is as uncertain as the depths around it differ, in each hole in one way.
    """
    missing = scar & np.isnan(found.depth)
    sums = np.sum(found.slopes[:, scar], axis=1)
    of_fit = float(np.einsum("k,kl,l->", sums, found.covariance, sums))
    of_noise = found.spread * found.noise**2 * (np.count_nonzero(scar) - np.count_nonzero(missing))
    off = np.zeros(scar.shape)
    for width in (8.0, 2.0):
        mean, square = smoothed(found.depth, width), smoothed(found.depth**2, width)
        around = smoothed(np.where(np.isnan(found.depth), 0.0, 1.0), width)
        off = np.where(around > 0.1, np.sqrt(np.maximum(square - mean**2, 0.0)), off)
    holes, count = ndimage.label(missing)
    each = ndimage.sum(off, holes, np.arange(1, count + 1)) if count else 0.0
    return math.sqrt(max(of_fit, 0.0) + of_noise + float(np.sum(np.square(each))))


def _largest(depth: Array, marked: Mask) -> Mask:
    """Return the marked places that hang together, of at least a tenth of the largest's volume."""
    places, count = ndimage.label(ndimage.binary_opening(marked, iterations=2))
    if count == 0:
        return np.zeros(marked.shape, dtype=bool)
    volumes = np.array(ndimage.sum(depth, places, np.arange(1, count + 1)))
    kept = 1 + np.flatnonzero(volumes >= SPOT * np.max(volumes))
    filled: Mask = ndimage.binary_fill_holes(np.isin(places, kept))
    return filled


def _width(smooth: Array, core: Mask, axis: int, pitch: float, is_track: bool) -> float:
    """Return the width of a scar: where the parabola through two of its levels comes to 0.

    The profile is the mean of a track, and the mean of some lines through the middle of another
    scar. Of a ball worn flat, and of a groove, the depth is a parabola.
    """
    lines = np.moveaxis(np.where(core, smooth, np.minimum(smooth, 0.0)), axis, 0)
    if is_track:
        profile = np.mean(lines, axis=1)
    else:
        weights = np.sum(lines, axis=0)
        middle = round(float(np.sum(np.arange(weights.size) * weights) / np.sum(weights)))
        profile = np.mean(lines[:, max(middle - 2, 0) : middle + 3], axis=1)
    widths = [_crossed(profile, level * float(np.max(profile))) for level in LEVELS]
    low, high = LEVELS
    square = (high * widths[0] ** 2 - low * widths[1] ** 2) / (high - low)
    return pitch * math.sqrt(max(square, 0.0))


def _crossed(profile: Array, level: float) -> float:
    """Return how far apart a profile passes a level first and last, in pixels."""
    above = np.flatnonzero(profile >= level)
    ends = []
    for inner, outer in ((above[0], above[0] - 1), (above[-1], above[-1] + 1)):
        if not 0 <= outer < profile.size:
            ends.append(float(inner))
            continue
        part = (profile[inner] - level) / (profile[inner] - profile[outer])
        ends.append(float(inner + part * (outer - inner)))
    return ends[1] - ends[0]


def _inferred(
    whole: MeasuredScar, smooth: Array, core: Mask, radius: float | None, track_length: float | None
) -> list[InferredVolume]:
    """Return the volumes by the formulas of standards, beside the measured one."""
    found: list[InferredVolume] = []

    def infer(body: str, method: str, standard: str | None, volume: float, of: float) -> None:
        found.append(InferredVolume(body, method, standard, volume, volume / of - 1))

    width = min(whole.along, whole.across)
    if radius is not None and not 0 < width < 2 * radius:
        raise CaseError(
            f"a scar {1e3 * width:.4g} mm wide is none of a ball of {1e3 * radius:.4g} mm radius; "
            "correct radius",
            "radius",
        )
    if whole.section is not None:
        axis = 0 if math.isinf(whole.along) else 1
        length = track_length or whole.after.grid.size[axis]
        measured = planimetric_volume(whole.section, length)
        infer("track", "mean section times length", "ASTM G133, D7755", measured, measured)
        if radius is None:
            return found
        area = circular_groove_area(width, radius)
        infer("track", "groove of an unworn ball", "ASTM G99", area * length, measured)
        volume = reciprocating_track_volume(width, radius, length)
        infer("track", "the same, with ends", "ASTM G133", volume, measured)
        return found
    if radius is None:
        return found
    mean = 0.5 * (whole.along + whole.across)
    infer("ball", "flat scar", "ASTM G99", ball_cap_volume(mean, radius), whole.volume)
    groove = _groove_radius(whole, core)
    if groove > radius:
        volume = conforming_ball_volume(whole.along, whole.across, radius, groove)
        infer("ball", "scar in a groove", "ASTM D7755", volume, whole.volume)
    volume = flat_along_ball_volume(whole.along, whole.across, radius)
    infer("ball", "scar flat along sliding only", None, volume, whole.volume)
    return found


def _groove_radius(whole: MeasuredScar, core: Mask) -> float:
    """Return the radius of the worn surface across the sliding direction, in m."""
    heights = whole.after.heights
    x, y = whole.after.grid.mesh
    used = core & np.isfinite(heights)
    x, y = (np.broadcast_to(each, heights.shape)[used] for each in (x, y))
    scale = float(np.max(np.abs(y))) or 1.0
    terms = np.stack([np.ones_like(x), x / scale, y / scale, (x / scale) ** 2, (y / scale) ** 2])
    products = np.einsum("kn,ln->kl", terms, terms)
    aims = np.einsum("kn,n->k", terms, heights[used])
    bend = 2 * float((np.linalg.pinv(products, hermitian=True) @ aims)[4]) / scale**2
    return math.inf if bend >= 0 else -1 / bend
