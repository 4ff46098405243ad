"""A pin on a turning disk: the path is longer and faster away from the disk's centre."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated

import numpy as np
from pydantic import ConfigDict

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.motion.closed_track import ClosedTrack
from tribo.motion.cycle import Position
from tribo.motion.exposure import Exposure, Track, one_swept_body


class Rotating(ClosedTrack):
    """Speed v round a circle of radius R; one body swept over the track.

    Speed and sliding distance are those in the middle of the window. A row at y is at the radius
    R + y: its points slide by (R + y)/R of that distance at as much of that speed, on a track of
    length 2π(R + y). The arc is straight in the contact: valid for contacts short beside R.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [{"speed": "0.1 m/s", "track_radius": "16 mm", "distance": "10 m"}]
        }
    )

    type = "rotating"
    track_radius: Annotated[float, Quantity("m", above=0, usual=(1e-6, 1.0))]
    """Radius R of the track in the middle of the window; the axis lies towards negative y."""

    @property
    def lap(self) -> float:
        """Length of the closed track in the middle of the window, in m."""
        return 2 * math.pi * self.track_radius

    def cycle(self, grid: Grid) -> Sequence[Position]:
        """Return the one position, in which rows slide as far as they are from the axis."""
        return [Position(reach=self._radii(grid) / self.track_radius)]

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return a closed track for the swept body, each row of its own length."""
        track = Track(grid, 2 * math.pi * self._radii(grid))
        return one_swept_body(grid, bodies, self.swept, track)

    def _radii(self, grid: Grid) -> Array:
        """Return the distance from the axis of each row, shape (ny,), in m."""
        radius, half = self.track_radius, 0.5 * grid.size[1]
        if radius <= half:
            raise CaseError(
                f"{1e3 * radius:.4g} mm must be more than half the window's breadth, "
                f"{1e3 * half:.4g} mm, or the axis lies in the window",
                "kinematics.track_radius",
            )
        return np.asarray(radius + grid.mesh[1][0])
