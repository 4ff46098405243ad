"""Projection onto the pressures that carry a load within [0, cap], at one position or several."""

from __future__ import annotations

import numpy as np

from tribo.core.arrays import Array, Mask

# A few units of rounding: a sum is no more exact.
_ROUND_OFF = 1e-15
# Good enough for `balance` to correct.
_NEAR = 1e-12
CELLS = (-2, -1)
"""The axes of the cells; a position of a cycle, if there are several, is on the first."""


def over(values: Array) -> Array:
    """Return a value of each position where it multiplies all of its cells."""
    return values[..., None, None]


def project(pressure: Array, total: Array, limit: Array | float, cells: Mask) -> Array:
    """Return the nearest pressure within [0, limit] whose sum is `total`, at each position.

    That is clip(p + μ, 0, limit) with the μ that carries the load. Pressure and limit, in Pa, have
    the shape (nx, ny) or (positions, nx, ny); the limit may be one number, or infinite. Of the
    `cells` that may not change the pressure lies within the bounds, and leaves a load that the
    others can carry.
    """
    moved = np.empty_like(pressure)
    for place in np.ndindex(pressure.shape[:-2]):
        here = cells[place]
        moved[place] = np.where(here, 0.0, pressure[place])
        values = pressure[place][here]
        target = float(total[place] - moved[place].sum())
        most = limit if isinstance(limit, float) else limit[place][here]
        moved[place][here] = np.clip(values + _shift(values, target, most), 0.0, most)
    return balance(moved, total, limit)


def balance(pressure: Array, total: Array, limit: Array | float) -> Array:
    """Remove the round-off in the sum of `pressure`, in place, and return it.

    Only cells strictly within the bounds change, all of a position by the same amount.
    """
    for _ in range(2):
        missing = total - pressure.sum(CELLS)
        if (abs(missing) <= _ROUND_OFF * total).all():
            break
        inner = _inner(pressure, limit)
        count = inner.sum(CELLS)
        if not count.any():
            break
        pressure += inner * over(missing / np.maximum(count, 1))
        pressure.clip(0.0, limit, out=pressure)
    return pressure


def _shift(values: Array, target: float, limit: Array | float) -> float:
    # Σ clip(v + μ) grows piecewise linearly in μ: Newton's method, kept inside
    # a bracket, ends at the root after finitely many steps.
    low = -float(values.max())
    high = float(np.max((limit if np.all(np.isfinite(limit)) else target) - values))
    shift = 0.0 if low < 0.0 < high else 0.5 * (low + high)
    moved = np.empty_like(values)
    for _ in range(200):
        np.clip(values + shift, 0.0, limit, out=moved)
        excess = float(moved.sum()) - target
        if abs(excess) <= _NEAR * target:
            break
        inner = int(np.count_nonzero(_inner(moved, limit)))
        if excess > 0:
            high = shift
        else:
            low = shift
        step = shift - excess / inner if inner else low
        if not low < step < high:
            step = 0.5 * (low + high)
        if step == shift or not low < step < high:
            break
        shift = step
    return shift


def _inner(pressure: Array, limit: Array | float) -> Mask:
    inner: Mask = pressure > 0
    if limits(limit):
        inner &= pressure < limit
    return inner


def limits(limit: Array | float) -> bool:
    """Whether a largest pressure, throughout or of each cell, is one."""
    return not isinstance(limit, float) or limit < np.inf
