"""Residuals of the contact conditions, and the checks of load and gap before a solve."""

from __future__ import annotations

import numpy as np

from tribo.contact.projection import CELLS, limits
from tribo.core.arrays import Array
from tribo.core.contact import Residuals
from tribo.core.errors import CaseError, NumericalError
from tribo.core.units import stated


def check_bearable(load: float, area: float, limit: Array | float) -> None:
    """Raise `CaseError` unless `load` is positive, and `area` can bear it.

    `area` is the window's, in m², and `limit` the largest pressure, in Pa, which may be infinite.
    """
    if not load > 1e-100:
        raise CaseError(f"the load is {load:g} N; a contact needs a larger one")
    limit = float(np.mean(limit))
    if load > limit * area:
        raise CaseError(
            f"the load is {load:g} N, but with pressure limited to {stated(limit, 'Pa')} the "
            f"window bears no more than {limit * area:g} N; enlarge grid.size, or lower load.normal"
        )


def check_finite(gap: Array) -> None:
    """Raise `NumericalError` if `gap` has values that are not finite."""
    if not np.isfinite(gap).all():
        raise NumericalError("the gap has values that are not finite; check the surfaces and wear")


def residuals(
    pressure: Array, gap: Array, displacement: Array, approach: float, total: float, limit: float
) -> Residuals:
    """Return the errors of a pressure in the conditions of contact.

    Parameters
    ----------
    pressure, gap, displacement : ndarray, shape (nx, ny)
        In Pa and m; the displacement is A p.
    approach : float
        In the gap's own zero, in m.
    total, limit : float
        Wanted sum of the pressure, and its upper bound, which may be infinite, in Pa.

    Returns
    -------
    Residuals
        All 0 for the exact solution.

    Examples
    --------
    >>> p, gap = np.array([[2e6, 0.0]]), np.array([[0.0, 3e-6]])
    >>> springs = 1e-12 * p
    >>> tribo.residuals(p, gap, springs, approach=2e-6, total=1.6e6, limit=np.inf).force
    0.25
    """
    deformed = gap + displacement - approach
    return judged(pressure, gap, displacement, deformed, np.asarray(total), limit)[0]


def judged(
    pressure: Array,
    gap: Array,
    displacement: Array,
    deformed: Array,
    total: Array,
    limit: Array | float,
) -> list[Residuals]:
    """Judge a pressure against the conditions of contact, at one position or several.

    Pressure, gap, displacement and deformed gap have the shape (nx, ny) or (positions, nx, ny), the
    wanted sum of the pressure a value for each position; the limit may be infinite. The scale of
    the residuals is the largest displacement under pressure, or the range of the gap there if that
    is more; so it is positive for two flats as well. An open gap under pressure at the limit counts
    against complementarity.
    """
    apart = pressure <= 0
    beyond = np.where(apart, np.inf, 0.0)
    lowest, highest = (gap + beyond).min(CELLS), (gap - beyond).max(CELLS)
    scale = np.maximum((displacement - beyond).max(CELLS), highest - lowest)
    # 1 for two periodic flats, which do not displace.
    scale = np.where(scale == 0, 1.0, scale)
    deepest = np.minimum((deformed * apart).min(CELLS), 0.0)
    misses = np.abs(deformed)
    if limits(limit):
        misses[(pressure >= limit) & (deformed < 0)] = 0.0
    open_ = dots(pressure, misses) / (total * scale)
    force = abs(pressure.sum(CELLS) / total - 1.0)
    each = [values.ravel().tolist() for values in (force, open_, 0.0 - deepest / scale)]
    return [Residuals(*errors) for errors in zip(*each, strict=True)]


def dots(a: Array, b: Array) -> Array:
    """Return sum(a * b) at each position, in an order that does not depend on threads."""
    return np.asarray(np.einsum("...ij,...ij->...", a, b))
