"""Array types, regions of an array, and read-only views."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""Numbers, as 64-bit floats."""
Mask = NDArray[np.bool_]
"""Truth values: which cells belong to a set."""
Region = tuple[slice, slice]
"""Rows and columns of an array."""


def readonly(array: Array) -> Array:
    """Return a view of `array` that cannot be written to."""
    view = array.view()
    view.flags.writeable = False
    return view


def bounds(cells: Mask) -> Region:
    """Return the smallest region with all cells of `cells` that are set; empty if none is."""
    rows = np.flatnonzero(cells.any(axis=1))
    if not rows.size:
        return slice(0, 0), slice(0, 0)
    along = slice(int(rows[0]), int(rows[-1]) + 1)
    columns = np.flatnonzero(cells[along].any(axis=0))
    return along, slice(int(columns[0]), int(columns[-1]) + 1)


def union(first: Region, second: Region) -> Region:
    """Return the smallest region with all of two others."""
    (a, b), (c, d) = first, second
    return (
        slice(min(a.start, c.start), max(a.stop, c.stop)),
        slice(min(b.start, d.start), max(b.stop, d.stop)),
    )


def rows_from(field: Array, first: int, count: int) -> Array:
    """Return `count` rows of a field, of which row `first` is the first.

    After its last row a field goes on with its first.
    """
    first %= len(field)
    beyond = first + count - len(field)
    if beyond <= 0:
        return field[first : first + count]
    return np.concatenate([field[first:], field[:beyond]])


def add_from(field: Array, part: Array, first: int) -> None:
    """Add `part` to a field in place, from row `first` on, as `rows_from` counts them."""
    first %= len(field)
    until = len(field) - first
    field[first : first + len(part)] += part[:until]
    if until < len(part):
        field[: len(part) - until] += part[until:]


def middle_rows(field: Array, count: int) -> Array:
    """Return the middle `count` rows of a field on a body's own surface; all, if it has fewer."""
    first = max(0, (field.shape[0] - count) // 2)
    return field[first : first + count]
