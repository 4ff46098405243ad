"""Motion round a closed path in the plane, as on a tester whose pin is led along x and y."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, field_validator, model_validator

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.number_tables import read_pairs
from tribo.core.rounding import ROUND_OFF
from tribo.core.units import Quantity
from tribo.motion.closed_track import Steady
from tribo.motion.cycle import Position
from tribo.motion.exposure import Exposure, Passing, one_swept_body

SAMPLES = 2**13
"""Points of a path from a formula: the length of a circle is exact to 1e-7."""
SQUARE = ((0, -1), (1, -1), (1, 1), (-1, 1), (-1, -1), (0, -1))

Point = tuple[Annotated[float, Quantity("m")], Annotated[float, Quantity("m")]]


class Planar(Steady):
    """Speed v round a closed path in the plane, resolved at positions; no body turns.

    The path is a circle, a square or an eight, each stretched to its extents along x and y, or the
    points of a file. It is divided into stretches of like length, a path of few points side by
    side; the contact is solved in the middle of each, and the bodies wear at their place there. The
    sliding direction is the direction of the path there (the fields `heading_x` and `heading_y`).

    A body has the columns of the window, which are counted round: the window must be at least as
    broad as the contact and the path together. Valid for gross sliding without spin.

    Examples
    --------
    >>> circle = {"path": "circle", "extent": ("1 mm", "1 mm")}
    >>> motion = tribo.Planar(**circle, speed="20 mm/s", revolutions=1000)
    >>> round(motion.end_time, 1)  # s for 1000 π mm
    157.1
    """

    examples = (
        {"path": "circle", "extent": ["1 mm", "1 mm"], "speed": "20 mm/s", "revolutions": 9},
    )
    type = "planar"
    path: Literal["circle", "square", "eight"] | tuple[Point, ...]
    """``"circle"``, ``"square"`` or ``"eight"``, with `extent`; or a file of two columns, x and y
    in m, or a list of such points, which a straight line closes."""
    extent: (
        tuple[Annotated[float, Quantity("m", above=0)], Annotated[float, Quantity("m", above=0)]]
        | None
    ) = None
    """Extents of a path from a formula along x and along y; for a circle, its diameter twice."""
    positions: Annotated[int, Field(ge=8)] | Literal["cells"] = 48
    """Least number of positions in which the contact is solved; ``"cells"`` is one for each cell's
    length of the path."""

    @field_validator("path", mode="before")
    @classmethod
    def _from_file(cls, value: Any) -> Any:
        if isinstance(value, str) and value not in ("circle", "square", "eight"):
            value = Path(value)
        return read_pairs(value, "x and y in m").tolist() if isinstance(value, Path) else value

    @model_validator(mode="after")
    def _one_path(self) -> Self:
        if isinstance(self.path, str) != (self.extent is not None):
            raise ValueError("give extent with a path from a formula, and with no other")
        if self.extent is None and not self.track_extent > 0:
            raise ValueError("the path never leaves its first point; give more than one point")
        return self

    @cached_property
    def _points(self) -> Array:
        """The points of the closed path, shape (points, 2), in m."""
        if not isinstance(self.path, str):
            return np.array([*self.path, self.path[0]])
        turn = np.linspace(0.0, 2 * math.pi, SAMPLES + 1)
        shapes = {
            "circle": np.array([np.sin(turn), -np.cos(turn)]).T,
            "square": np.array(SQUARE),
            "eight": np.array([np.sin(turn), np.sin(2 * turn)]).T,
        }
        return np.asarray(0.5 * np.array(self.extent) * shapes[self.path])

    @cached_property
    def _slid(self) -> Array:
        """Distance slid up to each point, in m."""
        steps = np.hypot(*np.diff(self._points, axis=0).T)
        return np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def track_extent(self) -> float:
        """Length of the path, in m."""
        return float(self._slid[-1])

    def cycle(self, grid: Grid) -> Sequence[Position]:
        """Return a position for each stretch, with the direction of the path there."""
        ends = self._ends(grid)
        chords, middles = np.diff(self._at(ends), axis=0), self._middles(ends)
        # A path that turns back within a stretch leaves no chord.
        back = np.hypot(*chords.T) < 1e-6 * np.diff(ends)
        chords[back] = (middles - self._at(ends[:-1]))[back]
        ways = chords / np.hypot(*chords.T)[:, None]
        shares = np.diff(ends) / ends[-1]
        return [
            Position(float(share), heading=(float(x), float(y)))
            for share, (x, y) in zip(shares, ways, strict=True)
        ]

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return the rows and columns of the swept body at each position."""
        cells = np.round(self._middles(self._ends(grid)) / grid.spacing).astype(int)
        # Moved so that the body is in its own middle in the middle position.
        along, across = (cells[len(cells) // 2] - cells).T
        beyond = 0 if grid.period is not None else int(np.max(np.abs(along)))
        starts = (along + beyond).tolist()
        passing = Passing(grid, starts, self.track_extent, across.tolist())
        return one_swept_body(grid, bodies, self.swept, passing)

    def _at(self, slid: Array) -> Array:
        """Return the point of the path at a sliding distance (m), shape (…, 2), in m."""
        return np.stack([np.interp(slid, self._slid, part) for part in self._points.T], axis=-1)

    def _middles(self, ends: Array) -> Array:
        """Return the middle of each stretch, shape (stretches, 2), in m."""
        return self._at(0.5 * (ends[:-1] + ends[1:]))

    def _ends(self, grid: Grid) -> Array:
        """Return the ends of the stretches along the path, in m, from 0 on."""
        total, given = self.track_extent, self.positions
        wanted = math.ceil(total / min(grid.spacing)) if isinstance(given, str) else given
        sides = self._slid if len(self._slid) <= wanted else np.array([0.0, total])
        parts = []
        for begin, end in pairwise(sides.tolist()):
            # An odd number, so that one lies in the middle.
            count = math.ceil(wanted * (end - begin) / total - ROUND_OFF) // 2 * 2 + 1
            parts.append(np.linspace(begin, end, count + 1)[:-1])
        return np.concatenate([*parts, [total]])
