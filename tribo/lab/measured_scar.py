"""Volume, depth and widths of a scar from height maps before and after a test."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.ndimage as ndimage

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError, TriboWarning
from tribo.lab.heights import Heights, interpolated, smoothed
from tribo.lab.inferred import UNWORN, InferredVolume, ball_volumes, inferred
from tribo.lab.registration import Registration, register
from tribo.lab.roughness import without_form
from tribo.lab.scar import Scar
from tribo.lab.track import circular_groove_area, planimetric_volume, reciprocating_track_volume
from tribo.lab.widths import LINES, Width, scar_width
from tribo.lab.worn_area import MARGIN, worn_area
from tribo.surfaces.surface import Surface

MOST = 0.65
"""Part of the map that a scar may cover, with its margin."""
SURE = 0.3
"""Part of the largest depth from which on a pixel tells the shape of the worn surface."""
MISSED = 0.2
"""Part of the bottom of the scar that may lie in holes."""
FEWEST_OF_BOTTOM = 12
"""Pixels that a paraboloid is fitted to at least."""
BOTTOM = 0.8
"""Part of the largest depth from which on a pixel is of the bottom of the scar."""
LEVEL = 10.0
"""Variance of the form of a bottom, relative to that by noise of a mean, below which it is flat; 5
by noise alone."""
ZEROS = 10
"""Ratio of the number of zeros to that of any other height above which zeros may be missing
values."""
CURVED = 20.0
"""Sag of the map, relative to its relief, from which on the radius of its surface is known."""
RADIUS_OFF = 0.05
"""Relative difference of a radius that is told."""


@dataclass(frozen=True)
class MeasuredScar:
    """Sizes of a measured scar with standard uncertainties, and volumes by formulas.

    Parameters
    ----------
    registration : Registration
        Registration of the maps, with the depth map, on their common area.
    after : Heights
        The map after the test, on the common area.
    scar, piled : ndarray of bool, shape (nx, ny)
        The pixels of the scar, and those of what is piled up beside it.
    volume, volume_uncertainty : float
        Volume of the scar within the map, in m³.
    piled_up : float
        Volume above the surface before, within the map, in m³.
    depth, depth_uncertainty : float
        Largest depth, of a paraboloid through the bottom of the scar, in m.
    along, across : float
        Widths along and across the sliding direction, in m; infinite for a track, which reaches
        both edges of the map, and None for one that is cut off and for several.
    along_uncertainty, across_uncertainty : float
        Standard uncertainties of these, by noise and by how far the edge is from a parabola.
    cut_off : bool
        Whether the scar goes on beyond the edge of the map, other than at the ends of a track.
    missing : float
        Part of the scar's pixels that are missing; their depth is interpolated.
    section : float or None
        Mean cross-section of a track, across its direction, in m²; None for a scar that ends within
        the map.
    track_volume : float or None
        Of the whole track, its mean section times its length (ASTM G133, D7755), in m³; None for a
        scar that ends within the map.
    inferred : tuple of InferredVolume
        Volumes by formulas, and their difference from the measured one.
    """

    registration: Registration
    after: Heights
    scar: Mask
    piled: Mask
    volume: float
    volume_uncertainty: float
    piled_up: float
    depth: float
    depth_uncertainty: float
    along: float | None
    along_uncertainty: float | None
    across: float | None
    across_uncertainty: float | None
    cut_off: bool
    missing: float
    section: float | None
    track_volume: float | None
    inferred: tuple[InferredVolume, ...]

    @property
    def depths(self) -> Array:
        """The depth map, shape (nx, ny), in m; NaN where missing."""
        return self.registration.depth

    @property
    def is_track(self) -> bool:
        """Whether it reaches two opposite edges of the map."""
        return math.inf in (self.along, self.across)

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
            "along_uncertainty_m": self.along_uncertainty,
            "across_m": self.across,
            "across_uncertainty_m": self.across_uncertainty,
            "is_track": self.is_track,
            "cut_off": self.cut_off,
            "section_m2": self.section,
            "track_volume_m3": self.track_volume,
            "missing": self.missing,
            "noise_m": found.noise,
            "shift_m": [
                shift if math.isfinite(sure) else None
                for shift, sure in zip(found.shift, found.shift_uncertainty, strict=True)
            ],
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
    """Measure the scar between height maps before and after a test.

    Parameters
    ----------
    before : Heights or Surface
        The surface before the test, measured or ideal.
    after : Heights
        The surface after the test, x along the sliding direction.
    radius : float, optional
        Radius of the ball, in m, for the formulas that need it.
    track_length : float, optional
        Length of the whole track, in m: the stroke, or 2πr. By default its length in the map.
    form : int, optional
        Order of the polynomial form that is removed from the difference: 1 for tilt, 2 for
        curvature as well, as of an instrument, or of a ball whose radius is uncertain.

    Raises
    ------
    CaseError
        If the maps cannot be registered (see `register`), or nothing is worn.

    Examples
    --------
    >>> import tribo
    >>> maps = [tribo.read_heights(f, (1e-6, 1e-6)) for f in ("a.npy", "b.npy")]  # doctest: +SKIP
    >>> tribo.measured_scar(*maps, radius=5e-3).volume  # doctest: +SKIP
    """
    if form not in (1, 2):
        raise CaseError(f"form is 1 (a tilt) or 2 (a curvature as well), not {form}", "form")
    ideal = isinstance(before, Surface)
    if isinstance(before, Surface):
        try:
            before = Heights(before.height(after.grid), after.pitch)
        except CaseError as error:
            raise CaseError(
                f"the shape before does not cover the map after ({error}); correct it, or the pitch"
            ) from None
    else:
        if np.array_equal(before.heights, after.heights, equal_nan=True):
            raise CaseError("the maps before and after are the same; give two that differ")
        _warn_of_zeros(before, "before")
    _warn_of_zeros(after, "after")
    found = register(before, after, form)
    shape = after.heights.shape
    after = Heights(after.heights[found.part], after.pitch)
    covered = float(np.mean(found.worn))
    if covered > MOST:
        raise CaseError(
            f"{100 * covered:.0f} % of the map differ, too much to register the maps by the rest; "
            "measure a larger area, half of it unworn"
        )
    worn = worn_area(found, after.pitch, ideal=ideal)
    smooth, known, core, scar = worn.smooth, worn.known, worn.core, worn.scar
    if form == 1:
        _warn_of_curvature(np.where(found.unworn, found.depth, np.nan), ideal=ideal)
    holes = interpolated(np.where(known, smooth, np.nan), ~known & scar)
    depth = np.where(known, found.depth, holes)
    area = after.grid.cell_area
    volume = area * float(np.sum(depth[scar]))
    if worn.cut_off:
        whole = max(np.subtract(shape, found.depth.shape)) <= MARGIN
        warnings.warn(
            f"the edge of {'the map' if whole else 'the area common to both maps'} cuts the scar "
            "off: volume and depth are those of the part within, widths and formulas are left out; "
            f"measure a larger area{'' if whole else ', the same before and after'}",
            TriboWarning,
            stacklevel=2,
        )
    deepest, deepest_uncertainty = _deepest(found, smooth, core, worn.noise)
    widths, section, track_volume, formulas = None, None, None, list[InferredVolume]()
    several = 1 if worn.track else ndimage.label(scar)[1]
    if several > 1:
        warnings.warn(
            f"{several} areas are worn: volume is that of all, depth that of the deepest, and "
            "widths and formulas are left out; cut the maps to one of them for these",
            TriboWarning,
            stacklevel=2,
        )
    elif not worn.cut_off:
        endless = Width(math.inf, 0.0)
        # Correlated noise does not average out over neighbours.
        of_lines = found.noise * math.sqrt(min(found.variance_inflation / LINES, 1.0))
        widths = [
            (endless if worn.is_open[axis] else worn.track)
            or scar_width(
                found.depth, smooth, scar, (of_lines, worn.noise), axis, after.pitch[axis]
            )
            for axis in (0, 1)
        ]
        sizes = Scar(*(each.value for each in widths))
        if worn.track and worn.length:
            section, whole = volume / worn.length, track_length or worn.length
            track_volume = planimetric_volume(section, whole)
            formulas = _track_volumes(track_volume, worn.track.value, whole, radius)
        elif radius is not None:
            _check_width(max(sizes), radius)
            _warn_of_radius(after, scar, radius)
            # Smoothing widens the core beyond what is worn.
            sure = core & (smooth > SURE * np.max(smooth[core]))
            bottom = np.where(sure, after.heights, np.nan)
            groove = _radius_across(bottom - without_form(bottom), after.pitch)
            formulas = ball_volumes("ball", sizes, radius, groove, volume)
    if track_length is not None and track_volume is None:
        warnings.warn(
            "track_length: no track from edge to edge of the map was found",
            TriboWarning,
            stacklevel=2,
        )
    return MeasuredScar(
        registration=found,
        after=after,
        scar=scar,
        piled=worn.piled,
        volume=volume,
        volume_uncertainty=area * _sum_uncertainty(found, scar),
        piled_up=-area * float(np.nansum(depth[worn.piled])),
        depth=deepest,
        depth_uncertainty=deepest_uncertainty,
        along=None if widths is None else widths[0].value,
        along_uncertainty=None if widths is None else widths[0].uncertainty,
        across=None if widths is None else widths[1].value,
        across_uncertainty=None if widths is None else widths[1].uncertainty,
        cut_off=worn.cut_off,
        missing=float(np.mean(~known[scar])),
        section=section,
        track_volume=track_volume,
        inferred=tuple(formulas),
    )


def _warn_of_zeros(heights: Heights, which: str) -> None:
    """Warn of many heights of exactly 0, which may stand for missing values."""
    known = heights.heights[np.isfinite(heights.heights)]
    values, counts = np.unique(known, return_counts=True)
    if values.size == 1:
        words = f"every height of the map {which} is {known[0]:g} m"
        if which == "after":
            raise CaseError(f"{words}: nothing was measured; save it again")
        warnings.warn(
            f"{words}, an ideal flat; if it was measured, save it again", TriboWarning, stacklevel=3
        )
    zeros, others = (int(np.max(counts[each], initial=0)) for each in (values == 0, values != 0))
    if zeros > ZEROS * others and 2 * zeros < known.size:
        warnings.warn(
            f"{zeros} heights of the map {which} are exactly 0; put NaN where nothing was measured",
            TriboWarning,
            stacklevel=3,
        )


def _deepest(found: Registration, smooth: Array, core: Mask, noise: float) -> tuple[float, float]:
    """Return the largest depth of a scar and its standard uncertainty, in m.

    A paraboloid is fitted to the bottom, as smoothing would flatten it. The uncertainty combines
    that of its coefficients, of the registration, and the smoothed residuals of the fit beyond
    noise, as of the relief of a worn surface.
    """
    deepest = np.where(core, smooth, -np.inf)
    places, _ = ndimage.label(deepest >= BOTTOM * np.max(deepest), np.ones((3, 3)))
    bottom = places == places[np.unravel_index(int(np.argmax(deepest)), core.shape)]
    missing = bottom & np.isnan(found.depth)
    holes = ndimage.binary_opening(missing, np.ones((3, 3)))
    if np.count_nonzero(holes) > MISSED * np.count_nonzero(bottom):
        warnings.warn(
            "pixels are missing where the scar is deepest: the largest depth is that of the others",
            TriboWarning,
            stacklevel=3,
        )
    if np.count_nonzero(bottom & ~missing) < FEWEST_OF_BOTTOM:
        raise CaseError(
            "hardly any pixel of the bottom of the scar was measured; measure again, with fewer "
            "missing pixels"
        )
    residuals = without_form(np.where(bottom, found.depth, np.nan))
    form = found.depth - residuals
    places = np.argwhere(np.isfinite(residuals))
    top: tuple[int, ...] = tuple(places[int(np.argmax(form[tuple(places.T)]))])
    rough = float(np.std(smoothed(residuals)[bottom]))
    of_registration = max(float(found.uncertainty[top] ** 2 - found.noise**2), 0.0)
    of_noise = found.variance_inflation * found.noise**2
    of_relief = max(rough**2 - noise**2, 0.0)
    mean, spread = float(np.nanmean(form)), float(np.nanvar(form))
    # The largest of what noise makes of a flat bottom lies above it.
    if spread < LEVEL * of_noise / len(places):
        return mean, math.sqrt(of_noise / len(places) + of_registration + of_relief + spread)
    of_coefficients = min(_leverage(places - np.array(top, dtype=float)) * of_noise, found.noise**2)
    return float(form[top]), math.sqrt(of_coefficients + of_registration + of_relief)


def _leverage(places: Array) -> float:
    """Return the variance at the origin of a paraboloid fitted at places (n, 2), by unit noise."""
    x, y = (places / np.max(np.ptp(places, axis=0))).T
    terms = np.stack([np.ones_like(x), x, y, x**2, x * y, y**2])
    # The constant alone counts there.
    return float(np.linalg.pinv(np.einsum("kn,ln->kl", terms, terms), hermitian=True)[0, 0])


def _sum_uncertainty(found: Registration, scar: Mask) -> float:
    """Return the standard uncertainty of the sum of depths in a scar, in m.

    Missing pixels have the standard deviation of the depths around them from their smoothed ones,
    which is that of curvature and noise, fully correlated in each hole.
    """
    missing = scar & np.isnan(found.depth)
    sums = np.sum(found.slopes[:, scar], axis=1)
    of_fit = float(np.einsum("k,kl,l->", sums, found.covariance, sums))
    of_noise = found.variance_inflation * found.noise**2 * np.count_nonzero(scar & ~missing)
    sigma = np.zeros(scar.shape)
    for width in (8.0, 3.0):
        spread = np.sqrt(smoothed((found.depth - smoothed(found.depth, width)) ** 2, width))
        around = ndimage.gaussian_filter(np.isfinite(found.depth).astype(float), width)
        sigma = np.where(around > 0.1, spread, sigma)
    holes, count = ndimage.label(missing)
    each = ndimage.sum(sigma, holes, np.arange(1, count + 1))
    return math.sqrt(max(of_fit, 0.0) + of_noise + float(np.sum(np.square(each))))


def _track_volumes(
    measured: float, width: float, length: float, radius: float | None
) -> list[InferredVolume]:
    """Return the volumes of a track by formulas, for the ball that made it."""
    if radius is None:
        return []
    _check_width(width, radius)
    area = circular_groove_area(width, radius)
    ends = reciprocating_track_volume(width, radius, length)
    found = [(UNWORN, "ASTM G99", area * length), ("the same, with ends", "ASTM G133", ends)]
    return [inferred("track", *each, measured) for each in found]


def _check_width(width: float, radius: float) -> None:
    if not 0 < width < 2 * radius:
        raise CaseError(
            f"a ball of {1e3 * radius:.4g} mm radius cannot have a scar {1e3 * width:.4g} mm wide; "
            "correct radius or pitch",
            "radius",
        )


def _warn_of_curvature(unworn: Array, *, ideal: bool) -> None:
    """Warn if what is unworn differs by a curvature more than by all else."""
    if np.nanvar(without_form(unworn)) < 0.5 * np.nanvar(unworn):
        doubt = (
            "check the shape given and the pitch"
            if ideal
            else "check that the maps belong together"
        )
        warnings.warn(
            f"the unworn surfaces differ by a curvature: {doubt}, or take it off with form 2",
            TriboWarning,
            stacklevel=3,
        )


def _warn_of_radius(after: Heights, scar: Mask, radius: float) -> None:
    """Warn if the unworn surface has another radius than the ball."""
    unworn = np.where(scar, np.nan, after.heights)
    rest = without_form(unworn)
    found, noise = _radius_across(unworn - rest, after.pitch), float(np.nanstd(rest))
    sag = after.grid.size[1] ** 2 / (8 * radius)
    if sag > CURVED * noise and abs(math.log(min(found / radius, 100.0))) > RADIUS_OFF:
        warnings.warn(
            f"the unworn surface has a radius of {1e3 * found:.4g} mm, and the ball one of "
            f"{1e3 * radius:.4g} mm: check radius and pitch",
            TriboWarning,
            stacklevel=3,
        )


def _radius_across(form: Array, pitch: tuple[float, float]) -> float:
    """Return the radius of the form of a surface across the sliding direction, in m."""
    bend = float(np.nanmean(np.diff(form, 2, axis=1))) / pitch[1] ** 2
    return math.inf if bend >= 0 else -1 / bend
