"""Love's (1929) surface displacement under uniform pressure on a rectangle."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from tribo.core.arrays import Array


def wrapped_kernel(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Return Love's displacement at cell offsets, in the order a circular convolution needs.

    Entry (i, j) belongs to the offset (min(i, nx − i), min(j, ny − j)) in cells, of a (padded)
    transform of `shape` (nx, ny); it is for p = 1 and E* = 1, in m.

    References
    ----------
    A. E. H. Love, "The stress produced in a semi-infinite solid by pressure on
    part of the boundary", Phil. Trans. R. Soc. A 228 (1929) 377-420.
    """
    halves = [n // 2 + 1 for n in shape]
    # Neighbouring cells share corners, and no corner has X = 0 or Y = 0.
    x = (np.arange(halves[0] + 1, dtype=np.float64) - 0.5) * spacing[0]
    y = (np.arange(halves[1] + 1, dtype=np.float64) - 0.5) * spacing[1]
    quarter = np.diff(np.diff(_corner(x[:, None], y[None, :]), axis=0), axis=1) / np.pi
    i, j = (np.minimum(np.arange(n), n - np.arange(n)) for n in shape)
    return np.asarray(quarter[np.ix_(i, j)])


@lru_cache(maxsize=64)
def nyquist_compliance(spacing: tuple[float, float]) -> float:
    """Smallest eigenvalue of Love's kernel on an unbounded grid, for E* = 1.

    It belongs to the chequerboard pressure (−1)^(i + j).

    Parameters
    ----------
    spacing : tuple of float
        Edge lengths of a cell along x and y, in m.

    Returns
    -------
    float
        Displacement amplitude per pressure amplitude for E* = 1, in m.

    Examples
    --------
    >>> round(tribo.nyquist_compliance((1e-6, 1e-6)) * 1e6, 5)  # µm on square cells of 1 µm
    0.58069
    """
    unit = min(spacing)
    reach = 64
    scaled = spacing[0] / unit, spacing[1] / unit
    kernel = wrapped_kernel((2 * reach, 2 * reach), scaled)[: reach + 1, : reach + 1]
    weights = _alternating_weights(reach)
    return unit * float(np.sum(weights[:, None] * weights[None, :] * kernel))


def _alternating_weights(reach: int) -> Array:
    # Σ over offsets −reach…reach of (−1)^i, ended by the binomial averaging of
    # partial sums (Euler's transform), which makes the cut-off error negligible.
    order = 24
    tail = np.ones(reach + 1)
    binomial = np.ones(1)
    for _ in range(order):
        binomial = np.convolve(binomial, (0.5, 0.5))
    tail[reach - order :] = np.cumsum(binomial[::-1])[::-1]
    signs = np.where(np.arange(reach + 1) % 2 == 0, 1.0, -1.0)
    weights = 2.0 * signs * tail
    weights[0] = 1.0
    return weights


def _corner(x: Array, y: Array) -> Array:
    return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
