"""How a fretting contact is driven: amplitude, stages of it, the rig and its force."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Discriminator, Tag, field_validator
from tribo import Quantity, Table

Amplitude = Annotated[float, Quantity("m", above=0, usual=(1e-10, 1e-3))]


class AmplitudeStage(Table):
    """A stage of an amplitude that changes over time: it is held until a time."""

    until: Annotated[float, Quantity("s", above=0)]
    """When it ends."""
    amplitude: Amplitude
    """How far the motion goes to each side."""


class Drive(Table):
    """What drags a contact to and fro along x."""

    amplitude: Annotated[
        Annotated[Amplitude, Tag("number")] | Annotated[tuple[AmplitudeStage, ...], Tag("stages")],
        Discriminator(lambda value: "stages" if isinstance(value, list | tuple) else "number"),
    ]
    """How far the motion goes to each side: a number, or a list of stages, each a table with
    `until` and `amplitude`."""
    stiffness: Annotated[float, Quantity("N/m", above=0, usual=(1e2, 1e12))] | None = None
    """Stiffness of the rig in series with the contact, along x: the amplitude is then that of the
    rig; a rigid rig if left out."""
    force_amplitude: Annotated[float, Quantity("N", above=0)] | None = None
    """Tangential force at which the motion turns back before its amplitude is reached."""
    direction: Literal["free", "along"] = "along"
    """Whether points slip along x alone, as in closed forms, or as their traction leads them."""
    tolerance: Annotated[float, Quantity("1", above=1e-13, below=1e-3)] = 1e-9
    """How exactly points stick, relative to the displacement."""
    allow_narrow_ring: bool = False
    """Whether a first contact is accepted whose ring of slip is narrower than four cells."""

    @field_validator("amplitude")
    @classmethod
    def _rises(
        cls, amplitude: float | tuple[AmplitudeStage, ...]
    ) -> float | tuple[AmplitudeStage, ...]:
        if isinstance(amplitude, float):
            return amplitude
        if not amplitude:
            raise ValueError("the list is empty; give a number, or stages up to the end of the run")
        for one, other in pairwise(stage.until for stage in amplitude):
            if other <= one:
                raise ValueError(
                    f"times must increase from stage to stage, but {one:g} s is followed by "
                    f"{other:g} s"
                )
        return amplitude

    @property
    def stages(self) -> tuple[tuple[float, float], ...]:
        """When each amplitude ends, in s, and the amplitude, in m; one is held for ever."""
        if isinstance(self.amplitude, float):
            return ((float("inf"), self.amplitude),)
        return tuple((stage.until, stage.amplitude) for stage in self.amplitude)

    def amplitude_at(self, time: float) -> float:
        """Return the amplitude (m) up to a time, in s; the last one beyond."""
        return next((held for end, held in self.stages if time <= end), self.stages[-1][1])
