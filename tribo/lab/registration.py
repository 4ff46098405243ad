"""Lay a height map measured before a test on one measured after it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.fft
import scipy.ndimage as ndimage

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError
from tribo.lab.heights import Heights, smoothed

SAME = 1e-3
"""Relative difference up to which two pitches are the same."""
COARSE = 192
"""Pixels along an edge in which the maps are first looked for."""
FINE = 4.0
"""Pixels over which heights are averaged, to leave the fine relief."""
FURTHEST = math.radians(3.0)
"""Largest rotation that is looked for."""
OVERLAP = 0.2
"""Smallest part of a map that must lie on the other."""
CERTAIN = 8.0
"""Standard deviations by which the place found must stand out from chance."""
TEXTURE = 3.0
"""Slopes squared, relative to those of noise, from which on they tell where a map lies."""
TUKEY = 4.685
DEEP = 4.0
"""Standard deviations of noise from which on a difference is a scar."""
ROUNDING = 1e-4
"""Part of the largest depth that is no more than noise, at the least."""
BLOCK = 8
BLURS = 4.0, 2.0, 1.0
"""Pixels over which maps are blurred, one after the other, to lay them on each other."""
PASSES = 30
FIRST = 6
"""Passes in which the form alone is fitted."""
START = 0.3
"""Part of the depths below those of the form that a fit starts with: scars are deep, not high."""


@dataclass(frozen=True)
class Registration:
    """Two maps on each other, where both reach.

    Parameters
    ----------
    part : tuple of slice
        The pixels of the map after that have a depth, along x and y.
    depth : ndarray, shape (nx, ny)
        What is lost, before less after, on these pixels, in m; NaN where either is missing.
    uncertainty : ndarray, shape (nx, ny)
        Standard uncertainty of the depth, of noise and of the registration, in m.
    shift, shift_uncertainty : tuple of float
        Where the middle of the map after lies in that before, from its middle, in m. The
        uncertainty is infinite where the maps do not tell, as two smooth balls do not: a tilt does
        to them what a shift does. Where they tell nothing they are not moved.
    rotation, rotation_uncertainty : float
        Anticlockwise, of the map after against that before, in rad.
    noise : float
        Standard deviation of the unworn differences, in m.
    worn : ndarray of bool, shape (nx, ny)
        The pixels that were left out as worn or as piled up.
    slopes : ndarray
        Change of the depth with each parameter that was fitted, a map (nx, ny) for each.
    covariance : ndarray
        Of the parameters, square.
    spread : float
        By how much noise that is alike in neighbours adds to the variance of a sum.
    """

    part: tuple[slice, slice]
    depth: Array
    uncertainty: Array
    shift: tuple[float, float]
    shift_uncertainty: tuple[float, float]
    rotation: float
    rotation_uncertainty: float
    noise: float
    worn: Mask
    slopes: Array
    covariance: Array
    spread: float


def register(before: Heights, after: Heights, form: int = 1) -> Registration:
    """Return how a map measured after a test lies on that measured before, and what differs.

    What is sought are a shift, a rotation about z and a polynomial of order `form` in x and y,
    such that unworn surface agrees in the sense of least squares, with weights of Tukey against
    outliers and without the scar, which is found with them. They start from the largest masked
    cross-correlation of the fine relief. Of shifts and rotation those are left alone of which the
    relief tells no more than noise does, as that of two smooth bodies.

    Raises
    ------
    CaseError
        If the maps have another pitch, do not overlap, or no unworn surface is left.

    References
    ----------
    Padfield, D. (2012), Masked object registration in the Fourier domain, IEEE Trans. Image
    Process. 21, 2706-2718. Baker, S., Matthews, I. (2004), Lucas-Kanade 20 years on, Int. J.
    Comput. Vis. 56, 221-255.
    """
    if not np.allclose(before.pitch, after.pitch, rtol=SAME, atol=0):
        first, second = (
            " × ".join(f"{1e6 * each:.6g}" for each in m.pitch) + " µm" for m in (before, after)
        )
        raise CaseError(
            f"the map before has a pixel every {first}, and that after every {second}; measure or "
            "resample them alike"
        )
    fit = _Fit(before, after, form, *_coarse(before, after))
    fit.run()
    if not fit.told.size:
        fit = _Fit(before, after, form, np.zeros(2), 0.0)
        fit.run(moves=False)
    return fit.outcome()


class _Fit:
    """Gauss-Newton on shift, rotation and form, with pixels of the map after as unknown depths."""

    def __init__(
        self, before: Heights, after: Heights, form: int, shift: Array, angle: float
    ) -> None:
        self.before, self.after, self.pitch = before, after, np.array(after.pitch)
        self.shift, self.angle = shift, angle
        self.places = np.stack(np.broadcast_arrays(*after.grid.mesh))
        self.lever = float(np.sqrt(np.mean(np.sum(self.places**2, axis=0))))
        x, y = self.places / np.max(np.abs(self.places))
        self.form = np.stack([x**i * y**j for i in range(form + 1) for j in range(form + 1 - i)])
        self.factors = np.zeros(len(self.form))
        self.worn = np.zeros(after.heights.shape, dtype=bool)
        self.told = np.zeros((3, 0))
        """Directions of shift and rotation times lever that the relief tells."""

    def run(self, *, moves: bool = True) -> None:
        """Fit maps that are blurred less and less; form alone if nothing `moves`."""
        for blur in BLURS:
            for step in range(PASSES):
                first = step < FIRST and blur == BLURS[0]
                moved = self._improve(blur, first=first, still=first or not moves)
                if moved < 1e-3 * np.min(self.pitch) and step > FIRST:
                    break

    def difference(self, blur: float) -> tuple[Array, Array]:
        """Return the depth, and its slopes in shift, rotation times lever and form."""
        before, after = (_filled(m.heights) for m in (self.before, self.after))
        if blur:
            before, after = (ndimage.gaussian_filter(each, blur) for each in (before, after))
        turn = _turn(self.angle)
        laid = np.einsum("ij,jxy->ixy", turn, self.places) + self.shift[:, None, None]
        middle = 0.5 * (np.array(before.shape) - 1)
        at = laid / self.pitch[:, None, None] + middle[:, None, None]
        own = [
            ndimage.map_coordinates(slope, at, order=1, mode="nearest")
            for slope in np.gradient(before, *self.pitch)
        ]
        x, y = np.einsum("ij,jxy->ixy", turn, self.places)
        slopes = np.stack([*own, (own[1] * x - own[0] * y) / self.lever, *self.form])
        depth = ndimage.map_coordinates(before, at, order=3, mode="nearest")
        depth += np.tensordot(self.factors, self.form, 1) - after
        gone = np.isnan(self.before.heights).astype(float)
        gone = ndimage.map_coordinates(gone, at, order=1, mode="constant", cval=1.0)
        return np.where((gone > 1e-6) | np.isnan(self.after.heights), np.nan, depth), slopes

    def _improve(self, blur: float, *, first: bool, still: bool) -> float:
        """Take a step of the fit, and return how far the map has moved, in m."""
        depth, slopes = self.difference(blur)
        known = np.isfinite(depth)
        if np.count_nonzero(known) < OVERLAP * known.size:
            raise CaseError(
                f"the maps have only {100 * np.mean(known):.0f} % of the pixels in common; "
                f"{100 * OVERLAP:.0f} % at least are needed"
            )
        if not first:
            self._find_scar(depth)
        used = known & ~self.worn
        if np.count_nonzero(used) < 0.1 * np.count_nonzero(known):
            raise CaseError(
                "hardly any surface is left that is not worn, to lay the maps on each other by; "
                "measure a larger area"
            )
        left, columns = depth[used], slopes[:, used]
        scale = _deviation(left)
        if first:
            # Nearly a quantile below the median, which a scar draws off least.
            weights = np.where(left > 0, START, 1 - START)
            weights /= np.maximum(np.abs(left), 1e-3 * scale + 1e-30)
        else:
            # Without noise all may be off alike, and yet far beyond their deviation.
            most = TUKEY * max(scale, float(np.median(np.abs(left)))) + 1e-30
            weights = np.maximum(1 - (left / most) ** 2, 0) ** 2
        weights /= np.max(weights)
        products = np.einsum("kn,ln->kl", columns * weights, columns)
        downhill = -np.einsum("kn,n->k", columns * weights, left)
        inverse = np.linalg.pinv(products[3:, 3:], hermitian=True)
        tied = products[:3, 3:] @ inverse
        values, vectors = np.linalg.eigh(products[:3, :3] - tied @ products[3:, :3])
        # Half of the noise is the map's before, whose blurred slopes have this variance.
        chance = np.sum(weights) * 0.25 * (scale / (blur * np.min(self.pitch))) ** 2
        kept = values > TEXTURE * chance
        self.told = vectors[:, kept]
        moves = np.zeros(3)
        if not still:
            aim = self.told.T @ (downhill[:3] - tied @ downhill[3:])
            moves = self.told @ (aim / values[kept])
        self.factors += inverse @ (downhill[3:] - products[3:, :3] @ moves)
        self.shift = self.shift + moves[:2]
        self.angle += moves[2] / self.lever
        return float(np.max(np.abs(moves)))

    def _find_scar(self, depth: Array) -> None:
        smooth = smoothed(depth)
        # The side without the scar tells the noise.
        raised = smooth[np.isfinite(depth) & (smooth <= 0)]
        noise = 1.4826 * float(np.median(-raised)) if raised.size else 0.0
        # Maps without any noise differ by rounding.
        noise = max(noise, ROUNDING * float(np.max(smooth)))
        # A relief that does not lie on its like yet has spots, and a scar is more than a spot.
        worn = ndimage.binary_opening(np.abs(smooth) > DEEP * noise, iterations=3)
        if np.mean(worn) < 0.8:
            self.worn = ndimage.binary_dilation(worn, iterations=4)

    def outcome(self) -> Registration:
        """Return the depth and what is known of it."""
        blurred, slopes = self.difference(1.0)
        used = np.isfinite(blurred) & ~self.worn
        columns = slopes[:, used]
        basis = np.eye(len(slopes))
        basis[:3, :3] = self.told @ self.told.T
        products = basis @ np.einsum("kn,ln->kl", columns, columns) @ basis
        variance = float(np.var(blurred[used])) * _spread(np.where(used, blurred, np.nan))
        covariance = variance * np.linalg.pinv(products, rcond=1e-12, hermitian=True)
        depth, _ = self.difference(0.0)
        noise = _deviation(depth[used])
        from_fit = np.einsum("kxy,kl,lxy->xy", slopes, covariance, slopes, optimize=True)
        uncertainty = np.sqrt(noise**2 + np.maximum(from_fit, 0))
        sure = np.sqrt(np.maximum(np.diag(covariance)[:3], 0))
        sure[np.diag(basis)[:3] < 0.5] = np.inf
        part = _in_common(depth)
        return Registration(
            part=part,
            depth=depth[part],
            uncertainty=np.where(np.isfinite(depth), uncertainty, np.nan)[part],
            shift=(float(self.shift[0]), float(self.shift[1])),
            shift_uncertainty=(float(sure[0]), float(sure[1])),
            rotation=float(self.angle),
            rotation_uncertainty=float(sure[2] / self.lever),
            noise=noise,
            worn=self.worn[part],
            slopes=slopes[:, *part],
            covariance=covariance,
            spread=_spread(np.where(used, depth, np.nan)),
        )


def _in_common(depth: Array) -> tuple[slice, slice]:
    """Return the lines along x and y of which half is known, from the first to the last."""
    known = np.isfinite(depth)
    parts = (np.mean(known, axis=1), np.mean(known, axis=0))
    lines = [np.flatnonzero(part >= 0.5 * np.max(part)) for part in parts]
    along, across = (slice(int(each[0]), int(each[-1]) + 1) for each in lines)
    return along, across


def _coarse(before: Heights, after: Heights) -> tuple[Array, float]:
    """Return shift (m) and rotation of the largest correlation; 0 where none stands out."""
    factor = max(1, math.ceil(max(*before.heights.shape, *after.heights.shape) / COARSE))
    (own, mask), (relief, there) = (_relief(m.heights, factor) for m in (before, after))
    shape = [scipy.fft.next_fast_len(n + m) for n, m in zip(own.shape, relief.shape, strict=True)]
    second = [np.conj(scipy.fft.rfft2(each, shape)) for each in (relief, there, relief**2)]
    step = 2.0 / max(own.shape)
    most = math.ceil(FURTHEST / step)
    best = (CERTAIN, np.zeros(2), 0.0)
    for turn in sorted(range(-most, most + 1), key=abs):
        angle = turn * step
        images = [_turned(each, angle) for each in (own, mask)]
        first = [scipy.fft.rfft2(each, shape) for each in (*images, images[0] ** 2)]
        together, overlap, *squares = (
            scipy.fft.irfft2(first[i] * second[j], shape)
            for i, j in ((0, 0), (1, 1), (2, 1), (1, 2))
        )
        norm = np.prod(np.maximum(squares, 0), axis=0) + 1e-300
        score = together * np.sqrt(np.maximum(overlap, 0) / norm)
        score[overlap <= OVERLAP * np.sum(there)] = 0.0
        at = np.unravel_index(int(np.argmax(score)), score.shape)
        if score[at] > best[0]:
            lag = [k - n if k > n // 2 else k for k, n in zip(at, shape, strict=True)]
            off = np.array(lag) + 0.5 * (np.array(relief.shape) - own.shape)
            best = (float(score[at]), off, angle)
    _, shift, angle = best
    # The map before was turned about its own middle.
    return _turn(angle) @ shift * factor * np.array(after.pitch), angle


def _turn(angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])


def _turned(image: Array, angle: float) -> Array:
    """Return an image about whose middle places are turned by an angle."""
    middle = 0.5 * (np.array(image.shape) - 1)
    turn = _turn(angle)
    return np.asarray(ndimage.affine_transform(image, turn, middle - turn @ middle, order=1))


def _relief(heights: Array, factor: int) -> tuple[Array, Array]:
    """Return every so manieth pixel of the fine relief, outliers cut, and where it is known."""
    if factor > 1:
        # About the middle, but for half a pixel.
        lines = tuple(slice(n % factor // 2 + factor // 2, None, factor) for n in heights.shape)
        around = smoothed(np.isfinite(heights).astype(float), 0.5 * factor)[lines]
        heights = np.where(around > 0.5, smoothed(heights, 0.5 * factor)[lines], np.nan)
    known = np.isfinite(heights)
    filled = _filled(heights)
    relief = filled - ndimage.gaussian_filter(filled, FINE)
    # At the border the mean lies to one side, and has the form's slope in it.
    border = min(int(2 * FINE), min(heights.shape) // 8)
    inside = np.zeros(heights.shape, dtype=bool)
    inside[border:-border, border:-border] = True
    known &= inside
    relief -= np.median(relief[known]) if known.any() else 0.0
    most = 3 * _deviation(relief[known])
    return np.where(known, np.clip(relief, -most, most), 0.0), known.astype(float)


def _filled(heights: Array) -> Array:
    """Return heights with the nearest known one where one is missing."""
    missing = np.isnan(heights)
    nearest = ndimage.distance_transform_edt(missing, return_distances=False, return_indices=True)
    return np.asarray(heights[tuple(nearest)])


def _deviation(values: Array) -> float:
    """Return the standard deviation of normal values, by their median magnitude."""
    if values.size == 0:
        return 0.0
    return 1.4826 * float(np.median(np.abs(values - np.median(values))))


def _spread(values: Array) -> float:
    """Return the variance of means over blocks, relative to that of independent values."""
    known = np.isfinite(values)
    centred = np.where(known, values - np.mean(values[known]), 0.0)
    nx, ny = (n // BLOCK for n in values.shape)
    sums, count = (
        np.sum(each[: nx * BLOCK, : ny * BLOCK].reshape(nx, BLOCK, ny, BLOCK), axis=(1, 3))
        for each in (centred, known)
    )
    full = 2 * count > BLOCK**2
    own = float(np.mean(centred[known] ** 2))
    if np.count_nonzero(full) < BLOCK or own == 0:
        return 1.0
    return max(1.0, float(np.mean(sums[full] ** 2 / count[full])) / own)
