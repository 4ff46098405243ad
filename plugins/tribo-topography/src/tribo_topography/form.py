"""Take form off a height map, fill its holes, turn it round."""

from __future__ import annotations

import numpy as np
from tribo import Array, CaseError
from tribo.kernel_api import interpolated, without_form

from tribo_topography.config import MeasuredFile

ORDERS = {"mean": 0, "tilt": 1, "curvature": 2}


def detrended(heights: Array, form: str) -> Array:
    """Return `heights` less the form that `MeasuredFile.detrend` names; NaN where missing."""
    return without_form(heights, ORDERS[form]) if form in ORDERS else heights


def filled(heights: Array, config: MeasuredFile) -> Array:
    """Return `heights` without holes.

    Raises
    ------
    CaseError
        If pixels are missing and may not, or too many are.
    """
    missing = np.isnan(heights)
    part = float(np.mean(missing))
    if part and config.fill == "error":
        raise CaseError(
            f"{config.path} lacks {np.count_nonzero(missing)} of {missing.size} pixels "
            f"({100 * part:.2g} %); set fill = 'interpolate' to take them from their neighbours"
        )
    if part > config.max_missing:
        raise CaseError(
            f"{config.path} lacks {100 * part:.3g} % of its pixels, more than max_missing = "
            f"{config.max_missing:g}"
        )
    return interpolated(heights, missing)


def turned(
    heights: Array, size: tuple[float, float], config: MeasuredFile
) -> tuple[Array, tuple[float, float]]:
    """Return the map and its size along the x and y of the contact frame."""
    if config.mirror:
        heights = heights[:, ::-1]
    # Arrays are (x, y), so that axis 0 turns towards axis 1.
    heights = np.rot90(heights, config.rotate // 90)
    return heights, size if config.rotate % 180 == 0 else (size[1], size[0])
