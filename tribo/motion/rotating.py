"""A pin on a turning disk: the path is longer and faster away from the disk's axis."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated

import numpy as np

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.motion.closed_track import ClosedTrack, check_axis
from tribo.motion.cycle import Position
from tribo.motion.exposure import Exposure, Track, one_swept_body


class Rotating(ClosedTrack):
    """Speed v round a circle of radius R; one body swept over the track.

    Speed and sliding distance are those in the middle of the window. A point at (x, y) is at the
    radius ρ = √(x² + (R + y)²) and slides by ρ/R of that distance at as much of that speed. The
    swept body passes along rows, each a track of length 2π(R + y): its volume is exact, but its
    groove lies on straight lines in place of arcs, which are x²/2R apart. Valid for contacts short
    beside R.
    """

    examples = ({"speed": "0.1 m/s", "track_radius": "16 mm", "distance": "10 m"},)
    type = "rotating"
    track_radius: Annotated[float, Quantity("m", above=0, usual=(1e-6, 1.0))]
    """Radius R of the track in the middle of the window; the axis lies towards negative y."""

    @property
    def track_extent(self) -> float:
        """Length of the closed track in the middle of the window, in m."""
        return 2 * math.pi * self.track_radius

    def cycle(self, grid: Grid) -> Sequence[Position]:
        """Return the one position, in which points slide as far as they are from the axis."""
        x, out = grid.mesh[0], self._rows(grid)
        radius = np.hypot(x, out)
        heading = np.broadcast_to(out / radius, grid.cells), np.asarray(-x / radius)
        return [Position(reach=radius / self.track_radius, heading=heading)]

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return a closed track for the swept body, each row of its own length."""
        track = Track(grid, 2 * math.pi * self._rows(grid))
        return one_swept_body(grid, bodies, self.swept, track)

    def _rows(self, grid: Grid) -> Array:
        """Return the distance from the axis of each row, shape (ny,), in m."""
        check_axis(self.track_radius, grid)
        return np.asarray(self.track_radius + grid.mesh[1][0])
