"""The normal load over time, at each position of a cycle."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from math import inf

ByPosition = tuple[float, ...]
"""Loads at the positions of a cycle, in N."""


@dataclass(frozen=True)
class Piece:
    """A stretch of time over which the load goes in a straight line.

    Parameters
    ----------
    end : float
        When it ends, in s.
    first, last : float
        Load at its beginning and end, in N.
    """

    end: float
    first: float
    last: float


@dataclass(frozen=True)
class Loads:
    """The normal load over time, at each position of a cycle.

    Where one piece ends at another load than the next begins with, the load jumps.

    Parameters
    ----------
    pieces : tuple of Piece
        One after the other, from t = 0 on.
    shares : tuple of float
        Load at each position, as a multiple of that of the piece.
    """

    pieces: tuple[Piece, ...]
    shares: tuple[float, ...]

    @classmethod
    def constant(cls, load: float, positions: int) -> Loads:
        """Return one load (N) for all time and all positions."""
        return cls((Piece(inf, load, load),), (1.0,) * positions)

    @property
    def edges(self) -> tuple[float, ...]:
        """Times at which a piece ends and another begins, in s."""
        return tuple(piece.end for piece in self.pieces[:-1])

    @property
    def largest(self) -> float:
        """The largest load at any time and position, in N."""
        return max(self.shares) * max(max(piece.first, piece.last) for piece in self.pieces)

    def before(self, time: float) -> ByPosition:
        """Return the loads as `time` (s) is reached: at a jump, those before it."""
        return self._at(time, bisect_left(self.pieces, time, key=lambda piece: piece.end))

    def after(self, time: float) -> ByPosition:
        """Return the loads from `time` (s) on: at a jump, those after it."""
        return self._at(time, bisect_right(self.pieces, time, key=lambda piece: piece.end))

    def mean(self, begin: float, end: float) -> ByPosition:
        """Return the mean loads between two times (s) of one piece."""
        pairs = zip(self.after(begin), self.before(end), strict=True)
        return tuple(0.5 * (first + last) for first, last in pairs)

    def _at(self, time: float, index: int) -> ByPosition:
        index = min(index, len(self.pieces) - 1)
        piece = self.pieces[index]
        load = piece.last
        if time < piece.end and piece.first != piece.last:
            start = self.pieces[index - 1].end if index else 0.0
            part = (time - start) / (piece.end - start)
            load = piece.first + part * (piece.last - piece.first)
        return tuple(share * load for share in self.shares)
