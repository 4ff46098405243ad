"""The interface of motions: sliding distance over time, and the points that meet the contact."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar

from tribo.component import Component
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.units import is_in, parse
from tribo.motion.cycle import Position
from tribo.motion.exposure import Exposure

if TYPE_CHECKING:
    from tribo.effects.effect import Effect


class Kinematics(Component):
    """A sliding motion along x.

    Examples
    --------
    >>> class Slide(tribo.Kinematics):
    ...     end_time = property(lambda self: 10.0)
    ...     def distance_at(self, time):
    ...         return 0.1 * time
    ...     def exposures(self, grid, bodies):
    ...         return {body: tribo.Stationary(grid) for body in bodies}
    >>> round(Slide().time_at(0.5), 6)  # s until 0.5 m
    5.0
    """

    turns_back: ClassVar[bool] = False
    """Whether it goes to and fro along the track, rather than round it."""

    @property
    @abstractmethod
    def end_time(self) -> float:
        """Time at which the motion ends, in s."""

    @abstractmethod
    def distance_at(self, time: float) -> float:
        """Return the sliding distance from 0 to `time` (s), in m; never decreasing."""

    @property
    def track_extent(self) -> float:
        """Length of the track, in m: the stroke, or once round.

        Infinite, unless overridden: moving points do not return.
        """
        return math.inf

    @property
    def lap(self) -> float:
        """Path of one lap, in m: once round or, to and fro, a full cycle; infinite if laps differ.

        So it is for a motion to and fro, unless overridden.
        """
        return math.inf if self.turns_back else self.track_extent

    def metres(self, path: float | str) -> float:
        """Return a path in m that may be text in m or in laps; `CaseError` if it has no laps."""
        if not isinstance(path, str):
            return path
        if is_in("m", path):
            return parse(path, "m")
        if math.isinf(self.lap):
            raise CaseError(f"{path}: kinematics.type = {self.type!r} has no laps; give m")
        return parse(path, "lap") * self.lap

    def time_at(self, distance: float) -> float:
        """Return the time at which the sliding distance reaches `distance` (m), in s.

        Found by bisection of `distance_at` unless overridden.
        """
        if distance <= 0:
            return 0.0
        low, high = 0.0, self.end_time
        while True:
            middle = 0.5 * (low + high)
            if not low < middle < high:
                return high
            low, high = (middle, high) if self.distance_at(middle) < distance else (low, middle)

    @property
    def edges(self) -> Sequence[float]:
        """Times at which the speed jumps from one stage to the next, in s; steps end there.

        None, unless overridden.
        """
        return ()

    def effects(self) -> Sequence[Effect]:
        """Return effects of the motion, which precede the effects of the case.

        So its numbers are given once in a case: the slip of a fretting contact uses the amplitude.
        """
        return ()

    def cycle(self, grid: Grid) -> Sequence[Position]:
        """Return the positions of a cycle in which the contact is solved.

        One, unless overridden: the average over the cycle is left to the exposures. A result shows
        the middle one. The window `grid` has a `period` where the contact repeats with it.
        """
        return [Position()]

    def coarsened(self, half_width_x: float) -> Kinematics:
        """Return the motion for an estimate: few positions, or an average in place of them.

        Itself, unless overridden. `half_width_x` is the half-width of the first contact, in m.
        """
        return self

    @abstractmethod
    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return how each body meets the contact, by name, in the order of the case.

        Raises
        ------
        CaseError
            If the motion names a body that the case does not have.
        """
