"""Lay a height map measured before a test on one measured after it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.fft
import scipy.ndimage as ndimage

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError
from tribo.lab.heights import Heights

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
BLOCK = 8
BLURS = 4.0, 2.0, 1.0
"""Pixels over which maps are blurred, one after the other, to lay them on each other."""
PASSES = 30
START = 0.3
"""Part of the depths below those of the form that a fit starts with: scars are deep, not high."""


@dataclass(frozen=True)
class Registration:
    """Two maps on each other.

    Parameters
    ----------
    depth : ndarray, shape (nx, ny)
        What is lost, before less after, on the pixels of the map after, in m; NaN where either is
        missing.
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
    slopes : ndarray, shape (parameters, nx, ny)
        Change of the depth with each parameter that was fitted.
    covariance : ndarray, shape (parameters, parameters)
        Of the parameters.
    spread : float
        By how much noise that is alike in neighbours adds to the variance of a sum.
    """

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
    for own, other in zip(before.pitch, after.pitch, strict=True):
        if abs(own / other - 1) > SAME:
            raise CaseError(
                f"the map before has a pixel every {_um(before.pitch)}, and that after every "
                f"{_um(after.pitch)}; measure or resample them alike"
            )
    fit = _Fit(before, after, form, *_coarse(before, after))
    for blur in BLURS:
        fit.run(blur)
    if not fit.told.size:
        fit = _Fit(before, after, form, np.zeros(2), 0.0)
        for blur in BLURS:
            fit.run(blur, moves=False)
    return fit.outcome()


class _Fit:
    """Gauss-Newton on shift, rotation and form, with pixels of the map after as unknown depths."""

    def __init__(
        self, before: Heights, after: Heights, form: int, shift: Array, angle: float
    ) -> None:
        self.before, self.after, self.pitch = before, after, np.array(after.pitch)
        self.shift, self.angle = shift, angle
        (nx, ny) = after.heights.shape
        x = (np.arange(nx) - 0.5 * (nx - 1))[:, None] * self.pitch[0] * np.ones((1, ny))
        y = (np.arange(ny) - 0.5 * (ny - 1))[None, :] * self.pitch[1] * np.ones((nx, 1))
        self.places = np.stack([x, y])
        self.lever = float(np.sqrt(np.mean(x**2 + y**2)))
        powers = [(i, j) for i in range(form + 1) for j in range(form + 1 - i)]
        edge = max(float(np.max(np.abs(x))), float(np.max(np.abs(y))))
        self.form = np.stack([(x / edge) ** i * (y / edge) ** j for i, j in powers])
        self.factors = np.zeros(len(powers))
        self.worn = np.zeros((nx, ny), dtype=bool)

    def difference(self, blur: float) -> tuple[Array, Array]:
        """Return the depth, and its slopes in shift, rotation times lever and form."""
        maps = [_blurred(_filled(m.heights), blur) for m in (self.before, self.after)]
        at = self._at()
        laid = ndimage.map_coordinates(maps[0], at, order=3, mode="nearest")
        slopes = [
            ndimage.map_coordinates(s, at, order=1, mode="nearest")
            for s in np.gradient(maps[0], *self.pitch)
        ]
        c, s = math.cos(self.angle), math.sin(self.angle)
        x, y = self.places
        turned = (slopes[0] * (-s * x - c * y) + slopes[1] * (c * x - s * y)) / self.lever
        depth = laid + np.tensordot(self.factors, self.form, 1) - maps[1]
        depth[self._missing(at)] = np.nan
        return depth, np.stack([*slopes, turned, *self.form])

    def run(self, blur: float, *, moves: bool = True) -> None:
        """Fit maps that are blurred over some pixels; form alone if nothing `moves`."""
        for step in range(PASSES):
            depth, slopes = self.difference(blur)
            known = np.isfinite(depth)
            if np.count_nonzero(known) < OVERLAP * known.size:
                raise CaseError(
                    f"the maps have only {100 * np.mean(known):.0f} % of the pixels in common; "
                    f"{100 * OVERLAP:.0f} % at least are needed"
                )
            first = step < 6 and blur == BLURS[0]
            if not first:
                self._find_scar(depth)
            used = known & ~self.worn
            if np.count_nonzero(used) < 0.1 * np.count_nonzero(known):
                raise CaseError(
                    "hardly any surface is left that is not worn, to lay the maps on each other "
                    "by; measure a larger area"
                )
            left, columns = depth[used], slopes[:, used]
            scale = _spread(left)
            if first:
                # Nearly a quantile below the median, which a scar draws off least.
                weights = 1 / np.maximum(np.abs(left), 1e-3 * scale + 1e-30)
                weights *= np.where(left > 0, START, 1 - START)
            else:
                weights = np.maximum(1 - (left / (TUKEY * scale + 1e-30)) ** 2, 0) ** 2
            weights /= np.max(weights)
            self._step(left, columns, weights, scale, blur, still=first or not moves)
            if self.moved < 1e-3 * float(np.min(self.pitch)) and step > 6:
                break

    def _step(
        self, left: Array, columns: Array, weights: Array, scale: float, blur: float, *, still: bool
    ) -> None:
        products = np.einsum("kn,ln->kl", columns * weights, columns)
        downhill = -np.einsum("kn,n->k", columns * weights, left)
        forms = products[3:, 3:]
        inverse = np.linalg.pinv(forms, hermitian=True)
        tied = products[:3, 3:] @ inverse
        own = products[:3, :3] - tied @ products[3:, :3]
        values, vectors = np.linalg.eigh(0.5 * (own + own.T))
        # Half of the noise is the map's before, whose blurred slopes have this variance.
        chance = np.sum(weights) * 0.5 * scale**2 / (2 * blur**2 * float(np.min(self.pitch)) ** 2)
        kept = values > TEXTURE * chance
        self.told = vectors[:, kept]
        moves = np.zeros(3)
        if not still and kept.any():
            aim = downhill[:3] - tied @ downhill[3:]
            moves = self.told @ ((self.told.T @ aim) / values[kept])
        self.factors += inverse @ (downhill[3:] - products[3:, :3] @ moves)
        self.shift = self.shift + moves[:2]
        self.angle += moves[2] / self.lever
        self.moved = float(np.max(np.abs(moves), initial=0.0))

    def _find_scar(self, depth: Array) -> None:
        smooth = smoothed(depth)
        # The side without the scar tells the noise.
        raised = smooth[np.isfinite(depth) & (smooth <= 0)]
        noise = 1.4826 * float(np.median(-raised)) if raised.size else 0.0
        worn = np.abs(smooth) > DEEP * noise
        # A relief that does not lie on its like yet has spots, and a scar is more than a spot.
        worn = ndimage.binary_opening(worn, iterations=3)
        if np.mean(worn) < 0.8:
            self.worn = ndimage.binary_dilation(worn, iterations=4)

    def _at(self) -> Array:
        """Return where each pixel of the map after lies in that before, in pixels."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        x, y = self.places
        laid = np.stack([c * x - s * y + self.shift[0], s * x + c * y + self.shift[1]])
        middle = 0.5 * (np.array(self.before.heights.shape) - 1)
        at: Array = laid / self.pitch[:, None, None] + middle[:, None, None]
        return at

    def _missing(self, at: Array) -> Mask:
        gone = np.isnan(self.before.heights).astype(float)
        laid = ndimage.map_coordinates(gone, at, order=1, mode="constant", cval=1.0)
        missing: Mask = (laid > 1e-6) | np.isnan(self.after.heights)
        return missing

    def outcome(self) -> Registration:
        """Return the depth and what is known of it."""
        blurred, slopes = self.difference(1.0)
        used = np.isfinite(blurred) & ~self.worn
        columns = slopes[:, used]
        basis = np.zeros((len(slopes), self.told.shape[1] + len(self.form)))
        basis[:3, : self.told.shape[1]] = self.told
        basis[3:, self.told.shape[1] :] = np.eye(len(self.form))
        products = basis.T @ np.einsum("kn,ln->kl", columns, columns) @ basis
        variance = float(np.var(blurred[used])) * _blocks(np.where(used, blurred, np.nan))
        covariance = variance * basis @ np.linalg.pinv(products, hermitian=True) @ basis.T
        depth, _ = self.difference(0.0)
        noise = _spread(depth[used])
        from_fit = np.einsum("kxy,kl,lxy->xy", slopes, covariance, slopes, optimize=True)
        fixed = 1 - np.sum(self.told**2, axis=1) > 0.5
        sure = np.where(fixed, np.inf, np.sqrt(np.maximum(np.diag(covariance)[:3], 0)))
        uncertainty = np.sqrt(noise**2 + np.maximum(from_fit, 0))
        return Registration(
            depth=depth,
            uncertainty=np.where(np.isfinite(depth), uncertainty, np.nan),
            shift=(float(self.shift[0]), float(self.shift[1])),
            shift_uncertainty=(float(sure[0]), float(sure[1])),
            rotation=float(self.angle),
            rotation_uncertainty=float(sure[2] / self.lever),
            noise=noise,
            worn=self.worn,
            slopes=slopes,
            covariance=covariance,
            spread=_blocks(np.where(used, depth, np.nan)),
        )


def smoothed(depth: Array, width: float = 2.0) -> Array:
    """Return the mean of what is known around each pixel, weighted by a Gaussian."""
    known = np.isfinite(depth).astype(float)
    total = ndimage.gaussian_filter(np.where(known > 0, depth, 0.0), width, mode="constant")
    weight = ndimage.gaussian_filter(known, width, mode="constant")
    mean: Array = np.where(weight > 1e-3, total / np.maximum(weight, 1e-3), 0.0)
    return mean


def _coarse(before: Heights, after: Heights) -> tuple[Array, float]:
    """Return shift (m) and rotation of the largest correlation; 0 where none stands out."""
    factor = max(1, math.ceil(max(*before.heights.shape, *after.heights.shape) / COARSE))
    reliefs = [_fine(_binned(m.heights, factor)) for m in (before, after)]
    shape = [scipy.fft.next_fast_len(sum(m.shape[k] for m, _ in reliefs)) for k in (0, 1)]
    relief, there = reliefs[1]
    second = [scipy.fft.rfft2(each, shape) for each in (relief, there, relief**2)]
    step = 2.0 / max(reliefs[0][0].shape)
    turns = np.arange(-math.ceil(FURTHEST / step), math.ceil(FURTHEST / step) + 1) * step
    best = (0.0, np.zeros(2), 0.0)
    for angle in turns[np.argsort(np.abs(turns), kind="stable")]:
        own, mask = (_turned(each, angle) for each in reliefs[0])
        first = [scipy.fft.rfft2(each, shape) for each in (own, mask, own**2)]

        def correlate(i: int, j: int, of: list[Array] = first) -> Array:
            together = np.conj(second[j]) * of[i]
            return np.asarray(scipy.fft.irfft2(together, shape))

        overlap = correlate(1, 1)
        norms = np.maximum(correlate(2, 1), 0) * np.maximum(correlate(1, 2), 0)
        enough = overlap > OVERLAP * np.sum(there)
        score = np.where(enough, correlate(0, 0) / np.sqrt(norms + 1e-300), 0.0)
        score *= np.sqrt(np.maximum(overlap, 0.0))
        at = np.unravel_index(int(np.argmax(score)), score.shape)
        if score[at] > best[0]:
            lag = np.array([k - n if k > n // 2 else k for k, n in zip(at, shape, strict=True)])
            middles = [0.5 * (np.array(each[0].shape) - 1) for each in reliefs]
            best = (float(score[at]), lag + middles[1] - middles[0], float(angle))
    certain, shift, angle = best
    if certain < CERTAIN:
        return np.zeros(2), 0.0
    c, s = math.cos(angle), math.sin(angle)
    # The map before was turned about its own middle.
    shift = np.array([c * shift[0] - s * shift[1], s * shift[0] + c * shift[1]])
    return shift * factor * np.array(after.pitch), angle


def _turned(image: Array, angle: float) -> Array:
    """Return an image about whose middle places are turned by an angle."""
    if angle == 0:
        return image
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    middle = 0.5 * (np.array(image.shape) - 1)
    turned: Array = ndimage.affine_transform(image, turn, middle - turn @ middle, order=1)
    return turned


def _fine(heights: Array) -> tuple[Array, Array]:
    """Return the relief of waves of some pixels, its outliers cut, and where it is known."""
    known = np.isfinite(heights)
    filled = _filled(heights)
    relief = filled - ndimage.gaussian_filter(filled, FINE)
    # At the border the mean lies to one side, and has the form's slope in it.
    border = min(int(2 * FINE), min(heights.shape) // 8)
    inside = np.zeros(heights.shape, dtype=bool)
    inside[border:-border, border:-border] = True
    known &= inside
    relief -= np.median(relief[known]) if known.any() else 0.0
    most = 3 * _spread(relief[known])
    return np.where(known, np.clip(relief, -most, most), 0.0), known.astype(float)


def _binned(heights: Array, factor: int) -> Array:
    """Return means over squares of pixels, NaN where half of them are missing."""
    if factor == 1:
        return heights
    nx, ny = (n // factor for n in heights.shape)
    # The squares lie about the middle.
    begin = [(n - k * factor) // 2 for n, k in zip(heights.shape, (nx, ny), strict=True)]
    part = heights[begin[0] : begin[0] + nx * factor, begin[1] : begin[1] + ny * factor]
    squares = part.reshape(nx, factor, ny, factor)
    known = np.isfinite(squares)
    count = np.sum(known, axis=(1, 3))
    total = np.sum(np.where(known, squares, 0.0), axis=(1, 3))
    return np.where(2 * count > factor**2, total / np.maximum(count, 1), np.nan)


def _filled(heights: Array) -> Array:
    """Return heights with the nearest known one where one is missing."""
    missing = np.isnan(heights)
    if not missing.any():
        return heights
    nearest = ndimage.distance_transform_edt(missing, return_distances=False, return_indices=True)
    return np.asarray(heights[tuple(nearest)])


def _blurred(heights: Array, width: float) -> Array:
    return np.asarray(ndimage.gaussian_filter(heights, width)) if width else heights


def _spread(values: Array) -> float:
    """Return the standard deviation of normal values, by their median magnitude."""
    if values.size == 0:
        return 0.0
    return 1.4826 * float(np.median(np.abs(values - np.median(values))))


def _blocks(values: Array) -> float:
    """Return the variance of means over blocks, relative to that of independent values."""
    nx, ny = (n // BLOCK for n in values.shape)
    blocks = values[: nx * BLOCK, : ny * BLOCK].reshape(nx, BLOCK, ny, BLOCK)
    known = np.isfinite(blocks)
    count = np.sum(known, axis=(1, 3))
    full = 2 * count > BLOCK**2
    own = float(np.nanvar(values)) if known.any() else 0.0
    if np.count_nonzero(full) < BLOCK or own == 0:
        return 1.0
    sums = np.sum(np.where(known, blocks - np.nanmean(values), 0.0), axis=(1, 3))[full]
    return max(1.0, float(np.mean(sums**2 / count[full])) / own)


def _um(pitch: tuple[float, float]) -> str:
    return " × ".join(f"{1e6 * each:.6g}" for each in pitch) + " µm"
