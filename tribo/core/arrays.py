"""Array types, regions of an array, and read-only views."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""Numbers, as 64-bit floats."""
Mask = NDArray[np.bool_]
"""Truth values: which cells belong to a set."""
Region = tuple[slice, slice]
"""Rows and columns of an array."""
Cell = tuple[int, int]
"""Row and column of a cell."""


def readonly(array: Array) -> Array:
    """Return a view of `array` that cannot be written to."""
    view = array.view()
    view.flags.writeable = False
    return view


def view(value: Any) -> Any:
    """Return `value` with read-only arrays, and containers of its own, however deep."""
    if isinstance(value, np.ndarray):
        return readonly(value)
    if isinstance(value, Mapping):
        return {name: view(each) for name, each in value.items()}
    if isinstance(value, tuple | list):
        return type(value)(map(view, value))
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{f.name: view(getattr(value, f.name)) for f in fields(value)})
    return value


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


def region(field: Array, first: Cell, count: tuple[int, ...]) -> Any:
    """Return the index of `count` rows and columns of a periodic field, from the cell `first` on.

    The first row of the field follows its last, and so do its columns.
    """
    (rows, columns), (along, across) = field.shape, count
    row, column = first[0] % rows, first[1] % columns
    if row + along <= rows and column + across <= columns:
        return slice(row, row + along), slice(column, column + across)
    return np.ix_(np.arange(row, row + along) % rows, np.arange(column, column + across) % columns)


def middle_rows(field: Array, count: int) -> Array:
    """Return the middle `count` rows of a field on a body's own surface; all, if it has fewer."""
    first = max(0, (field.shape[0] - count) // 2)
    return field[first : first + count]
