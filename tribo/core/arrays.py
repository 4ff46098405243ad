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
Cell = tuple[int, int]
"""Row and column of a cell."""


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


def part_from(field: Array, first: Cell, count: Cell) -> Array:
    """Return `count` rows and columns of a field, of which those of the cell `first` are the first.

    After its last row a field goes on with its first, and so do its columns.
    """
    for axis in (0, 1):
        start, cells = first[axis] % field.shape[axis], count[axis]
        beyond = start + cells - field.shape[axis]
        parts = [field[(slice(None),) * axis + (slice(start, start + cells),)]]
        if beyond > 0:
            parts.append(field[(slice(None),) * axis + (slice(0, beyond),)])
        field = parts[0] if beyond <= 0 else np.concatenate(parts, axis)
    return field


def add_from(field: Array, part: Array, first: Cell) -> None:
    """Add `part` to a field in place, from the cell `first` on, as `part_from` counts them."""
    pairs = zip(first, part.shape, field.shape, strict=True)
    rows, columns = (_stretches(start % whole, count, whole) for start, count, whole in pairs)
    for row, own_row in rows:
        for column, own_column in columns:
            field[own_row, own_column] += part[row, column]


def _stretches(first: int, count: int, whole: int) -> list[tuple[slice, slice]]:
    """Return where each unbroken stretch of `count` cells lies, in the part and in the whole."""
    until = whole - first
    inside = slice(0, min(count, until)), slice(first, min(first + count, whole))
    return [inside] if count <= until else [inside, (slice(until, count), slice(0, count - until))]


def middle_rows(field: Array, count: int) -> Array:
    """Return the middle `count` rows of a field on a body's own surface; all, if it has fewer."""
    first = max(0, (field.shape[0] - count) // 2)
    return field[first : first + count]
