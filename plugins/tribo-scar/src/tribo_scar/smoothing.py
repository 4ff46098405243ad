"""Smoothed height maps, and the pixels that lie far from their neighbours."""

from __future__ import annotations

import numpy as np
import scipy.ndimage as ndimage
from tribo import Array, Mask
from tribo.kernel_api import interpolated

BLUR = 2.0
"""Width of the Gaussian that maps are smoothed by, in pixels."""
AROUND = 4.0
"""Width of the Gaussian that weights what lies around a pixel, in pixels: of 2, 3, 4 the one with
which volumes of scars with holes held."""
OUTLIER = 6.0
"""Mean deviations by which an outlier lies beyond its neighbours; without outliers 1 of 1.2 million
pixels of `benchmarks/studies/scar_coverage.py` does, and 9 at 5."""


def outliers(heights: Array) -> Mask:
    """Return the outliers of a map, single or in pairs.

    An outlier lies, less the Gaussian mean around it, above or below all but one of its eight
    neighbours by over `OUTLIER` times the mean deviation there from the means of 3 × 3 pixels.
    """
    missing, ring = np.isnan(heights), np.array([[1, 1, 1], [1, 0, 1], [1, 1, 1]])
    whole = interpolated(heights, missing)
    whole -= ndimage.gaussian_filter(whole, AROUND)
    lower, upper = (ndimage.rank_filter(whole, rank, footprint=ring) for rank in (1, -2))
    deviation = np.abs(whole - ndimage.uniform_filter(whole, 3))
    around = smoothed(np.where(missing, np.nan, deviation), AROUND)
    found: Mask = ~missing & (np.maximum(whole - upper, lower - whole) > OUTLIER * around)
    return found


def smoothed(heights: Array, width: float = BLUR) -> Array:
    """Return the mean of known heights around each pixel, weighted by a Gaussian; 0 if far."""
    known = np.isfinite(heights)
    total, weight = (
        ndimage.gaussian_filter(each, width, mode="constant")
        for each in (np.where(known, heights, 0.0), known.astype(float))
    )
    return np.where(weight > 1e-3, total / np.maximum(weight, 1e-3), 0.0)
