"""The drive of the contact: an amplitude, constant or in stages, a rig, and a largest force."""

from __future__ import annotations

from bisect import bisect_left
from typing import Annotated, Literal, Self

from pydantic import Tag, model_validator
from tribo import Quantity, Table
from tribo.kernel_api import NUMBER, ONE_OR_STAGES, STAGES, Held, held

Amplitude = Annotated[float, Quantity("m", above=0, usual=(1e-10, 1e-3))]


class AmplitudeStage(Table):
    """A stage of an amplitude that changes over time: it is held until a time."""

    until: Annotated[float, Quantity("s", above=0)]
    """When it ends."""
    amplitude: Amplitude
    """Amplitude of the motion to each side."""


class Drive(Table):
    """The drive of a contact to and fro along x."""

    amplitude: Annotated[
        Annotated[Amplitude, Tag(NUMBER)] | Annotated[tuple[AmplitudeStage, ...], Tag(STAGES)],
        ONE_OR_STAGES,
    ]
    """Amplitude of the motion to each side: a number, or a list of stages, each a table with
    `until` and `amplitude`."""
    stiffness: Annotated[float, Quantity("N/m", above=0, usual=(1e2, 1e12))] | None = None
    """Stiffness of the rig in series with the contact, along x: the amplitude is then the rig's; a
    rigid rig if left out."""
    force_amplitude: Annotated[float, Quantity("N", above=0)] | None = None
    """Tangential force at which the motion turns back before its amplitude is reached."""
    direction: Literal["free", "along"] = "along"
    """Whether points slip along x alone, as in closed forms, or as their traction leads them."""
    tolerance: Annotated[float, Quantity("1", above=1e-13, below=1e-3)] = 1e-9
    """How exactly points stick, relative to the displacement."""
    allow_narrow_ring: bool = False
    """Whether a first contact is accepted whose ring of slip is narrower than four cells."""

    @model_validator(mode="after")
    def _stages_rise(self) -> Self:
        _ = self.held
        return self

    @property
    def held(self) -> Held:
        """The amplitudes, in m, and until when each is held, in s."""
        return held("amplitude", self.amplitude)

    def amplitude_at(self, time: float) -> float:
        """Return the amplitude (m) up to a time, in s; the last one beyond."""
        return self.held.rates[self._stage_at(time)]

    def amplitude_path(self, time: float) -> str:
        """Return the path to the amplitude up to a time, in s."""
        one = isinstance(self.amplitude, float)
        return "amplitude" if one else f"amplitude.{self._stage_at(time)}.amplitude"

    def _stage_at(self, time: float) -> int:
        return min(bisect_left(self.held.ends, time), len(self.held.ends) - 1)

    @property
    def components(self) -> int:
        """Number of components of the traction."""
        return 2 if self.direction == "free" else 1
