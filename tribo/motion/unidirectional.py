"""Steady sliding round a closed track, as in a pin-on-disk tester."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Literal, Self

from pydantic import Field, field_validator, model_validator

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.motion.closed_track import ClosedTrack, check_axis
from tribo.motion.cycle import Position
from tribo.motion.exposure import Exposure, Passing, Track, one_swept_body
from tribo.motion.stroke import WHOLE, Stroke, odd

NEAR_AXIS = 0.1
"""Half-width of a contact over the track's radius, from which on its curvature is spoken of."""


class Unidirectional(ClosedTrack):
    """Speed v round a track of length ℓ; one body swept over the track.

    The curvature of the track inside the contact is neglected: valid for
    contacts small beside the track radius. A run says so from a tenth of it on.

    Of two bodies that repeat with the window, as nominally flat rough ones do, and so touch all
    over, the path may be resolved into `positions`: those over the window's length stand for all of
    it, however long the track is.
    """

    examples = ({"speed": "0.1 m/s", "track_radius": "16 mm", "distance": "10 m"},)
    type = "unidirectional"
    track_length: Annotated[float, Quantity("m", above=0, usual=(1e-6, 10.0))] | None = None
    """Length of the closed track."""
    track_radius: Annotated[float, Quantity("m", above=0, usual=(1e-6, 1.0))] | None = None
    """Radius of a circular track; its length is 2πr."""
    positions: Annotated[int, Field(ge=3)] | Literal["cells", "average"] = "average"
    """In how many positions over the window's length the contact is solved, an odd number, or
    ``"cells"`` for every cell, where the contact repeats with the window; ``"average"`` takes the
    track average for all of them."""

    turns: bool = False
    """Whether the swept body turns about an axis along y, as a ring does on a block: its points
    pass, its shape stays."""

    _middle = field_validator("positions")(odd)

    @model_validator(mode="after")
    def _one_track(self) -> Self:
        if (self.track_length is None) == (self.track_radius is None):
            raise ValueError("give exactly one of track_length and track_radius")
        if self.turns and self.positions != "average":
            raise ValueError('a body that turns is the same at all positions; use "average"')
        return self

    @property
    def track_extent(self) -> float:
        """Length of the closed track, in m."""
        if self.track_length is not None:
            return self.track_length
        assert self.track_radius is not None
        return 2 * math.pi * self.track_radius

    def cycle(self, grid: Grid) -> Sequence[Position]:
        """Return the one position of the average, or those over the window's length."""
        if self.positions == "average":
            return super().cycle(grid)
        return [Position(float(share)) for share in self._stroke(grid).shares]

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return the closed track for the swept body, or the rows of the window."""
        if self.track_radius is not None and not self.turns:
            check_axis(self.track_radius, grid)
        if self.positions == "average":
            track = Track(grid, self.track_extent, shape_stays=self.turns)
            return one_swept_body(grid, bodies, self.swept, track)
        passing = Passing(grid, self._stroke(grid).starts, self.track_extent)
        return one_swept_body(grid, bodies, self.swept, passing)

    def limitation(
        self, half_width_x: float, depth: float, approach: float, volume_ratio: float, line: bool
    ) -> str | None:
        """Return a warning once the contact is not small beside the track radius."""
        radius, width = self.track_radius, f"{2e3 * half_width_x:.3g} mm"
        beyond = super().limitation(half_width_x, depth, approach, volume_ratio, line)
        if beyond or radius is None or self.turns or half_width_x <= NEAR_AXIS * radius:
            return beyond
        return (
            f"half of the contact's {width} is {half_width_x / radius:.2g} of track_radius = "
            f"{1e3 * radius:.3g} mm: its outer edge slides by as much further and the inner one "
            'less, which is left out here; use kinematics.type = "rotating"'
        )

    def _stroke(self, grid: Grid) -> Stroke:
        if grid.period is None:
            raise CaseError(
                "a track is resolved only where the contact repeats with the window "
                '(contact.type = "periodic"); use positions = "average"',
                "kinematics.positions",
            )
        if self.track_extent < grid.size[0] * (1 - WHOLE):
            raise CaseError(
                f"{1e3 * self.track_extent:.4g} mm is shorter than the window of "
                f"{1e3 * grid.size[0]:.4g} mm, after which the contact repeats",
                f"kinematics.{self._given}",
            )
        return Stroke(grid.size[0], grid.spacing[0], self.positions, grid.period)

    @property
    def _given(self) -> str:
        return "track_radius" if self.track_length is None else "track_length"
