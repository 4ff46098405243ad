"""The part of the window that a contact occupies."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tribo.core.arrays import Array, Mask, Region, bounds

_SMALLEST = 8
"""Cells along the edge of a box: a transform of half as many takes three quarters of the time."""


@dataclass(frozen=True)
class Box:
    """A rectangle of cells: its first cell, its cells, and the window's cells, by axis.

    Examples
    --------
    >>> contact = tribo.Box(first=(1, 2), shape=(1, 3), window=(3, 6))
    >>> contact.embed(np.array([[7.0, 8.0, 7.0]]))
    array([[0., 0., 0., 0., 0., 0.],
           [0., 0., 7., 8., 7., 0.],
           [0., 0., 0., 0., 0., 0.]])
    """

    first: tuple[int, int]
    shape: tuple[int, int]
    window: tuple[int, int]

    @staticmethod
    def of(region: Region, window: tuple[int, int]) -> Box:
        """Return the box that is a region of a window."""
        rows, columns = region
        first, end = (rows.start, columns.start), (rows.stop, columns.stop)
        return Box(first, (end[0] - first[0], end[1] - first[1]), window)

    @cached_property
    def slices(self) -> tuple[slice, slice]:
        """Where the box lies in an array on the window."""
        (i, j), (nx, ny) = self.first, self.shape
        return slice(i, i + nx), slice(j, j + ny)

    @cached_property
    def is_window(self) -> bool:
        """Whether the box leaves no cell of the window out."""
        return self.shape == self.window

    def embed(self, values: Array) -> Array:
        """Return `values`, on the box, shape (…, nx, ny), in a window of zeros."""
        full = np.zeros((*values.shape[:-2], *self.window))
        full[(..., *self.slices)] = values
        return full


def whole(window: tuple[int, int]) -> Box:
    """Return the box that is the whole window of `window` cells."""
    return Box((0, 0), window, window)


def around(cells: Mask, margin: int) -> Box:
    """Return a box of few distinct sizes around the set cells of a window; as `around_region`."""
    return around_region(bounds(cells), (cells.shape[0], cells.shape[1]), margin)


def around_region(region: Region, window: tuple[int, int], margin: int) -> Box:
    """Return a box of few distinct sizes around a region of a window.

    Around an empty region it is the window. It leaves `margin` cells on each side at least. Its
    edges are {4, 5, 6, 7}·2^k cells long, so that transforms are fast and kernels are used again,
    or the window's.
    """
    rows, columns = region
    if rows.start == rows.stop:
        return whole(window)
    edges = []
    for lines, count in zip((rows, columns), window, strict=True):
        low, high = lines.start - margin, lines.stop + margin
        unit = _SMALLEST // 4
        while 7 * unit < high - low:
            unit *= 2
        length = min(max(_SMALLEST, unit * -(-(high - low) // unit)), count)
        first = low - (length - (high - low)) // 2
        edges.append((min(max(first, 0), count - length), length))
    (i, nx), (j, ny) = edges
    return Box((i, j), (nx, ny), window)
