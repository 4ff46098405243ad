"""The normal load, over time and along a stroke: as a case gives it, and as contacts carry it."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import inf
from operator import itemgetter
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np
from pydantic import Discriminator, Tag, field_validator, model_validator

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
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
ByPosition = tuple[float, ...]
"""Loads at the positions of a cycle, in N."""


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


class Place(Table):
    """A place along the stroke, and the load there.

    Examples
    --------
    >>> ends = tribo.Place(at="-5 mm", share=0.8), tribo.Place(at="5 mm", share=1.2)
    >>> [place.share * tribo.Load(normal="10 N", along=ends).normal for place in ends]  # in N
    [8.0, 12.0]
    """

    at: Annotated[float, Quantity("m")]
    """Position of the moving body along x, from the middle of its stroke or path."""
    share: Annotated[float, Quantity("1", above=0)]
    """Load there, as a multiple of `normal`."""


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
    along: tuple[Place, ...] = ()
    """Load along the stroke, with lines in between, where the motion is resolved into positions;
    the same all along if left out."""

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

    @field_validator("along")
    @classmethod
    def _goes_on(cls, along: tuple[Place, ...]) -> tuple[Place, ...]:
        if len(along) == 1:
            raise ValueError(
                "one place is given; give the load at both ends of the stroke at least"
            )
        for before, after in pairwise(place.at for place in along):
            if after <= before:
                raise ValueError(
                    f"places must lie in increasing order, but {1e3 * before:g} mm is followed by "
                    f"{1e3 * after:g} mm"
                )
        return along

    def shares_at(self, places: Array, reach: float) -> tuple[float, ...]:
        """Return a load that changes along the stroke, at `places`, as multiples of `normal`.

        A place, in m from the middle, may lie `reach` (m) beyond the places given; `CaseError` if
        it lies further off.
        """
        at, shares = self._along
        if len(places) == 1:
            change = 100 * (max(shares) / min(shares) - 1)
            raise CaseError(
                f"the load changes by {change:.3g} % along the stroke, which takes a motion in "
                "positions: give a reciprocating motion kinematics.positions, as 33, or leave "
                "load.along out, and wear is off by up to as much",
                "load.along",
            )
        first, last = float(np.min(places)), float(np.max(places))
        if at[0] > first + reach or at[-1] < last - reach:
            raise CaseError(
                f"it goes from {1e3 * at[0]:.4g} to {1e3 * at[-1]:.4g} mm, but the stroke from "
                f"{1e3 * first:.4g} to {1e3 * last:.4g} mm; give the load up to both ends",
                "load.along",
            )
        return tuple(np.interp(places, at, shares).tolist())

    def averaged(self) -> Load:
        """Return about the mean of the load over the places along the stroke, for all of it."""
        if not self.along:
            return self
        at, shares = self._along
        return self._times(float(np.trapezoid(shares, at)) / (at[-1] - at[0]))

    def in_the_middle(self) -> Load:
        """Return the load in the middle of the stroke, for all of it."""
        return self._times(float(np.interp(0.0, *self._along))) if self.along else self

    def _times(self, share: float) -> Load:
        if isinstance(self.normal, float):
            return Load(normal=share * self.normal)
        return Load(
            normal=tuple(
                stage.model_copy(update={"normal": share * stage.normal}) for stage in self.normal
            )
        )

    @property
    def _along(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Places along the stroke, in m, and the shares there."""
        return tuple(p.at for p in self.along), tuple(p.share for p in self.along)

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
        """Return the load in a few stages, each held at the mean of the stages that it replaces."""
        if isinstance(self.normal, float) or len(self.normal) <= FEW:
            return self
        times, loads = np.array(self.points).T
        ends, lasted = times[1:], np.diff(times)
        carried = lasted * (0.5 * (loads[:-1] + loads[1:]))
        # At a jump no time passes.
        ends, carried = ends[lasted > 0], carried[lasted > 0]
        firsts = np.arange(0, len(carried), -(-len(carried) // FEW))
        until = ends[[*(firsts[1:] - 1), -1]]
        normal = np.add.reduceat(carried, firsts) / np.diff([0.0, *until])
        stages = zip(until.tolist(), normal.tolist(), strict=True)
        return self.model_copy(
            update={"normal": tuple(Stage(until=time, normal=load) for time, load in stages)}
        )


@dataclass(frozen=True)
class Loads:
    """The normal load over time, at each position of a cycle.

    Its `points` are as in `Load.points`. `shares` has the load factor at each position, relative to
    the load at a point, `weights` the part of the path of a cycle there.
    """

    points: tuple[tuple[float, float], ...]
    shares: tuple[float, ...]
    weights: tuple[float, ...]

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
        """The largest load at any time and position, in N."""
        return max(self.shares) * max(load for _, load in self.points)

    @property
    def least(self) -> float:
        """The least load at any time and position, in N."""
        return min(self.shares) * min(load for _, load in self.points)

    @cached_property
    def _constant(self) -> ByPosition | None:
        """The loads where they never change."""
        load = self.points[0][1]
        steady = all(other == load for _, other in self.points)
        return tuple(share * load for share in self.shares) if steady else None

    def before(self, time: float) -> ByPosition:
        """Return the loads as `time` (s) is reached: at a jump, the loads before it."""
        return self._constant or self._at(time, bisect_left(self.points, time, key=itemgetter(0)))

    def after(self, time: float) -> ByPosition:
        """Return the loads from `time` (s) on: at a jump, the loads after it."""
        return self._constant or self._at(time, bisect_right(self.points, time, key=itemgetter(0)))

    def mean(self, begin: float, end: float) -> ByPosition:
        """Return the mean loads between two times (s) with no edge between them."""
        if self._constant:
            return self._constant
        pairs = zip(self.after(begin), self.before(end), strict=True)
        return tuple(0.5 * (first + last) for first, last in pairs)

    def over_cycle(self, loads: ByPosition) -> float:
        """Return the mean of `loads` over the path of a cycle, in N."""
        if min(loads) == max(loads):
            return loads[0]
        return sum(weight * load for weight, load in zip(self.weights, loads, strict=True))

    def _at(self, time: float, index: int) -> ByPosition:
        """Return the loads at a time on the line that leads to a point."""
        index = min(max(index, 1), len(self.points) - 1)
        (begin, first), (end, last) = self.points[index - 1 : index + 1]
        load = last
        if time < end and first != last:
            load = first + (time - begin) / (end - begin) * (last - first)
        return tuple(share * load for share in self.shares)


def _read(file: Path) -> Sequence[dict[str, float]]:
    rows = read_pairs(file, "time in s and load in N")
    idle = np.flatnonzero(rows[:, 1] <= 0)
    if len(idle):
        raise ValueError(
            f"{file} has a load of {rows[idle[0], 1]:g} N at {rows[idle[0], 0]:g} s: each must be "
            f"greater than 0; {PAUSE}"
        )
    return [{"at": time, "normal": load} for time, load in rows.tolist()]
