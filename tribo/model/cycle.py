"""A cycle of the motion: its positions, and how each body's surface meets the window at them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.fields import OF_MOTION
from tribo.core.grid import Grid
from tribo.motion.cycle import Position
from tribo.motion.exposure import Exposure


@dataclass(frozen=True)
class Cycle:
    """The positions of a cycle in order, one of them alone for an average.

    Parameters
    ----------
    grid : Grid
        The window.
    positions : tuple of Position
        The positions in which the contact is solved.
    maps : Mapping of Exposure
        How the surface of each body meets the window, by its name.
    """

    grid: Grid
    positions: tuple[Position, ...]
    maps: Mapping[str, Exposure]

    def __len__(self) -> int:
        return len(self.positions)

    def __iter__(self) -> Iterator[Position]:
        return iter(self.positions)

    def __getitem__(self, position: int) -> Position:
        return self.positions[position]

    @property
    def middle(self) -> int:
        """The position in the middle."""
        return len(self.positions) // 2

    @cached_property
    def swept(self) -> frozenset[str]:
        """Names of the bodies whose points pass through the contact."""
        return frozenset(name for name, each in self.maps.items() if each.swept)

    @cached_property
    def shares_points(self) -> bool:
        """Whether positions wear the same points: none of a body is an average along a track."""
        along = self.grid.cells[0]
        return len(self) > 1 and all(each.rows >= along for each in self.maps.values())

    @cached_property
    def offsets(self) -> Array:
        """The window's first cell on a moving body at each position, shape (positions, 2)."""
        places = ([each.first_cell(i) for i in range(len(self))] for each in self.maps.values())
        cells = np.array(max(places, key=lambda each: np.max(np.ptp(each, axis=0))), dtype=float)
        return readonly(cells)

    @cached_property
    def path(self) -> Array:
        """Distance from the first position to each, in lengths of a cell, shape (positions,)."""
        dx, dy = self.grid.spacing
        along, across = np.diff(self.offsets, axis=0).T
        return readonly(np.concatenate([[0.0], np.cumsum(np.hypot(along, across * (dy / dx)))]))

    @cached_property
    def across(self) -> int:
        """Path of the moving body across, in cells."""
        return int(np.ptp(self.offsets[:, 1]))

    @cached_property
    def apart(self) -> float:
        """Largest distance between neighbouring positions, in m; 0 of an average."""
        return float(np.max(np.diff(self.path), initial=0)) * self.grid.spacing[0]

    @cached_property
    def fields(self) -> list[dict[str, dict[str, Array]]]:
        """The fields of the motion at each position, by field and body, shape (nx, ny).

        They are the coordinates on each body's own surface, in m, and the direction in which the
        other body slides over it. A body averaged along its track has x = 0, and the other body
        slides over it along the track.
        """
        return [self._fields(position) for position in range(len(self))]

    def _fields(self, position: int) -> dict[str, dict[str, Array]]:
        dx, cells = self.grid.spacing[0], self.grid.cells
        found: dict[str, dict[str, Array]] = {name: {} for name in OF_MOTION}
        for name, each in self.maps.items():
            own = dx * (np.arange(float(each.rows))[:, None] - 0.5 * (each.rows - 1))
            breadth = np.broadcast_to(self.grid.y, (each.rows, cells[1]))
            # A body that passes meets the other one the other way.
            way = -1.0 if each.swept else 1.0
            heading = (1.0, 0.0) if each.averaged else self[position].heading
            values = (
                *(each.see(place, position) for place in (own, breadth)),
                *(way * np.asarray(part) for part in heading),
            )
            for of_field, each_value in zip(found.values(), values, strict=True):
                of_field[name] = readonly(np.broadcast_to(each_value, cells))
        return found
