"""The positions that stand for one cycle of a motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array

Speeds = Sequence[tuple[float, float]]
"""Sliding speeds in m/s, each with a share of the path."""


@dataclass(frozen=True)
class Position:
    """One position of a cycle, in which the contact is solved.

    Parameters
    ----------
    share : float
        Part of the path of a cycle that is spent here; the shares of a cycle add up to 1.
    speeds : Speeds or None, optional
        Sliding speeds here, in m/s, each with its share of the path spent here. None: laws and
        effects are asked at the mean speed over each step.
    """

    share: float = 1.0
    speeds: Speeds | None = None


@dataclass(frozen=True)
class Stroke:
    """Positions along a stroke, at whole cells and alike to both sides of its middle.

    Integrals over the stroke are those of straight lines between the positions: exact to second
    order in their spacing, and in all for a path that is spent evenly.

    Parameters
    ----------
    length : float
        The stroke S, in m.
    dx : float
        Length of a cell, in m.
    count : int or None
        Number of positions, odd; every cell if None.
    """

    length: float
    dx: float
    count: int | None = None

    @property
    def cells(self) -> Array:
        """Offsets from mid-stroke, shape (positions,), in whole cells; the ends reach over it."""
        half = max(1, int(np.ceil(0.5 * self.length / self.dx * (1 - 1e-9))))
        sides = half if self.count is None else min(half, self.count // 2)
        right = np.round(np.linspace(0, half, sides + 1))
        return np.asarray(np.concatenate([-right[:0:-1], right]))

    @property
    def starts(self) -> list[int]:
        """Row at which the window begins on the body that passes, at each position."""
        cells = self.cells
        # The window's place on the body moves against the body itself.
        return [int(cells[-1] - cell) for cell in cells]

    @property
    def shares(self) -> Array:
        """Part of the path at each position, shape (positions,)."""
        x = self.cells * self.dx
        shares = np.zeros_like(x)
        # Parts of the stroke between two positions; the outermost may be cut short.
        cut = np.clip(x, -0.5 * self.length, 0.5 * self.length)
        gap = np.diff(x)
        low, high = (cut[:-1] - x[:-1]) / gap, (cut[1:] - x[:-1]) / gap
        towards_next = 0.5 * gap * (high**2 - low**2)
        shares[1:] += towards_next
        shares[:-1] += gap * (high - low) - towards_next
        return shares / self.length

    @property
    def bounds(self) -> Array:
        """Ends of the part of the stroke that each position stands for, (positions + 1,), in m."""
        x = self.cells * self.dx
        ends = np.concatenate([x[:1], 0.5 * (x[1:] + x[:-1]), x[-1:]])
        return np.asarray(np.clip(ends, -0.5 * self.length, 0.5 * self.length))
