"""Positions along a stroke, and their shares of the path."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.core.rounding import ROUND_OFF, SAME
from tribo.motion.cycle import Position

EVEN = 1e-3
"""Relative difference up to which speeds near a position count as one: a law linear in the speed is
off by nothing, one of its square by 1e-6."""


@dataclass(frozen=True)
class Stroke:
    """Positions along a stroke, at whole cells and alike to both sides of its middle.

    Integrals over the stroke use straight lines between the positions: exact to second order in
    their spacing, and exact in total for an evenly spent path. A stroke at least as long as the
    period of the contact has its positions over one period, which the path goes round.

    Parameters
    ----------
    length : float
        The stroke S, in m.
    dx : float
        Length of a cell, in m.
    count : int or str, optional
        Number of positions, odd; ``"cells"`` for every cell.
    period : int or None, optional
        Cells after which all repeats; None where nothing does.
    """

    length: float
    dx: float
    count: int | str = "cells"
    period: int | None = None

    @property
    def cells(self) -> Array:
        """Offsets from mid-stroke, shape (positions,), in cells, over the stroke or a period."""
        half = self._half
        sides = half if isinstance(self.count, str) else min(half, self.count // 2)
        if self.goes_round is None:
            right = np.round(np.linspace(0, half, sides + 1))
        elif 2 * sides + 1 < self.goes_round:
            right = np.round(np.arange(sides + 1) * (self.goes_round / (2 * sides + 1)))
        else:
            return np.arange(self.goes_round, dtype=float) - self.goes_round // 2
        return np.asarray(np.concatenate([-right[:0:-1], right]))

    @property
    def starts(self) -> list[int]:
        """Row at which the window begins on the body that passes, at each position."""
        # The window's place on the body moves against the body itself.
        beyond = 0 if self.period is not None else self._half
        return [int(beyond - cell) for cell in self.cells]

    @property
    def goes_round(self) -> int | None:
        """The period that the stroke is as long as or longer, in cells; None if it is shorter."""
        return self.period if self.period is not None and 2 * self._half >= self.period else None

    @property
    def ends(self) -> Array:
        """Where the path turns round, from mid-stroke, shape (2,), in m."""
        half = min(0.5 * self.length, self._half * self.dx)
        return np.array([-half, half])

    @property
    def shares(self) -> Array:
        """Part of an even path at each position, shape (positions,)."""
        return self._near(self.ends) / np.ptp(self.ends)

    def passed(self, times: Array, places: Array) -> list[Position]:
        """Return the positions of a path over the stroke, each with two speeds near it.

        Half of the path near a position is slid at each, which both its mean speed over the path
        and its time fulfil: what goes as the speed, or with time, is exact. A rest falls to the
        positions beside it, as the path there does.

        Parameters
        ----------
        times : ndarray, shape (samples,)
            In increasing order, in s.
        places : ndarray, shape (samples,)
            Where the path is then, from mid-stroke, in m.
        """
        # A stroke that counts as whole cells may go a little beyond the last one.
        places = places * (np.ptp(self.ends) / self.length)
        steps = np.abs(np.diff(places))
        taken, pace = np.diff(times), np.zeros_like(steps)
        np.divide(taken, steps, out=pace, where=steps > 0)
        lengths = self._near(places)
        mean = self._near(places, steps / taken) / lengths
        steady = lengths / self._near(places, pace)
        apart = np.sqrt(np.maximum(mean**2 - mean * steady, 0.0))
        shares = lengths / np.sum(lengths)
        rests = self._resting(places[:-1], np.where(steps > 0, 0.0, taken)) / lengths
        speeds = [
            [(float(v - d), 0.5), (float(v + d), 0.5)] if d > EVEN * v else [(float(even), 1.0)]
            for v, d, even in zip(mean, apart, steady, strict=True)
        ]
        return [
            Position(float(share), each, rest=float(rest))
            for share, each, rest in zip(shares, speeds, rests, strict=True)
        ]

    @property
    def _half(self) -> int:
        """Cells from mid-stroke to an end."""
        given = 0.5 * self.length / self.dx
        is_whole = abs(given - round(given)) <= SAME * given
        return max(1, round(given) if is_whole else int(np.ceil(given)))

    def _near(self, path: Array, weights: Array | float = 1.0) -> Array:
        """Return the length of the path that falls to each position, shape (positions,)."""
        nodes = self.cells * self.dx
        if self.goes_round is None:
            return near(nodes, path, weights)
        # The positions repeat with each period, up to one beyond the path.
        around = self.goes_round * self.dx
        periods = np.arange(np.floor(path.min() / around) - 1, np.ceil(path.max() / around) + 2)
        all_nodes = (around * periods[:, None] + nodes).ravel()
        lengths = near(all_nodes, path, weights).reshape(len(periods), -1)
        return np.asarray(lengths.sum(axis=0))

    def _resting(self, places: Array, times: Array) -> Array:
        """Return the part of times (s) at places (m) that falls to each position, (positions,)."""
        nodes = self.cells * self.dx
        around = None if self.goes_round is None else self.goes_round * self.dx
        of_node = [np.interp(places, nodes, one, period=around) for one in np.eye(len(nodes))]
        return np.array(of_node) @ times


def odd(count: int | str) -> int | str:
    """Return a number of positions, or the word for it; raise ValueError for an even number."""
    if isinstance(count, int) and count % 2 == 0:
        raise ValueError(
            f"{count} is even; give an odd number, so that one lies in the middle, as {count + 1}, "
            'or "cells" for every cell, however many there are'
        )
    return count


def least_positions(length: float, half_width: float) -> int:
    """Return how many positions along a stroke (m) lie half of a half-width (m) apart, or less."""
    return max(3, 2 * int(np.ceil(length / half_width * (1 - ROUND_OFF))) + 1)


def near(nodes: Array, path: Array, weights: Array | float = 1.0) -> Array:
    """Return the length of a path that belongs to each node, shape (nodes,).

    The weight of a node falls linearly from the node to its neighbours, so that the sum of a field
    at the nodes, times these lengths, is the integral along the path of straight lines between
    them. The nodes increase, and the path lies between the first and the last of them, in m;
    `weights` are the weights of the parts of the path between two samples.
    """
    lengths = np.zeros_like(nodes)
    low, high = np.minimum(path[:-1], path[1:]), np.maximum(path[:-1], path[1:])
    for node in range(len(nodes) - 1):
        gap = nodes[node + 1] - nodes[node]
        begin, end = np.clip(low, *nodes[node : node + 2]), np.clip(high, *nodes[node : node + 2])
        passed = weights * (end - begin)
        middle = 0.5 * (begin + end)
        lengths[node] += np.sum(passed * (nodes[node + 1] - middle)) / gap
        lengths[node + 1] += np.sum(passed * (middle - nodes[node])) / gap
    return lengths
