"""Sample a height map on a grid of another spacing."""

from __future__ import annotations

from math import ceil

import numpy as np
from scipy.interpolate import RectBivariateSpline
from tribo import Array, CaseError, Grid

# A cubic spline forgets a pixel by a factor of 0.27 per pixel of distance.
_MARGIN = 16
# Sizes in files may be in single precision.
_ROUND_OFF = 1e-6


def sampled(
    heights: Array, size: tuple[float, float], grid: Grid, centre: tuple[float, float]
) -> Array:
    """Return the heights at the cells of a grid.

    A cubic spline through the pixels; where a cell is larger than a pixel, its
    mean over the cell.

    Parameters
    ----------
    heights : ndarray
        Without holes, in m; at the centres of pixels of size / shape.
    size : tuple of float
        Edge lengths of the map, in m.
    grid : Grid
        The window.
    centre : tuple of float
        Where in the map, from its middle, the window's centre lies, in m.

    Raises
    ------
    CaseError
        If the window reaches beyond the map, or has fewer than 4 pixels
        across.
    """
    lines, parts, fine = [], [], []
    for axis in (0, 1):
        count, edge, window = heights.shape[axis], size[axis], grid.size[axis]
        if abs(centre[axis]) + 0.5 * window > 0.5 * edge * (1 + _ROUND_OFF):
            raise CaseError(_outside(size, grid, centre))
        pixel, cell = edge / count, grid.spacing[axis]
        if window < 4 * pixel:
            raise CaseError(
                f"the window is {1e6 * window:.4g} µm wide and the pixels {1e6 * pixel:.4g} µm; 4 "
                "pixels across are needed at least. Make grid.size larger"
            )
        first = (centre[axis] - 0.5 * window + 0.5 * edge) / pixel
        low = max(0, int(first) - _MARGIN)
        high = min(count, ceil(first + window / pixel) + _MARGIN)
        lines.append((np.arange(low, high) + 0.5) * pixel - 0.5 * edge)
        parts.append(max(1, ceil(cell / pixel - _ROUND_OFF)))
        cells = grid.cells[axis] * parts[axis]
        fine.append((np.arange(cells) - 0.5 * (cells - 1)) * (window / cells) + centre[axis])
        heights = np.moveaxis(np.moveaxis(heights, axis, 0)[low:high], 0, axis)
    # Half a pixel from the edge nothing was measured: the outermost pixel holds there.
    fine = [np.clip(at, line[0], line[-1]) for at, line in zip(fine, lines, strict=True)]
    values = RectBivariateSpline(*lines, heights)(*fine)
    nx, ny = grid.cells
    return np.asarray(values.reshape(nx, parts[0], ny, parts[1]).mean(axis=(1, 3)))


def resolution(
    shape: tuple[int, ...], size: tuple[float, float], grid: Grid
) -> tuple[float, float]:
    """Return the smaller and the larger of the pixels per cell along x and y."""
    ratios = [grid.spacing[axis] * shape[axis] / size[axis] for axis in (0, 1)]
    return min(ratios), max(ratios)


def _outside(size: tuple[float, float], grid: Grid, centre: tuple[float, float]) -> str:
    window, area, at = (
        " × ".join(f"{1e3 * value:.4g}" for value in pair) for pair in (grid.size, size, centre)
    )
    place = f" around {at.replace(' × ', ', ')} mm" if any(centre) else ""
    return (
        f"the window of {window} mm{place} reaches beyond the measured area of {area} mm; make "
        "grid.size smaller" + (", or move centre" if place else "")
    )
