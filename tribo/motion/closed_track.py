"""Steady sliding round a closed track, whatever its shape."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Self

from pydantic import Tag, field_validator, model_validator

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.loads import NUMBER, ONE_OR_STAGES, STAGES, listed
from tribo.core.table import Table
from tribo.core.units import Quantity, parse
from tribo.motion.held import Held, held
from tribo.motion.kinematics import Kinematics


class SpeedStage(Table):
    """A stage of a speed that changes over time: it is held until a time."""

    until: Annotated[float, Quantity("s", above=0)]
    """When it ends."""
    speed: Annotated[float, Quantity("m/s", at_least=0, usual=(1e-12, 200.0))]
    """Sliding speed; 0 for a rest."""


def check_axis(radius: float, grid: Grid) -> None:
    """Refuse a circular track of this radius (m) with its axis in the window."""
    half = 0.5 * grid.size[1]
    if radius <= half:
        raise CaseError(
            f"with {1e3 * radius:.4g} mm the axis of the track lies in the window; give more than "
            f"{1e3 * half:.4g} mm or, if the contact stays within it, a window (grid.size) less "
            f"than {2e3 * radius:.4g} mm broad",
            "kinematics.track_radius",
        )


class Steady(Kinematics):
    """Sliding round a closed path, at one speed or in stages; one body passes."""

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
    duration: Annotated[float, Quantity("s", above=0)] | None = None
    """How long it runs."""
    revolutions: Annotated[float, Quantity("1", above=0, also=("lap",))] | None = None
    """How many times it goes round."""
    distance: Annotated[float | str, Quantity("m", above=0, also=("lap",))] | None = None
    """How far it slides."""
    swept: str | None = None
    """Name of the body whose points pass through the contact; the last body if left out."""

    _in_a_list = field_validator("speed", mode="before")(listed)

    @field_validator("speed")
    @classmethod
    def _slides_on(
        cls, speed: float | str | tuple[SpeedStage, ...]
    ) -> float | str | tuple[SpeedStage, ...]:
        if not isinstance(speed, str):
            held("speed", speed)
        return speed

    @model_validator(mode="after")
    def _one_end(self) -> Self:
        if sum(end is not None for end in (self.duration, self.revolutions, self.distance)) != 1:
            raise ValueError("give exactly one of duration, revolutions and distance")
        return self

    @property
    def _held(self) -> Held:
        given = self.speed
        return held("speed", parse(given, "Hz") * self.lap if isinstance(given, str) else given)

    @property
    def edges(self) -> Sequence[float]:
        """Times at which one stage of the speed ends and another begins, in s."""
        return self._held.ends[:-1]

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


class ClosedTrack(Steady):
    """Steady sliding that is averaged over a closed track."""

    allow_short_track: bool = False
    """Whether a track shorter than the first contact's half-width is accepted."""

    @property
    def _given(self) -> str:
        """Key that the length of the track was given by."""
        return "track_radius"

    def limitation(
        self, half_width_x: float, depth: float, approach: float, volume_ratio: float, line: bool
    ) -> str | None:
        """Return a warning once the contact is longer than the track."""
        if 2 * half_width_x <= self.track_extent:
            return None
        return (
            f"the contact is {2e3 * half_width_x:.3g} mm long, longer than the track of "
            f"{1e3 * self.track_extent:.3g} mm: it would meet itself, and the track average no "
            "longer holds"
        )

    def check_contact(self, half_width_x: float) -> None:
        """Refuse a track that is shorter than the half-width, unless the case allows it."""
        if self.track_extent >= half_width_x or self.allow_short_track:
            return
        raise CaseError(
            f"the track is {1e3 * self.track_extent:.3g} mm long, less than the half-width of the "
            f"first contact, {1e3 * half_width_x:.3g} mm: give one of at least the contact's "
            f"length, {2e3 * half_width_x:.3g} mm, or set kinematics.allow_short_track = true",
            f"kinematics.{self._given}",
        )
