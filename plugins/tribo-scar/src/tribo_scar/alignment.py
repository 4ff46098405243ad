"""The alignment of two height maps to a pixel, by the cross-correlation of their relief."""

from __future__ import annotations

import math

import numpy as np
import scipy.fft
import scipy.ndimage as ndimage
from scipy.stats import median_abs_deviation
from tribo import Array, Heights
from tribo.kernel_api import nearest_filled

from tribo_scar.smoothing import smoothed

OVERLAP = 0.2
"""Smallest overlap of the maps, over the area of one: in less, a chance likeness of few pixels
wins."""
COARSE = 192
"""Pixels along an edge of the maps for the cross-correlation, whose transforms then have 384²."""
FINE = 4.0
"""Width of the high-pass filter that leaves the fine relief, in pixels."""
LARGEST_ROTATION = math.radians(3.0)
"""Each degree more takes a third more trials."""
SIGNIFICANT = 8.0
"""Correlation, in standard deviations, that is not chance: a million shifts reach 5."""


def align(before: Heights, after: Heights) -> tuple[Array, float]:
    """Return the position of the map after on the map before, to about a pixel.

    It is the shift of its middle from the middle of the map before, shape (2,), in m, and its
    rotation, anticlockwise, in rad.

    References
    ----------
    Padfield, D. (2012), Masked object registration in the Fourier domain, IEEE Trans. Image
    Process. 21, 2706-2718.
    """
    factor = max(1, math.ceil(max(*before.heights.shape, *after.heights.shape) / COARSE))
    (own, mask), (relief, there) = (_relief(m.heights, factor) for m in (before, after))
    shape = [scipy.fft.next_fast_len(n + m) for n, m in zip(own.shape, relief.shape, strict=True)]
    second = [np.conj(scipy.fft.rfft2(each, shape)) for each in (relief, there, relief**2)]
    step = 2.0 / max(own.shape)
    most = math.ceil(LARGEST_ROTATION / step)
    area = max(float(np.sum(there)), 1.0)
    best = (SIGNIFICANT / math.sqrt(area), np.zeros(2), 0.0)
    for steps in sorted(range(-most, most + 1), key=abs):
        angle = steps * step
        images = [_rotated(each, angle) for each in (own, mask)]
        first = [scipy.fft.rfft2(each, shape) for each in (*images, images[0] ** 2)]
        together, overlap, *squares = (
            scipy.fft.irfft2(first[i] * second[j], shape)
            for i, j in ((0, 0), (1, 1), (2, 1), (1, 2))
        )
        norm = np.prod(np.maximum(squares, 0), axis=0) + 1e-300
        score = together * np.sqrt(np.maximum(overlap, 0) / norm / area)
        score[overlap <= OVERLAP * area] = 0.0
        at = np.unravel_index(int(np.argmax(score)), score.shape)
        if score[at] > best[0]:
            lag = [k - n if k > n // 2 else k for k, n in zip(at, shape, strict=True)]
            off = np.array(lag) + 0.5 * (np.array(relief.shape) - own.shape)
            best = (float(score[at]), off, angle)
    _, shift, angle = best
    # The map before was rotated about its own middle.
    return rotation(angle) @ shift * factor * np.array(after.pitch), angle


def rotation(angle: float) -> Array:
    """Return the matrix of a rotation."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])


def _rotated(image: Array, angle: float) -> Array:
    """Return an image sampled at positions rotated about its middle by an angle."""
    middle = 0.5 * (np.array(image.shape) - 1)
    matrix = rotation(angle)
    return np.asarray(ndimage.affine_transform(image, matrix, middle - matrix @ middle, order=1))


def _relief(heights: Array, factor: int) -> tuple[Array, Array]:
    """Return the fine relief of every `factor`-th pixel, clipped, and where it is known."""
    if factor > 1:
        # Centred on the middle to half a pixel.
        lines = tuple(slice(n % factor // 2 + factor // 2, None, factor) for n in heights.shape)
        around = smoothed(np.isfinite(heights).astype(float), 0.5 * factor)[lines]
        heights = np.where(around > 0.5, smoothed(heights, 0.5 * factor)[lines], np.nan)
    known = np.isfinite(heights)
    filled = nearest_filled(heights)
    relief = filled - ndimage.gaussian_filter(filled, FINE)
    # At the border the filter is one-sided, and leaves the slope of the form.
    border = min(int(2 * FINE), min(heights.shape) // 8)
    inside = np.zeros(heights.shape, dtype=bool)
    inside[border:-border, border:-border] = True
    known &= inside
    relief -= np.median(relief[known]) if known.any() else 0.0
    most = 3 * robust_deviation(relief[known])
    return np.where(known, np.clip(relief, -most, most), 0.0), known.astype(float)


def robust_deviation(values: Array) -> float:
    """Return the standard deviation by the median absolute deviation."""
    if values.size == 0:
        return 0.0
    return float(median_abs_deviation(values, axis=None, scale="normal"))
