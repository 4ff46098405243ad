"""Steady sliding round a closed track, whatever its shape."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Annotated, Self

import numpy as np
from pydantic import Tag, field_validator, model_validator

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.stages import NUMBER, ONE_OR_STAGES, STAGES, check_times, listed
from tribo.core.table import Table
from tribo.core.units import Quantity
from tribo.motion.exposure import Exposure, Track
from tribo.motion.kinematics import Kinematics
from tribo.motion.swept import one_swept_body

ROUNDING = 1e-12


class SpeedStage(Table):
    """A stage of a speed that changes over time: it is held until a time."""

    until: Annotated[float, Quantity("s", above=0)]
    """When it ends."""
    speed: Annotated[float, Quantity("m/s", at_least=0, usual=(1e-12, 200.0))]
    """Sliding speed; 0 for a rest."""


class ClosedTrack(Kinematics):
    """Sliding round a closed track, at one speed or in stages; one body swept over the track."""

    speed: Annotated[
        Annotated[float, Quantity("m/s", above=0, usual=(1e-12, 200.0)), Tag(NUMBER)]
        | Annotated[tuple[SpeedStage, ...], Tag(STAGES)],
        ONE_OR_STAGES,
    ]
    """Sliding speed: a number, or a list of stages, each a table with `until` and `speed`, 0 for a
    rest."""
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

    _in_a_list = field_validator("speed", mode="before")(listed)

    @field_validator("speed")
    @classmethod
    def _slides_on(cls, speed: float | tuple[SpeedStage, ...]) -> float | tuple[SpeedStage, ...]:
        if not isinstance(speed, float):
            check_times([stage.until for stage in speed], "speed")
            if not any(stage.speed for stage in speed):
                raise ValueError("every stage is a rest; give one that slides")
        return speed

    @model_validator(mode="after")
    def _one_end(self) -> Self:
        if sum(end is not None for end in (self.duration, self.revolutions, self.distance)) != 1:
            raise ValueError("give exactly one of duration, revolutions and distance")
        return self

    @cached_property
    def _course(self) -> tuple[Array, Array]:
        """Times at which stages end, from 0 on, in s, and the distance slid by then, in m."""
        assert not isinstance(self.speed, float)
        times = np.array([0.0, *(stage.until for stage in self.speed)])
        speeds = np.array([stage.speed for stage in self.speed])
        return times, np.concatenate([[0.0], np.cumsum(speeds * np.diff(times))])

    @property
    def edges(self) -> Sequence[float]:
        """Times at which one stage of the speed ends and another begins, in s."""
        return () if isinstance(self.speed, float) else [s.until for s in self.speed[:-1]]

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
        """Time at which the motion ends, in s.

        Raises
        ------
        CaseError
            If the stages of the speed end before.
        """
        far = self.distance if self.revolutions is None else self.revolutions * self.lap
        if not isinstance(self.speed, float):
            times, slid = self._course
            left = (slid[-1] - (far or 0.0)) / slid[-1], 1 - (self.duration or 0.0) / times[-1]
            if min(left) < -ROUNDING:
                end = f"{self.duration:g} s" if far is None else f"{far:g} m"
                raise CaseError(
                    f"the speed ends at {times[-1]:g} s, after {slid[-1]:g} m, before the run does "
                    f"at {end}; give it up to then",
                    "kinematics.speed",
                )
        if self.duration is not None:
            return self.duration
        assert far is not None
        return self.time_at(far)

    def distance_at(self, time: float) -> float:
        """Return the sliding distance until `time`, in m."""
        if isinstance(self.speed, float):
            return self.speed * time
        return float(np.interp(time, *self._course))

    def time_at(self, distance: float) -> float:
        """Return the first time at which `distance` is reached, in s."""
        if isinstance(self.speed, float):
            return distance / self.speed
        times, slid = self._course
        distance = min(distance, float(slid[-1]))
        if distance <= 0:
            return 0.0
        stage = int(np.searchsorted(slid, distance)) - 1
        return float(times[stage + 1] - (slid[stage + 1] - distance) / self.speed[stage].speed)

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
