"""Roughness of a height map, after ISO 25178-2 and ISO 21920-2.

A map has shape (nx, ny), x along the sliding direction, heights in m; NaN marks a cell that was
not measured, or is masked. `without_form` comes first: the parameters take heights as they are.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from tribo import Array
from tribo.kernel_api import without_form

FINE_FORM = 6
"""Order of the polynomial that removes a ball or cylinder in a contact's window."""
ROUGH = 1e-5
"""Part of the heights' range above which the residual of `FINE_FORM` is roughness: a ball leaves
2e-6 of it in a window of 0.6 radii."""


class Roughness(NamedTuple):
    """Roughness parameters of a surface; NaN where it has too few cells, or no relief at all.

    Areal, about the mean plane: arithmetical mean height Sa, root mean square height Sq, maximum
    height Sz, skewness Ssk, kurtosis Sku. Of the profiles along and across the sliding direction,
    each about its own mean line and then averaged: arithmetical mean Ra and root mean square Rq.

    Examples
    --------
    >>> import numpy as np
    >>> from tribo_topography.roughness import roughness
    >>> waves = 1e-6 * np.sin(np.arange(64) * np.pi / 4)[:, None] * np.ones(64)
    >>> found = roughness(waves)
    >>> f"Sq {1e6 * found.Sq_m:.2f} µm, Rq across {1e6 * found.Rq_across_m:.2f} µm"
    'Sq 0.70 µm, Rq across 0.00 µm'
    """

    Sa_m: float
    Sq_m: float
    Sz_m: float
    Ssk: float
    Sku: float
    Ra_along_m: float
    Rq_along_m: float
    Ra_across_m: float
    Rq_across_m: float


def roughness(height: Array, order: int = 2) -> Roughness:
    """Return the parameters of a height map, its form of an `order` removed by `without_form`.

    References
    ----------
    ISO 25178-2:2021, 4.2 (areal); ISO 21920-2:2021 (profiles).
    """
    return parameters(without_form(height, order))


def parameters(relief: Array) -> Roughness:
    """Return the parameters of heights as they are."""
    return Roughness(
        *areal_parameters(relief), *profile_parameters(relief, 0), *profile_parameters(relief, 1)
    )


def areal_parameters(height: Array) -> tuple[float, float, float, float, float]:
    """Return Sa, Sq and Sz in m, Ssk and Sku, about the mean (ISO 25178-2).

    Ssk and Sku are NaN of a plane, and all are where no height is known.
    """
    known = height[np.isfinite(height)]
    if not known.size:
        return (np.nan,) * 5
    z = known - np.mean(known)
    square = float(np.mean(z**2))
    sq = square**0.5
    skewness, kurtosis = np.nan, np.nan
    if sq > 0:
        skewness, kurtosis = float(np.mean((z / sq) ** 3)), float(np.mean((z / sq) ** 4))
    return float(np.mean(np.abs(z))), sq, float(np.ptp(z)), skewness, kurtosis


def profile_parameters(height: Array, axis: int) -> tuple[float, float]:
    """Return Ra and Rq of the profiles along an axis, each the mean over the lines (ISO 21920-2).

    Heights count from the mean of their line. Lines with less than half the cells of the longest,
    as at the rim of a scar, are left out. NaN where no height is known.
    """
    lines = height if axis == 1 else height.T
    known = np.isfinite(lines)
    count = np.count_nonzero(known, axis=1)
    longest = int(np.max(count, initial=0))
    if not longest:
        return np.nan, np.nan
    lines = lines[count >= 0.5 * longest]
    z = lines - np.nanmean(lines, axis=1, keepdims=True)
    ra, rq = np.nanmean(np.abs(z), axis=1), np.sqrt(np.nanmean(z**2, axis=1))
    return float(np.mean(ra)), float(np.mean(rq))


def material_ratio(height: Array) -> tuple[Array, Array]:
    """Return the material ratio (Abbott-Firestone) curve of a height map (ISO 25178-2).

    Returns
    -------
    ratio : ndarray, shape (cells,)
        Part of the area that is at least so high, rising from 0 to 1; each cell counts from its
        middle.
    height : ndarray, shape (cells,)
        In m, falling.
    """
    known = height[np.isfinite(height)]
    ratio = (np.arange(known.size) + 0.5) / max(known.size, 1)
    return ratio, np.sort(known)[::-1]


def is_rough(height: Array) -> bool:
    """Whether a height map is more than a smooth form, such as a ball, a cylinder or a flat."""
    span = float(np.nanmax(height) - np.nanmin(height))
    # The fit to a flat would take more memory than any other part of its run.
    return span > 0 and areal_parameters(without_form(height, FINE_FORM))[1] > ROUGH * span
