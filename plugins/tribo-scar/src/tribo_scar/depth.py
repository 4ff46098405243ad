"""The largest depth of a measured scar, and the uncertainties of depth and volume."""

from __future__ import annotations

import math

import numpy as np
import scipy.ndimage as ndimage
from tribo import Array, CaseError, Mask
from tribo.kernel_api import nearest_filled

from tribo_scar.registration import Registration, quadratic
from tribo_scar.smoothing import AROUND, smoothed

BOTTOM = 0.8
"""Part of the largest depth above which a pixel belongs to the bottom of the scar."""
LEVEL = 10.0
"""Variance of the form of a bottom, relative to that by noise of a mean, below which it is flat; 5
by noise alone."""


def deepest(found: Registration, smooth: Array, core: Mask, noise: float) -> tuple[float, float]:
    """Return the largest depth of a scar and its standard uncertainty, in m.

    A paraboloid is fitted to the bottom, as smoothing would flatten it; a bottom that is flat
    within noise has its mean. The uncertainty combines the coefficients, the registration, and the
    smoothed residuals of the fit beyond noise, such as the relief of a worn surface.
    """
    worn = np.where(core, smooth, -np.inf)
    areas, _ = ndimage.label(worn >= BOTTOM * np.max(worn), np.ones((3, 3)))
    bottom = areas == areas[np.unravel_index(int(np.argmax(worn)), core.shape)]
    inside, known = ndimage.binary_fill_holes(bottom), bottom & np.isfinite(found.depth)
    if not known.any():
        raise CaseError(
            "no pixel of the bottom of the scar was measured; measure again, with fewer missing "
            "pixels"
        )
    places, inside = (np.argwhere(each).astype(float) for each in (known, inside))
    centre, scale = np.mean(places, axis=0), float(np.max(np.ptp(places, axis=0)))
    terms, everywhere = (quadratic((each - centre).T, scale)[0] for each in (places, inside))
    coefficients = np.linalg.lstsq(terms.T, found.depth[known])[0]
    form, whole = (np.sum(coefficients[:, None] * each, axis=0) for each in (terms, everywhere))
    # The deepest may lie in a hole.
    top = int(np.argmax(whole))
    off = places - inside[top]
    residuals = np.full(bottom.shape, np.nan)
    residuals[known] = found.depth[known] - form
    rough = float(np.std(smoothed(residuals)[known]))
    beside = found.uncertainty[known][int(np.argmin(np.sum(off**2, axis=1)))]
    of_registration = max(float(beside**2 - found.noise**2), 0.0)
    of_noise = found.variance_inflation * found.noise**2
    of_rest = of_registration + max(rough**2 - noise**2, 0.0)
    mean, spread = float(np.mean(form)), float(np.var(form))
    # The largest of what noise makes of a flat bottom lies above it.
    if spread < LEVEL * of_noise / len(places):
        # The depth of a curved one lies √3 standard deviations above the mean.
        of_form = of_noise / len(places) + 3 * spread
        return mean, math.sqrt(of_form + of_rest)
    of_coefficients = min(_leverage(off, scale) * of_noise, found.noise**2)
    return float(whole[top]), math.sqrt(of_coefficients + of_rest)


def _leverage(places: Array, scale: float) -> float:
    """Return the variance at the origin of a paraboloid fitted at places (n, 2), by unit noise."""
    terms = quadratic(places.T, scale)[0]
    # The constant alone counts there.
    return float(np.linalg.pinv(np.einsum("kn,ln->kl", terms, terms), hermitian=True)[0, 0])


def sum_uncertainty(found: Registration, scar: Mask) -> float:
    """Return the standard uncertainty of the sum of depths in a scar, in m.

    A missing pixel has the standard deviation of depths from smoothed ones at the nearest known
    pixel, which includes curvature and noise; all pixels of a hole err together.
    """
    missing = scar & np.isnan(found.depth)
    sums = np.sum(found.slopes[:, scar], axis=1)
    of_fit = float(np.einsum("k,kl,l->", sums, found.covariance, sums))
    of_noise = found.variance_inflation * found.noise**2 * np.count_nonzero(scar & ~missing)
    spread = np.sqrt(smoothed((found.depth - smoothed(found.depth, AROUND)) ** 2, AROUND))
    sigma = nearest_filled(np.where(np.isfinite(found.depth), spread, np.nan))
    holes, count = ndimage.label(missing)
    sizes = np.bincount(holes.ravel(), minlength=count + 1)[holes]
    of_holes = np.sum((sigma**2 * sizes)[missing])
    return math.sqrt(max(of_fit, 0.0) + of_noise + float(of_holes))
