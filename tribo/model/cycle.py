"""A cycle of the motion: its positions, and how each body's surface meets the window at them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.fields import PLACE_X, PLACE_Y
from tribo.core.grid import Grid
from tribo.motion.cycle import Position, missed_shares
from tribo.motion.exposure import Exposure


@dataclass(frozen=True)
class Cycle:
    """The positions of a cycle in order, one of them alone for an average.

    Parameters
    ----------
    grid : Grid
        The window.
    positions : tuple of Position
        Those in which the contact is solved.
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
        alone = (each.starts is not None or each.rows == along for each in self.maps.values())
        return len(self) > 1 and all(alone)

    @cached_property
    def apart(self) -> float:
        """Largest distance between neighbouring positions, in m; 0 of an average."""
        steps = [np.diff(e.starts) for e in self.maps.values() if e.starts is not None]
        widest = max((float(np.max(np.abs(s), initial=0)) for s in steps), default=0.0)
        return widest * self.grid.spacing[0]

    @cached_property
    def missed_shares(self) -> Array | None:
        """Shares by which rates at the positions add up to what is estimated to lie between them.

        None where the cycle is not resolved, or into every cell.
        """
        starts = [each.starts for each in self.maps.values() if each.starts is not None]
        if not starts or self.apart <= self.grid.spacing[0]:
            return None
        nodes = -np.array(starts[0], dtype=float)
        return missed_shares(nodes, np.array([position.share for position in self]))

    def places(self, position: int) -> dict[str, dict[str, Array]]:
        """Return where each body's own surface lies in the window at a position, in m.

        x is 0 on a body of which every point of a track is the same.
        """
        dx, cells = self.grid.spacing[0], self.grid.cells
        along, across = {}, {}
        for name, each in self.maps.items():
            own = dx * (np.arange(float(each.rows))[:, None] - 0.5 * (each.rows - 1))
            along[name] = readonly(np.broadcast_to(each.see(own, position), cells))
            across[name] = readonly(np.broadcast_to(self.grid.y, cells))
        return {PLACE_X.name: along, PLACE_Y.name: across}
