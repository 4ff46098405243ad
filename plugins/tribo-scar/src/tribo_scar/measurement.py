"""Volume, depth and widths of a scar from height maps before and after a test."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import scipy.ndimage as ndimage
from tribo import Array, CaseError, Heights, InferredVolume, Mask, Sphere, Surface
from tribo.kernel_api import (
    UNWORN,
    Scar,
    ball_volumes,
    circular_groove_area,
    inferred,
    reciprocating_track_volume,
    without_form,
)

from tribo_scar.depth import deepest, sum_uncertainty
from tribo_scar.findings import check_measured, check_scales, warn, warn_of_area
from tribo_scar.registration import Registration, register
from tribo_scar.smoothing import outliers
from tribo_scar.widths import LINES, WidthReading, scar_width
from tribo_scar.worn_area import MARGIN, WornArea, worn_area

MOST_DIGITS = 6
"""Digits of a size that are printed, as of maps without noise."""
MOST = 0.65
"""Part of the map that a scar may cover, with its margin."""


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
        The pixels of the scar, and the pixels of material piled up beside it.
    volume, volume_uncertainty : float
        Volume of the scar within the map, in m³.
    piled_up, piled_up_uncertainty : float
        Volume above the surface before, within the map, in m³.
    depth, depth_uncertainty : float
        Largest depth, of a paraboloid through the bottom of the scar, in m.
    along, across : float
        Widths along and across the sliding direction, in m; infinite for a track, which reaches
        both edges of the map, and None for a scar that is cut off and for several.
    along_uncertainty, across_uncertainty : float
        Standard uncertainties of these, by noise and by the deviation of the edge from a parabola.
    cut_off : bool
        Whether the scar extends beyond the edge of the map, other than at the ends of a track.
    missing : float
        Part of the scar's pixels that are missing; their depth is interpolated.
    outliers : int
        Pixels of both maps that are outliers, taken as missing.
    section : float or None
        Mean cross-section of a track, across its direction, in m²; None for a scar that ends within
        the map.
    track_volume : float or None
        Of the whole track, its mean section times its length (ASTM G133, D7755), in m³; None
        without a length, and for a scar that ends within the map.
    inferred : tuple of InferredVolume
        Volumes by formulas, and their difference from the measured one.

    Examples
    --------
    >>> from tribo_scar import measured_scar
    >>> x, y = tribo.Grid("0.2 mm", 100).mesh
    >>> worn = np.maximum(1e-6 * (1 - (x**2 + y**2) / 40e-6**2), 0)
    >>> scar = measured_scar(tribo.Flat(), tribo.Heights(-worn, pitch=(2e-6, 2e-6)))
    >>> scar.is_track, round(1e6 * scar.along), round(1e6 * scar.across)  # widths in µm
    (False, 80, 80)
    """

    registration: Registration
    after: Heights
    scar: Mask
    piled: Mask
    volume: float
    volume_uncertainty: float
    piled_up: float
    piled_up_uncertainty: float
    depth: float
    depth_uncertainty: float
    along: float | None
    along_uncertainty: float | None
    across: float | None
    across_uncertainty: float | None
    cut_off: bool
    missing: float
    outliers: int
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
        found, turned = self.registration, self.registration.rotation_uncertainty
        units = {"volume": "m3", "piled_up": "m3", "depth": "m", "along": "m", "across": "m"}
        return {
            f"{name}{what}_{unit}": getattr(self, f"{name}{what}")
            for name, unit in units.items()
            for what in ("", "_uncertainty")
        } | {
            "is_track": self.is_track,
            "cut_off": self.cut_off,
            "section_m2": self.section,
            "track_volume_m3": self.track_volume,
            "missing": self.missing,
            "outliers": self.outliers,
            "noise_m": found.noise,
            "shift_m": [
                shift if math.isfinite(sure) else None
                for shift, sure in zip(found.shift, found.shift_uncertainty, strict=True)
            ],
            "shift_uncertainty_m": list(found.shift_uncertainty),
            "rotation_rad": found.rotation if math.isfinite(turned) else None,
            "rotation_uncertainty_rad": turned,
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
        Radius of the ball, in m, for the formulas that need it; for a scar on an ideal
        sphere the radius of the sphere by default.
    track_length : float, optional
        Length of the whole track, in m: the stroke, or 2πr. By default its length in the map.
    form : int, optional
        Order of the polynomial form that is removed from the difference: 1 for tilt, 2 for
        curvature as well, such as from an instrument, or from an uncertain radius of a ball.

    Returns
    -------
    MeasuredScar
        Volumes, depth and widths with uncertainties, and the depth map.

    Raises
    ------
    CaseError
        If the maps cannot be registered (see `register`), or nothing is worn.

    Examples
    --------
    >>> from tribo_scar import measured_scar
    >>> x, y = tribo.Grid("0.2 mm", 100).mesh
    >>> worn = np.maximum(1e-6 * (1 - (x**2 + y**2) / 40e-6**2), 0)
    >>> scar = measured_scar(tribo.Flat(), tribo.Heights(-worn, pitch=(2e-6, 2e-6)))
    >>> round(1e18 * scar.volume), round(1e6 * scar.depth, 2)  # in µm³ and µm
    (2513, 1.0)
    """
    if form not in (1, 2):
        raise CaseError(f"form is 1 (a tilt) or 2 (a curvature as well), not {form}", "form")
    ideal, count_of_outliers = isinstance(before, Surface), 0
    own_radius = before.radius if isinstance(before, Sphere) else None
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
        check_scales(before, after)
        before, count_of_outliers = _without_outliers(before, "before")
    check_measured(after)
    after, count = _without_outliers(after, "after")
    found = register(before, after, form)
    shape = after.heights.shape
    after = Heights(after.heights[found.part], after.pitch)
    covered = float(np.mean(found.worn))
    if covered > MOST:
        raise CaseError(
            f"{100 * covered:.0f} % of the {shape[0]} × {shape[1]} pixels differ, or lie next to "
            "differing pixels, too many to register the maps by the rest; measure a larger area, "
            "half of it unworn, or with smaller pixels"
        )
    worn = worn_area(found, after.pitch, ideal=ideal)
    smooth, depth, known, scar = worn.smooth, worn.depth, worn.known, worn.scar
    area = after.grid.cell_area
    volume = area * float(np.sum(depth[scar]))
    volume_uncertainty = area * sum_uncertainty(found, scar)
    warn_of_area(worn, within=max(np.subtract(shape, found.depth.shape)) > MARGIN)
    sizes = _Sizes()
    if not worn.several and not worn.cut_off:
        ball = own_radius if radius is None and not worn.track else radius
        sizes = _sizes(found, worn, after, volume, ball, track_length)
    if track_length is not None and sizes.track_volume is None:
        warn("track_length: no track from edge to edge of the map was found")
    largest, largest_uncertainty = deepest(found, smooth, worn.core, worn.noise)
    (along, along_uncertainty), (across, across_uncertainty) = sizes.along, sizes.across
    return MeasuredScar(
        registration=found,
        after=after,
        scar=scar,
        piled=worn.piled,
        volume=volume,
        volume_uncertainty=volume_uncertainty,
        piled_up=area * float(np.sum(-depth[worn.piled])),
        piled_up_uncertainty=area * sum_uncertainty(found, worn.piled),
        depth=largest,
        depth_uncertainty=largest_uncertainty,
        along=along,
        along_uncertainty=along_uncertainty,
        across=across,
        across_uncertainty=across_uncertainty,
        cut_off=worn.cut_off,
        missing=float(np.mean(~known[scar])),
        outliers=count_of_outliers + count,
        section=sizes.section,
        track_volume=sizes.track_volume,
        inferred=tuple(sizes.formulas),
    )


def _without_outliers(measured: Heights, which: str) -> tuple[Heights, int]:
    """Return a map with its outliers missing, and their number."""
    unlike = outliers(measured.heights)
    if not unlike.any():
        return measured, 0
    count = int(np.count_nonzero(unlike))
    warn(
        f"{count} pixels of the map {which} are outliers: they lie far from all but one of their "
        "neighbours, and are taken as missing"
    )
    return Heights(np.where(unlike, np.nan, measured.heights), measured.pitch), count


class _Sizes(NamedTuple):
    """Widths of a scar, section and volume of a track, and volumes by formulas; None if unknown."""

    along: WidthReading | tuple[None, None] = (None, None)
    across: WidthReading | tuple[None, None] = (None, None)
    section: float | None = None
    track_volume: float | None = None
    formulas: Sequence[InferredVolume] = ()


def _sizes(
    found: Registration,
    worn: WornArea,
    after: Heights,
    volume: float,
    radius: float | None,
    track_length: float | None,
) -> _Sizes:
    """Return the sizes of one scar that lies in the map."""
    if worn.track and worn.length:
        section, length = volume / worn.length, track_length or worn.length
        if length < worn.length:
            raise CaseError(
                f"{1e3 * length:.4g} mm is too short: the track is {1e3 * worn.length:.4g} mm long "
                "within the map alone; give the length of all of it",
                "track_length",
            )
        whole = section * length
        formulas = _track_volumes(whole, worn.track.value, length, radius)
        ends = (WidthReading(math.inf, 0.0), worn.track)
        along, across = ends if worn.is_open[0] else ends[::-1]
        return _Sizes(along, across, section, whole if track_length else None, formulas)
    # Correlated noise does not average out over neighbours.
    of_lines = found.noise * math.sqrt(min(found.variance_inflation / LINES, 1.0))
    along, across = (
        scar_width(found.depth, worn.smooth, worn.scar, of_lines, axis, after.pitch[axis])
        for axis in (0, 1)
    )
    if radius is None:
        return _Sizes(along, across)
    sizes = Scar(along.value, across.value)
    _check_width(max(sizes), radius)
    # Smoothing widens the core beyond what is worn.
    inner = ndimage.binary_erosion(worn.core, iterations=MARGIN)
    bottom = np.where(inner, after.heights, np.nan)
    form = bottom - without_form(bottom)
    bend = float(np.nanmean(np.diff(form, 2, axis=1))) / after.pitch[1] ** 2
    groove = math.inf if bend >= 0 else -1 / bend
    return _Sizes(along, across, formulas=ball_volumes("ball", sizes, radius, groove, volume))


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
