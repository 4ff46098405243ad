"""Steady sliding round a closed track, whatever its shape."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import Annotated, Self

from pydantic import model_validator

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.units import Quantity
from tribo.motion.exposure import Exposure, Track
from tribo.motion.kinematics import Kinematics
from tribo.motion.swept import one_swept_body


class ClosedTrack(Kinematics):
    """Constant speed round a closed track; one body swept over the track."""

    speed: Annotated[float, Quantity("m/s", above=0, usual=(1e-12, 200.0))]
    """Sliding speed."""
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
    def _one_end(self) -> Self:
        if sum(end is not None for end in (self.duration, self.revolutions, self.distance)) != 1:
            raise ValueError("give exactly one of duration, revolutions and distance")
        return self

    @property
    @abstractmethod
    def lap(self) -> float:
        """Length of the closed track, in m."""

    @property
    def _given(self) -> str:
        """Key that the length of the track was given by."""
        return "track_radius"

    @property
    def end_time(self) -> float:
        """Time at which the motion ends, in s."""
        if self.duration is not None:
            return self.duration
        if self.revolutions is not None:
            return self.revolutions * self.lap / self.speed
        assert self.distance is not None
        return self.distance / self.speed

    def distance_at(self, time: float) -> float:
        """Return the sliding distance until `time`, in m."""
        return self.speed * time

    def time_at(self, distance: float) -> float:
        """Return the time at which `distance` is reached, in s."""
        return distance / self.speed

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return the closed track for the swept body."""
        return one_swept_body(grid, bodies, self.swept, Track(grid, self.lap))

    def limitation(
        self, half_width_x: float, depth: float, approach: float, volume_ratio: float
    ) -> str | None:
        """Return a warning once the contact is longer than the track."""
        if 2 * half_width_x <= self.lap:
            return None
        return (
            f"the contact is {2e3 * half_width_x:.3g} mm long, longer than the track of "
            f"{1e3 * self.lap:.3g} mm: it would meet itself, and the track average no "
            "longer holds"
        )

    def check_contact(self, half_width_x: float) -> None:
        """Refuse a track that is shorter than the half-width, unless the case allows it."""
        if self.lap >= half_width_x or self.allow_short_track:
            return
        raise CaseError(
            f"the track is {1e3 * self.lap:.3g} mm long, less than the half-width of the "
            f"first contact, {1e3 * half_width_x:.3g} mm: give one of at least the contact's "
            f"length, {2e3 * half_width_x:.3g} mm, or set kinematics.allow_short_track = true",
            f"kinematics.{self._given}",
        )
