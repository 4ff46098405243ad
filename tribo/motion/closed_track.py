"""Steady sliding round a closed track: of any shape, straight under the contact, round an axis."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Self

import numpy as np
from pydantic import Tag, model_validator

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.loads import NUMBER, ONE_OR_STAGES, STAGES
from tribo.core.table import Table
from tribo.core.units import Quantity
from tribo.motion.cycle import Position
from tribo.motion.exposure import Exposure, Track, one_swept_body
from tribo.motion.held import HeldMotion


class SpeedStage(Table):
    """A stage of a speed that changes over time: it is held until a time.

    Examples
    --------
    >>> stages = [tribo.SpeedStage(until="10 s", speed="0.1 m/s"), {"until": 30, "speed": 0}]
    >>> motion = tribo.Unidirectional(speed=stages, track_radius="16 mm", duration="30 s")
    >>> motion.distance_at(20.0)  # m, during the rest
    1.0
    """

    until: Annotated[float, Quantity("s", above=0)]
    """When it ends."""
    speed: Annotated[float, Quantity("m/s", at_least=0, usual=(1e-12, 200.0))]
    """Sliding speed; 0 for a rest."""


class Steady(HeldMotion):
    """Sliding round a closed path, at one speed or in stages, with one moving body."""

    _rate_key, _laps_key = "speed", "revolutions"
    speed: Annotated[
        Annotated[
            float | str,
            Quantity("m/s", above=0, usual=(1e-12, 200.0), also=("Hz",)),
            Tag(NUMBER),
        ]
        | Annotated[tuple[SpeedStage, ...], Tag(STAGES)],
        ONE_OR_STAGES,
    ]
    """Sliding speed, or how often it goes round, as ``"60 rpm"``: a number, or a list of stages,
    each a table with `until` and `speed`, 0 for a rest."""
    revolutions: Annotated[float, Quantity("1", above=0, also=("lap",))] | None = None
    """Number of revolutions."""

    @property
    def end_time(self) -> float:
        """Time at which the motion ends, in s; `CaseError` if its stages end before."""
        slid = self.metres(self.distance or 0.0)
        far = slid if self.revolutions is None else self.revolutions * self.track_extent
        return self._held.end("speed", "m", self.duration, far)

    def distance_at(self, time: float) -> float:
        """Return the sliding distance until `time`, in m."""
        return self._held.by(time)

    def time_at(self, distance: float) -> float:
        """Return the first time at which `distance` is reached, in s."""
        return self._held.reached(distance)


class Unidirectional(Steady):
    """Speed v round a track of length ℓ; one body swept over the track.

    The curvature of the track inside the contact is neglected: valid for contacts of less than a
    tenth of the track radius; `Rotating` has it.

    Of two bodies that repeat with the window, such as nominally flat rough ones, `Reciprocating`
    over the window's length resolves the track into positions.

    Examples
    --------
    >>> motion = tribo.Unidirectional(speed="60 rpm", track_radius="16 mm", distance="1 km")
    >>> round(motion.end_time / 3600, 2)  # hours
    2.76
    """

    examples = ({"speed": "0.1 m/s", "track_radius": "16 mm", "distance": "10 m"},)
    type = "unidirectional"
    track_length: Annotated[float, Quantity("m", above=0, usual=(1e-6, 10.0))] | None = None
    """Length of the closed track."""
    track_radius: Annotated[float, Quantity("m", above=0, usual=(1e-6, 1.0))] | None = None
    """Radius of a circular track; its length is 2πr."""
    turns: bool = False
    """Whether the swept body turns about an axis along y, as a ring does on a block: its points
    pass, its shape stays."""

    @model_validator(mode="after")
    def _one_track(self) -> Self:
        if (self.track_length is None) == (self.track_radius is None):
            raise ValueError("give exactly one of track_length and track_radius")
        return self

    @property
    def track_extent(self) -> float:
        """Length of the closed track, in m."""
        if self.track_length is not None:
            return self.track_length
        assert self.track_radius is not None
        return 2 * math.pi * self.track_radius

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return the closed track for the swept body."""
        track = Track(grid, self.track_extent, shape_stays=self.turns)
        return one_swept_body(grid, bodies, self.swept, track)


class Rotating(Steady):
    """Speed v round a circle of radius R; one body swept over the track.

    Speed and sliding distance refer to the middle of the window. A point at (x, y) is at the radius
    ρ = √(x² + (R + y)²); its distance and speed are ρ/R times as large. The swept body moves along
    rows, each a track of length 2π(R + y): its volume is exact. Its groove lies on straight lines
    in place of arcs: for a contact of half-width a, depths are off by 0.27 a/R of the deepest.

    Examples
    --------
    >>> motion = tribo.Rotating(speed="0.1 m/s", track_radius="16 mm", revolutions=1)
    >>> (position,) = motion.cycle(tribo.Grid("4 mm", 4))
    >>> position.reach[1].round(2).tolist()  # ρ/R: points near the axis slide less far
    [0.91, 0.97, 1.03, 1.09]
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
        radius, half = self.track_radius, 0.5 * grid.size[1]
        if radius <= half:
            raise CaseError(
                f"with {1e3 * radius:.4g} mm the axis of the track lies in the window; give more "
                f"than {1e3 * half:.4g} mm or, if the contact stays within it, a window "
                f"(grid.size) less than {2e3 * radius:.4g} mm broad",
                "kinematics.track_radius",
            )
        return np.asarray(radius + grid.mesh[1][0])
