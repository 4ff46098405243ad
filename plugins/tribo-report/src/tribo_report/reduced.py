"""Fields made smaller for the screen, without hiding that they were."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from tribo import Array

DIGITS = 4
"""Significant digits, as many as a table prints at most."""


@dataclass(frozen=True)
class Blocks:
    """Neighbouring cells taken together along an axis."""

    position: Array
    """Of the cells, in m."""
    size: int
    """Cells in a block; the last may have fewer."""

    @classmethod
    def of(cls, position: Array, most: int) -> Blocks:
        """Return at most so many blocks of cells at `position`."""
        return cls(position, -(-len(position) // most))

    @property
    def centres(self) -> Array:
        """Where the blocks lie, in m."""
        return self.mean(self.position, 0)

    def mean(self, values: Array, axis: int) -> Array:
        """Return the mean of each block along an axis."""
        starts = list(range(0, len(self.position), self.size))
        counts = np.diff([*starts, len(self.position)])
        sums = np.add.reduceat(values, starts, axis=axis)
        return np.asarray(sums / np.expand_dims(counts, tuple(range(1, sums.ndim - axis))))


def block_means(field: Array, blocks: Sequence[Blocks]) -> Array:
    """Return the mean of each block of cells of a field, shape (nx, ny)."""
    return blocks[1].mean(blocks[0].mean(field, 0), 1)


def block_words(blocks: Sequence[Blocks]) -> str:
    """Say how many cells a point shown stands for."""
    sizes = [each.size for each in blocks]
    if max(sizes) == 1:
        return "Every cell of the calculation is shown."
    count = " × ".join(map(str, sizes))
    return (
        f"Each point shown is the mean of {count} cells of the calculation, which lowers narrower "
        "peaks; the largest values named belong to single cells."
    )


def plain(values: Array) -> list[float | None]:
    """Return numbers to four digits of the largest, in the order of memory; None for NaN."""
    flat = np.ravel(values)
    top = float(np.max(np.abs(flat), initial=0.0, where=np.isfinite(flat)))
    # What is far below the largest value is not seen.
    decimals = DIGITS - int(np.ceil(np.log10(top))) if top > 0 else 0
    return [None if np.isnan(v) else float(v) + 0.0 for v in np.round(flat, max(decimals, 0))]


def each_plain(values: Array) -> list[float | None]:
    """Return numbers to four digits of each, as a logarithmic axis and words show them."""
    return [None if np.isnan(v) else float(f"{v:.{DIGITS}g}") for v in np.ravel(values)]
