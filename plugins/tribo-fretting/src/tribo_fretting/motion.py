"""The motion of fretting: to and fro by less than the contact is long, both bodies stay in it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from typing import Annotated, Self

from pydantic import model_validator
from tribo import Effect, Exposure, Grid, Kinematics, Quantity, Stationary
from tribo.kernel_api import Held

from tribo_fretting.drive import Drive
from tribo_fretting.partial_slip import PartialSlip


class Fretting(Kinematics, Drive):
    """To and fro between ±δ at frequency f: a path of 4 δ each cycle, along x.

    Points of both bodies stay in the contact; the effect `fretting.partial_slip` is their slip.

    Examples
    --------
    >>> from tribo_fretting.motion import Fretting
    >>> motion = Fretting(amplitude="3 um", frequency="20 Hz", cycles=1e5)
    >>> round(motion.distance_at(motion.end_time), 3)  # in m
    1.2
    """

    examples = ({"amplitude": "3 um", "frequency": "20 Hz", "cycles": 1e5},)
    type = "fretting.motion"
    turns_back = True
    frequency: Annotated[float, Quantity("Hz", above=0, usual=(1e-6, 1e5))]
    """Full cycles, to and fro, per second."""
    duration: Annotated[float, Quantity("s", above=0)] | None = None
    """Duration of the motion."""
    cycles: Annotated[float, Quantity("1", above=0, also=("lap",))] | None = None
    """Number of full cycles."""

    @model_validator(mode="after")
    def _one_end(self) -> Self:
        if (self.duration is None) == (self.cycles is None):
            raise ValueError("give exactly one of duration and cycles")
        return self

    @property
    def _path(self) -> Held:
        rates = tuple(4 * self.frequency * amplitude for amplitude in self.held.rates)
        return Held(rates, self.held.ends)

    @property
    def end_time(self) -> float:
        """Time at which the motion ends, in s."""
        time = self.duration or (self.cycles or 0.0) / self.frequency
        return self._path.end("amplitude", "m", time, None)

    @property
    def track_extent(self) -> float:
        """Length of the longest stroke, in m."""
        return 2 * max(self.held.rates)

    @property
    def lap(self) -> float:
        """Path of a cycle, in m; infinite where the amplitude changes."""
        return inf if self.edges else 2 * self.track_extent

    @property
    def edges(self) -> Sequence[float]:
        """Times at which one stage of the amplitude ends and the next begins, in s."""
        return [*self.held.ends[:-1]]

    def distance_at(self, time: float) -> float:
        """Return the path until `time`, in m."""
        return self._path.by(time)

    def coarsened(self, half_width_x: float) -> Kinematics:
        """Return the motion for a coarse grid, whose ring of slip is narrow."""
        return self.model_copy(update={"allow_narrow_ring": True})

    def effects(self) -> Sequence[Effect]:
        """Return the partial slip under this motion."""
        return [PartialSlip(**{name: getattr(self, name) for name in Drive.model_fields})]

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return stationary exposures of both bodies."""
        return {name: Stationary(grid) for name in bodies}
