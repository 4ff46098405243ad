"""Steady sliding round a closed track, as in a pin-on-disk tester."""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import ConfigDict, model_validator

from tribo.core.units import Quantity
from tribo.motion.closed_track import ClosedTrack


class Unidirectional(ClosedTrack):
    """Constant speed v round a track of length ℓ; one body swept over the track.

    The curvature of the track inside the contact is neglected: valid for
    contacts small beside the track radius.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [{"speed": "0.1 m/s", "track_radius": "16 mm", "distance": "10 m"}]
        }
    )

    type = "unidirectional"
    track_length: Annotated[float, Quantity("m", above=0, usual=(1e-6, 10.0))] | None = None
    """Length of the closed track."""
    track_radius: Annotated[float, Quantity("m", above=0, usual=(1e-6, 1.0))] | None = None
    """Radius of a circular track; its length is 2πr."""

    @model_validator(mode="after")
    def _one_track(self) -> Self:
        if (self.track_length is None) == (self.track_radius is None):
            raise ValueError("give exactly one of track_length and track_radius")
        return self

    @property
    def lap(self) -> float:
        """Length of the closed track, in m."""
        if self.track_length is not None:
            return self.track_length
        assert self.track_radius is not None
        return 2 * math.pi * self.track_radius

    @property
    def _given(self) -> str:
        return "track_radius" if self.track_length is None else "track_length"
