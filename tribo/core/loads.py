"""The normal load over time: as a case gives it, and as contacts carry it."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from operator import itemgetter
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np
from pydantic import Discriminator, Tag, field_validator, model_validator

from tribo.core.number_tables import read_pairs
from tribo.core.table import Table
from tribo.core.units import Quantity

NUMBER, STAGES = "number", "stages"
ONE_OR_STAGES = Discriminator(lambda value: STAGES if isinstance(value, list | tuple) else NUMBER)
"""Discriminates a number from a list of stages, by the tags of these names."""
FEW = 50
"""Stages of an estimate: a trial run under a load of 1000 lines takes 6 s of CPU, not 32."""
FILES = (".csv", ".npy")
USUAL = (1e-12, 1e6)
"""Loads that are usual, in N: from the tip of an AFM to a press of 100 t."""
PAUSE = "for a pause give frequency = 0 or speed = 0 in stages"
NormalLoad = Annotated[float, Quantity("N", above=0, usual=USUAL)]


def listed(value: Any) -> Any:
    """Return a value of a case; raise ValueError of one stage that is in no list."""
    if isinstance(value, Mapping):
        raise ValueError("one table was given; write a list of them: [{ until = …, … }, …]")
    return value


def check_times(times: Sequence[float], what: str) -> None:
    """Raise ValueError unless the times at which stages of `what` end, in s, increase."""
    if not times:
        raise ValueError(
            f"the list is empty; give a number, or the stages of the {what} up to the end of the "
            "run"
        )
    for before, after in pairwise(times):
        if after <= before:
            raise ValueError(
                "times must increase from stage to stage, but "
                f"{before:g} s is followed by {after:g} s"
            )


class Stage(Table):
    """A stage of a load that changes over time: held until a time, or reached in a straight line.

    Give either time, the first `at` as 0 s.

    Examples
    --------
    >>> stages = tribo.Stage(until="10 min", normal="5 N"), tribo.Stage(until="1 h", normal="20 N")
    >>> [stage.time for stage in tribo.Load(normal=stages).normal]
    [600.0, 3600.0]
    """

    until: Annotated[float, Quantity("s", above=0)] | None = None
    """End of a load that is held from the end of the stage before."""
    at: Annotated[float, Quantity("s", at_least=0)] | None = None
    """Time at which the load is reached in a straight line from the load before."""
    normal: Annotated[float, Quantity("N", above=0, usual=USUAL, remedy=PAUSE)]
    """The load, at all times more than 0: bodies that lift off are not modelled."""

    @model_validator(mode="after")
    def _one_time(self) -> Self:
        if (self.until is None) == (self.at is None):
            raise ValueError(
                "give either until, when a load ends that is held, or at, when one is reached"
            )
        return self

    @property
    def time(self) -> float:
        """When it ends, in s."""
        return (self.at if self.until is None else self.until) or 0.0


class Load(Table):
    """The load on the contact.

    Examples
    --------
    >>> tribo.Load(normal="1.5 kN").normal
    1500.0
    """

    normal: Annotated[
        Annotated[NormalLoad, Tag(NUMBER)] | Annotated[tuple[Stage, ...], Tag(STAGES)],
        ONE_OR_STAGES,
    ]
    """Normal load: a number, or a list of stages, each a table with keys as below; or the name of a
    CSV or .npy file with the columns time and load, in s and N, and lines in between, a relative
    name from the current directory."""

    @field_validator("normal", mode="before")
    @classmethod
    def _from_file(cls, value: Any) -> Any:
        if isinstance(value, Path) or (isinstance(value, str) and value.endswith(FILES)):
            return _read(Path(value))
        return listed(value)

    @field_validator("normal")
    @classmethod
    def _moves_on(cls, normal: float | tuple[Stage, ...]) -> float | tuple[Stage, ...]:
        if isinstance(normal, float):
            return normal
        check_times([stage.time for stage in normal], "load")
        if normal[0].at:
            raise ValueError(
                f"the load begins at {normal[0].at:g} s: give the first stage at = 0, or until"
            )
        return normal

    @property
    def points(self) -> tuple[tuple[float, float], ...]:
        """Times, in s, and loads, in N, with lines in between; two of one time at a jump."""
        if isinstance(self.normal, float):
            return (0.0, self.normal), (inf, self.normal)
        found: list[tuple[float, float]] = []
        for stage in self.normal:
            if stage.until is not None:
                found.append((found[-1][0] if found else 0.0, stage.normal))
            found.append((stage.time, stage.normal))
        return tuple(found)

    def thinned(self) -> Load:
        """Return the load in a few stages of equal length, each held at the mean over its time."""
        if isinstance(self.normal, float) or len(self.normal) <= FEW:
            return self
        times, loads = np.array(self.points).T
        carried = np.cumsum([0.0, *(np.diff(times) * 0.5 * (loads[:-1] + loads[1:]))])
        ends = np.linspace(0.0, times[-1], FEW + 1)
        means = np.diff(np.interp(ends, times, carried)) / np.diff(ends)
        stages = zip(ends[1:].tolist(), means.tolist(), strict=True)
        return Load(normal=tuple(Stage(until=time, normal=load) for time, load in stages))


@dataclass(frozen=True)
class Loads:
    """The normal load over time, with `points` as in `Load.points`, times a factor."""

    points: tuple[tuple[float, float], ...]
    factor: float = 1.0

    @property
    def edges(self) -> tuple[float, ...]:
        """Times between its beginning and end at which it jumps or bends, in s."""
        return tuple(dict.fromkeys(time for time, _ in self.points if 0 < time < self.end))

    @property
    def end(self) -> float:
        """When it ends, in s."""
        return self.points[-1][0]

    @property
    def largest(self) -> float:
        """The largest load at any time, in N."""
        return self.factor * max(load for _, load in self.points)

    @property
    def least(self) -> float:
        """The least load at any time, in N."""
        return self.factor * min(load for _, load in self.points)

    def before(self, time: float) -> float:
        """Return the load as `time` (s) is reached: at a jump, the load before it."""
        return self._at(time, bisect_left(self.points, time, key=itemgetter(0)))

    def after(self, time: float) -> float:
        """Return the load from `time` (s) on: at a jump, the load after it."""
        return self._at(time, bisect_right(self.points, time, key=itemgetter(0)))

    def mean(self, begin: float, end: float) -> float:
        """Return the mean load between two times (s) with no edge between them, in N."""
        return 0.5 * (self.after(begin) + self.before(end))

    def _at(self, time: float, index: int) -> float:
        """Return the load at a time on the line that leads to a point."""
        index = min(max(index, 1), len(self.points) - 1)
        (begin, first), (end, last) = self.points[index - 1 : index + 1]
        load = last
        if time < end and first != last:
            load = first + (time - begin) / (end - begin) * (last - first)
        return self.factor * load


def _read(file: Path) -> Sequence[dict[str, float]]:
    rows = read_pairs(file, "time in s and load in N")
    idle = np.flatnonzero(rows[:, 1] <= 0)
    if len(idle):
        raise ValueError(
            f"{file} has a load of {rows[idle[0], 1]:g} N at {rows[idle[0], 0]:g} s: each must be "
            f"greater than 0; {PAUSE}"
        )
    return [{"at": time, "normal": load} for time, load in rows.tolist()]
