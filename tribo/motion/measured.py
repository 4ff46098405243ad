"""Measured motion back and forth: positions over time, from a file or from Python."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, field_validator, model_validator

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.number_tables import read_pairs
from tribo.core.rounding import ROUND_OFF
from tribo.core.units import Quantity
from tribo.motion.cycle import Position
from tribo.motion.exposure import Exposure, Passing, one_swept_body
from tribo.motion.kinematics import Kinematics
from tribo.motion.stroke import Stroke, odd

CLOSED = 0.01
"""Largest distance between the ends of a path that repeats, of its range."""

Sample = tuple[Annotated[float, Quantity("s")], Annotated[float, Quantity("m")]]


class Measured(Kinematics):
    """A measured path: position of the swept body along x, over time, with rests and reversals.

    Between two samples it moves at constant speed. The sliding distance is the total variation of
    the position: noise of the sensor counts as sliding, so smooth it before. The cycle is resolved
    into positions, each with the share of the whole path near it, the mean speed there and the
    time at rest; their order is not kept.

    Examples
    --------
    >>> path = [(0, 0), (1, 1e-3), (2, 1e-3), (4, 0)]  # s and m: there, a rest, back
    >>> motion = tribo.Measured(path=path, cycles=100)
    >>> motion.end_time, round(motion.distance_at(motion.end_time), 6)  # s, m
    (400.0, 0.2)
    """

    examples = ({"path": [[0, 0], [1, 1e-3], [2, 1e-3], [4, 0]], "cycles": 100},)
    type = "measured"
    turns_back = True
    path: Annotated[tuple[Sample, ...], Field(min_length=2)]
    """Pairs of time and position, or the name of a CSV or .npy file with these two columns, in s
    and m; a relative name starts at the current directory."""
    duration: Annotated[float, Quantity("s", above=0)] | None = None
    """Duration, with the path repeated; once through the path if left out."""
    cycles: Annotated[float, Quantity("1", above=0, also=("lap",))] | None = None
    """Number of repetitions of the path."""
    positions: Annotated[int, Field(ge=3)] | Literal["cells"] = 33
    """Number of positions in which the contact is solved, odd, or ``"cells"`` for every cell along
    the path."""
    swept: str | None = None
    """Name of the body whose points pass through the contact; the last body if left out."""

    @field_validator("path", mode="before")
    @classmethod
    def _from_file(cls, value: Any) -> Any:
        if isinstance(value, str | Path):
            return read_pairs(Path(value), "time in s and position in m").tolist()
        return value

    @field_validator("path")
    @classmethod
    def _moves_on(cls, path: tuple[Sample, ...]) -> tuple[Sample, ...]:
        times, places = np.array(path).T
        back = np.flatnonzero(np.diff(times) <= 0)
        if len(back):
            raise ValueError(
                f"time must increase from sample to sample, but {times[back[0]]:g} s is followed "
                f"by {times[back[0] + 1]:g} s"
            )
        if np.all(places == places[0]):
            raise ValueError("the position never changes; give a path that slides")
        return path

    _middle = field_validator("positions")(odd)

    @model_validator(mode="after")
    def _one_end(self) -> Self:
        if self.duration is not None and self.cycles is not None:
            raise ValueError("give duration or cycles, not both")
        first, last = self.path[0][1], self.path[-1][1]
        if (
            self.end_time > self._period * (1 + ROUND_OFF)
            and abs(last - first) > CLOSED * self.track_extent
        ):
            raise ValueError(
                f"the path begins at {1e3 * first:.4g} mm and ends at {1e3 * last:.4g} mm; to "
                "repeat, it must end where it begins"
            )
        return self

    @cached_property
    def _samples(self) -> tuple[Array, Array, Array]:
        """Times from 0, positions about the middle of the path, and the distance slid by then."""
        times, places = np.array(self.path).T
        slid = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(places)))])
        return times - times[0], places - 0.5 * (np.min(places) + np.max(places)), slid

    @property
    def _period(self) -> float:
        return float(self._samples[0][-1])

    @property
    def track_extent(self) -> float:
        """Range of the path, in m."""
        places = self._samples[1]
        return float(np.max(places) - np.min(places))

    @property
    def lap(self) -> float:
        """Length of the path, in m."""
        return float(self._samples[2][-1])

    @property
    def end_time(self) -> float:
        """Time at which the motion ends, in s."""
        if self.duration is not None:
            return self.duration
        return self._period if self.cycles is None else self.cycles * self._period

    def distance_at(self, time: float) -> float:
        """Return the sliding distance until `time`, in m."""
        times, _, slid = self._samples
        whole = math.floor(time / self._period)
        rest = np.interp(time - whole * self._period, times, slid)
        return float(whole * slid[-1] + rest)

    def cycle(self, grid: Grid) -> Sequence[Position]:
        """Return the positions along the path, with the mean speed and the rests about each."""
        times, places, _ = self._samples
        return self._stroke(grid).passed(times, places)

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return its rows along the path for the swept body."""
        passing = Passing(grid, self._stroke(grid).starts, self.track_extent)
        return one_swept_body(grid, bodies, self.swept, passing)

    def _stroke(self, grid: Grid) -> Stroke:
        return Stroke(self.track_extent, grid.spacing[0], self.positions, grid.period)
