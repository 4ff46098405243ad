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
    # An even period counts the furthest offsets by half, which takes the cut-off to 3e-8.
    kernel = wrapped_kernel((256, 256), (spacing[0] / unit, spacing[1] / unit))
    signs = np.where(np.arange(256) % 2 == 0, 1.0, -1.0)
    return unit * float(np.sum(signs[:, None] * signs * kernel))


def _corner(x: Array, y: Array) -> Array:
    return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
