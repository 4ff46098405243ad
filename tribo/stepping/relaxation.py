"""What an Euler step counts for where a rate relaxes with its own state; and the derivatives."""

from __future__ import annotations

import numpy as np

from tribo.core.arrays import Array
from tribo.stepping.kept import Field

SMALL = 1e-4
"""Rise below which the derivative of its mean is that of its series."""


def growth(span: Field, slope: Field) -> Field:
    """Return the derivative of `lasting` in the span."""
    return np.exp(slope * np.asarray(span)) if np.any(slope) else 1.0


def relaxed(rise: Field) -> Array:
    """Return the mean of a rate that changes e-fold exp(rise) over a step: (exp(rise) − 1)/rise."""
    rise = np.asarray(rise)
    return np.divide(np.expm1(rise), rise, out=np.ones_like(rise), where=rise != 0)


def lasting(step: Field, slope: Field) -> Field:
    """Return how much a step counts for where the rate follows its own state by this slope."""
    return step * relaxed(step * slope) if np.any(slope) else step


def bending(step: Field, slope: Field) -> Field:
    """Return the derivative of `lasting` in the slope."""
    if not np.any(slope):
        return 0.0
    rise = np.asarray(step * slope)
    small = np.abs(rise) < SMALL
    safe = np.where(small, 1.0, rise)
    return step**2 * np.where(small, 0.5 + rise / 3, (np.exp(safe) - relaxed(safe)) / safe)
