"""Measured height maps, and the files they are read from."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import scipy.ndimage as ndimage
from numpy.typing import NDArray

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError, located
from tribo.core.grid import Grid
from tribo.core.number_tables import table_of_numbers
from tribo.core.rounding import ROUND_OFF
from tribo.core.units import Quantity
from tribo.registry.all_plugins import from_all_plugins

OWN = (".npy", ".csv", ".txt")
"""Files that are read without a plugin; they state no scale."""
FEWEST = 16
"""Rows of a map: more than a list of points has columns."""


@dataclass(frozen=True)
class Heights:
    """A height map on a regular grid.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny)
        Outward from the body, in m, x along the sliding direction; NaN where missing.
    pitch : tuple of float
        Distance between pixels along x and y, in m.

    Raises
    ------
    CaseError
        If it is no map of 16 × 16 pixels or more, has no height at all, or heights that differ by
        more than the map is wide, as fill values do and heights in µm taken for m.

    Examples
    --------
    >>> disk = tribo.Heights(np.zeros((40, 30)), pitch=(2e-6, 2e-6))
    >>> tuple(round(1e6 * edge) for edge in disk.grid.size)  # in µm
    (80, 60)
    """

    heights: Array
    pitch: tuple[float, float]

    def __post_init__(self) -> None:
        shape = np.shape(self.heights)
        if len(shape) != 2 or min(shape) < FEWEST:
            raise CaseError(
                f"heights of shape {shape} are no map: {FEWEST} × {FEWEST} at least are needed, a "
                "row for each x with a height for each y; a list of x, y, z is no map"
            )
        if not np.any(np.isfinite(self.heights)):
            raise CaseError("every height of the map is missing; measure again, or mask less")
        if not min(self.pitch) > 0:
            raise CaseError(f"the pitch is {self.pitch} m; give a pitch above 0, in m")
        known, width = self.heights[~np.isnan(self.heights)], max(self.grid.size)
        absurd = known[np.abs(known - np.median(known[np.isfinite(known)])) > width]
        if len(absurd):
            raise CaseError(
                f"{len(absurd)} of its {self.heights.size} heights lie further from their median "
                f"than the map is wide, {1e3 * width:.3g} mm; the first is {absurd[0]:g} m. "
                "Put NaN for fill values, where nothing was measured; heights in µm need "
                "--unit µm, or unit = 'µm' in read_heights"
            )

    @cached_property
    def filled(self) -> Array:
        """The heights, with missing ones interpolated."""
        return interpolated(self.heights, np.isnan(self.heights))

    @property
    def grid(self) -> Grid:
        """The pixels as the cells of a window."""
        nx, ny = self.heights.shape
        return Grid((nx * self.pitch[0], ny * self.pitch[1]), (nx, ny))


def read_heights(
    path: str | Path, pitch: tuple[float, float] | None = None, unit: str = "m"
) -> Heights:
    """Read a height map from a file.

    Parameters
    ----------
    path : str or Path
        A NumPy or CSV file with a table of heights, a row for each x, NaN or nothing where
        missing; or a file in a format that a plugin reads, as tribo-topography reads formats
        of instruments.
    pitch : tuple of float, optional
        Distance between pixels along x and y, in m; the file's if left out.
    unit : str, optional
        Unit of heights in a NumPy or CSV file, as ``"µm"``; other formats state theirs.

    Returns
    -------
    Heights
        The map.

    Raises
    ------
    CaseError
        If it cannot be read, or states no pitch and none is given.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     np.save(Path(folder, "disk.npy"), np.full((40, 30), 2.0))
    ...     disk = tribo.read_heights(Path(folder, "disk.npy"), pitch=(2e-6, 2e-6), unit="µm")
    >>> float(disk.heights.max()), disk.heights.shape
    (2e-06, (40, 30))
    """
    path = Path(path)
    try:
        if path.suffix.lower() in OWN:
            with located("unit"):
                scale = Quantity("m", above=0).read(f"1 {unit}")
            heights = scale * table_of_numbers(path)
            if pitch is None:
                raise CaseError(
                    f"{path} has heights and no scale; give its pitch, the distance between "
                    "pixels, as --pitch '1 um', or pitch = '1 um' in a file"
                )
        elif unit != "m":
            raise CaseError(f"{path} states its own unit; leave {unit!r} out")
        elif formats := from_all_plugins("tribo_height_formats"):
            found: Heights = formats[0].read(path)
            heights, pitch = found.heights, pitch or found.pitch
        else:
            raise CaseError(
                f"{path} is no NumPy or CSV file ({', '.join(OWN)}); install tribo-topography, "
                "which reads the files of instruments, or export it as one of those"
            )
    except ValueError as error:
        raise CaseError(str(error)) from None
    try:
        return Heights(heights, pitch)
    except CaseError as error:
        raise CaseError(f"{path}: {error}") from None


def nearest_filled(heights: Array) -> Array:
    """Return heights with missing ones filled by the nearest known."""
    missing = np.isnan(heights)
    nearest = ndimage.distance_transform_edt(missing, return_distances=False, return_indices=True)
    return np.asarray(heights[tuple(nearest)])


def interpolated(heights: Array, wanted: Mask) -> Array:
    """Return heights, the wanted ones interpolated linearly along x and y between known ones.

    A line is weighted with the inverse square of its error in a curved surface. Where known heights
    lie on one side of both lines at most, as at the map's edge, the nearest is taken.
    """
    whole = heights.copy()
    if not wanted.any():
        return whole
    total, weight = np.zeros((2, *heights.shape))
    for lines, sums, weights in ((heights, total, weight), (heights.T, total.T, weight.T)):
        values, counts = _along_rows(lines)
        sums += values * counts
        weights += counts
    between = wanted & (weight > 0)
    whole[between] = total[between] / weight[between]
    beyond = wanted & (weight == 0)
    if beyond.any():
        whole[beyond] = nearest_filled(whole)[beyond]
    return whole


def _along_rows(heights: Array) -> tuple[Array, Array]:
    """Return heights on straight lines between known ones of a row, and their weights."""
    rows, place = np.indices(heights.shape)
    known, last = np.isfinite(heights), heights.shape[1] - 1
    before = np.maximum.accumulate(np.where(known, place, -1), axis=1)
    after = np.minimum.accumulate(np.where(known, place, last + 1)[:, ::-1], axis=1)[:, ::-1]
    between = (before >= 0) & (after <= last)
    ends = [heights[rows, np.clip(end, 0, last)] for end in (before, after)]
    left, right = place - before, after - place
    part = left / np.maximum(left + right, 1)
    # The error of a chord of a parabola is the product of the distances to its ends.
    counts = np.where(between, 1 / np.maximum(left * right, 1) ** 2, 0.0)
    return np.where(between, ends[0] + part * (ends[1] - ends[0]), 0.0), counts


def without_form(height: Array, order: int = 2) -> Array:
    """Return heights less the polynomial of least squares in x and y.

    Parameters
    ----------
    height : ndarray, shape (nx, ny)
        In m; NaN where missing.
    order : int, optional
        Largest total power. 0 removes the mean, 1 the plane, and 2 the curvature as well, of a
        ball or a cylinder up to the square of the map's half-width over the radius.

    Returns
    -------
    ndarray, shape (nx, ny)
        In m; NaN where `height` is, and all NaN where it has fewer cells than the polynomial has
        terms.
    """
    known = np.isfinite(height)
    relief = np.full(height.shape, np.nan)
    powers = [(i, j) for i in range(order + 1) for j in range(order + 1 - i)]
    if np.count_nonzero(known) < len(powers):
        return relief
    heights = height[known] - np.mean(height[known])
    along, across = (
        np.polynomial.legendre.legvander(_scaled(cells), order).T for cells in np.nonzero(known)
    )
    terms = np.stack([along[i] * across[j] for i, j in powers])
    # By sums, whose bits, unlike a product's, do not depend on the number of threads.
    products = np.einsum("kn,ln->kl", terms, terms)
    # A map that is one line wide leaves the powers across it open.
    inverse = np.linalg.pinv(products, hermitian=True)
    weights = np.einsum("kl,l->k", inverse, np.einsum("kn,n->k", terms, heights))
    left = heights - np.einsum("k,kn->n", weights, terms)
    left[np.abs(left) <= ROUND_OFF * np.ptp(heights)] = 0.0
    relief[known] = left
    return relief


def _scaled(cells: NDArray[np.intp]) -> Array:
    """Return numbers of cells as positions between -1 and 1."""
    first, last = int(np.min(cells)), int(np.max(cells))
    return np.asarray((2.0 * cells - first - last) / max(last - first, 1))
