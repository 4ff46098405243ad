"""Steady sliding round a closed track, as in a pin-on-disk tester."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Literal, Self

from pydantic import ConfigDict, model_validator

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.interfaces.exposure import Exposure
from tribo.interfaces.kinematics import Kinematics, KinematicsConfig
from tribo.kinematics.swept import one_swept_body


class UnidirectionalConfig(KinematicsConfig):
    """Give one of ``track_length`` and ``track_radius``, and one end of the motion."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [{"speed": "0.1 m/s", "track_radius": "16 mm", "distance": "10 m"}]
        }
    )

    type: Literal["unidirectional"] = "unidirectional"
    speed: Annotated[float, Quantity("m/s", above=0, usual=(1e-12, 200.0))]
    """Sliding speed."""
    track_length: Annotated[float, Quantity("m", above=0, usual=(1e-6, 10.0))] | None = None
    """Length of the closed track."""
    track_radius: Annotated[float, Quantity("m", above=0, usual=(1e-6, 1.0))] | None = None
    """Radius of a circular track; its length is 2πr."""
    duration: Annotated[float, Quantity("s", above=0)] | None = None
    """How long it runs."""
    revolutions: Annotated[float, Quantity("1", above=0)] | None = None
    """How many times it goes round."""
    distance: Annotated[float, Quantity("m", above=0)] | None = None
    """How far it slides."""
    swept: str | None = None
    """Name of the body whose points pass through the contact; the last body if left out."""
    allow_short_track: bool = False
    """Whether a track shorter than the first contact's half-width is accepted."""

    @model_validator(mode="after")
    def _one_track_and_end(self) -> Self:
        if (self.track_length is None) == (self.track_radius is None):
            raise ValueError("give exactly one of track_length and track_radius")
        if sum(end is not None for end in (self.duration, self.revolutions, self.distance)) != 1:
            raise ValueError("give exactly one of duration, revolutions and distance")
        return self


class Unidirectional(Kinematics[UnidirectionalConfig]):
    """Constant speed v round a track of length ℓ; one body swept over the track.

    The curvature of the track inside the contact is neglected: valid for
    contacts small beside the track radius.
    """

    Config = UnidirectionalConfig

    @property
    def track_length(self) -> float:
        """Length of the track, in m."""
        c = self.config
        if c.track_length is not None:
            return c.track_length
        assert c.track_radius is not None
        return 2 * math.pi * c.track_radius

    @property
    def duration(self) -> float:
        """Time at which the motion ends, in s."""
        c = self.config
        if c.duration is not None:
            return c.duration
        if c.revolutions is not None:
            return c.revolutions * self.track_length / c.speed
        assert c.distance is not None
        return c.distance / c.speed

    def distance(self, time: float) -> float:
        """Return the path slid until `time`, in m."""
        return self.config.speed * time

    def time(self, distance: float) -> float:
        """Return the time at which `distance` is reached, in s."""
        return distance / self.config.speed

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return the closed track for the swept body."""
        return one_swept_body(grid, bodies, self.config.swept, self.track_length)

    def limitation(self, grid: Grid, half_width_x: float) -> str | None:
        """Return a warning once the contact is longer than the track."""
        if 2 * half_width_x <= self.track_length:
            return None
        return (
            f"the contact is {2e3 * half_width_x:.3g} mm long, longer than the track of "
            f"{1e3 * self.track_length:.3g} mm: it would meet itself, and the track average no "
            "longer holds"
        )

    def check_contact(self, half_width_x: float) -> None:
        """Refuse a track that is shorter than the half-width, unless the case allows it."""
        if self.track_length >= half_width_x or self.config.allow_short_track:
            return
        given = "track_length" if self.config.track_length is not None else "track_radius"
        raise CaseError(
            f"the track is {1e3 * self.track_length:.3g} mm long, less than the half-width of the "
            f"first contact, {1e3 * half_width_x:.3g} mm: give one of at least the contact's "
            f"length, {2e3 * half_width_x:.3g} mm, or set kinematics.allow_short_track = true",
            f"kinematics.{given}",
        )
