"""Take form off a height map, fill its holes, turn it round."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import griddata
from scipy.ndimage import binary_dilation
from tribo import Array, CaseError

from tribo_topography.config import MeasuredFile

_TERMS = {"none": 0, "mean": 1, "tilt": 3, "curvature": 6}


def detrended(heights: Array, form: str) -> Array:
    """Return `heights` less a polynomial fitted to the pixels that are there.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny)
        NaN where missing.
    form : {"none", "mean", "tilt", "curvature"}
        1; x and y; x², xy and y², each with those before.
    """
    terms = _TERMS[form]
    if terms == 0:
        return heights
    # On [-1, 1], where the terms are well conditioned.
    x = np.linspace(-1, 1, heights.shape[0])[:, None] * np.ones_like(heights)
    y = np.linspace(-1, 1, heights.shape[1])[None, :] * np.ones_like(heights)
    basis = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y][:terms])
    there = np.isfinite(heights)
    known = basis[:, there]
    factors = np.linalg.lstsq(known @ known.T, known @ heights[there], rcond=None)[0]
    return np.asarray(heights - np.tensordot(factors, basis, axes=1))


def filled(heights: Array, config: MeasuredFile) -> Array:
    """Return `heights` without holes.

    Raises
    ------
    CaseError
        If pixels are missing and may not, or too many are.
    """
    missing = np.isnan(heights)
    part = float(np.mean(missing))
    if part == 0:
        return heights
    if config.fill == "error":
        raise CaseError(
            f"{config.path} lacks {np.count_nonzero(missing)} of {missing.size} pixels "
            f"({100 * part:.2g} %); set fill = 'interpolate' to take them from their neighbours"
        )
    if part > config.max_missing:
        raise CaseError(
            f"{config.path} lacks {100 * part:.3g} % of its pixels, more than max_missing = "
            f"{config.max_missing:g}"
        )
    rim = binary_dilation(missing, iterations=2) & ~missing
    known, wanted = np.argwhere(rim), np.argwhere(missing)
    values = griddata(known, heights[rim], wanted, method="nearest")
    if len(known) >= 4 and np.ptp(known, axis=0).min() > 0:
        inside = griddata(known, heights[rim], wanted, method="linear")
        # Outside the hull of what is known, at the map's edge, the nearest has to do.
        values = np.where(np.isfinite(inside), inside, values)
    whole = heights.copy()
    whole[missing] = values
    return whole


def turned(
    heights: Array, size: tuple[float, float], config: MeasuredFile
) -> tuple[Array, tuple[float, float]]:
    """Return the map and its size along the x and y of the contact frame."""
    if config.mirror:
        heights = heights[:, ::-1]
    # Arrays are (x, y), so that axis 0 turns towards axis 1.
    heights = np.rot90(heights, config.rotate // 90)
    return heights, size if config.rotate % 180 == 0 else (size[1], size[0])
