"""A motion held to its contract at every call, and how it exposes the bodies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.contact import WearCompliance
from tribo.core.errors import BadValues, PluginError
from tribo.core.grid import Grid
from tribo.guards.guard import Guard
from tribo.motion.cycle import Position, Speeds
from tribo.motion.exposure import Exposure, Passing, Stationary, Track
from tribo.motion.kinematics import Kinematics

SAMPLES = 8
INVERSE = 1e-6
WHOLE = 1e-9


class GuardedMotion(Guard[Kinematics]):
    """A motion of which every answer is checked."""

    def cycle(self, grid: Grid) -> tuple[Position, ...]:
        """Return the positions of a cycle, whose shares add up to 1."""
        answer = self.ask(lambda: tuple(self.component.cycle(grid)))
        if not answer or not all(isinstance(position, Position) for position in answer):
            raise self.wrong(answer, "as positions of its cycle")
        shares = [self.number("a share of the path", position.share) for position in answer]
        if min(shares) < 0 or abs(sum(shares) - 1) > WHOLE:
            raise BadValues(
                f"{self} gave shares of the path that add up to {sum(shares):g}, not to 1"
            )
        rests = [self.number("a time at rest", position.rest) for position in answer]
        if min(rests) < 0:
            raise BadValues(f"{self} gave a time at rest of {min(rests):g} s/m")
        return tuple(
            Position(share, self._speeds(position.speeds), self._reach(position.reach, grid), rest)
            for share, rest, position in zip(shares, rests, answer, strict=True)
        )

    def _reach(self, answer: Array | None, grid: Grid) -> Array | None:
        if answer is None:
            return None
        what = "a sliding distance of each point"
        reach = self.field(what, answer, grid.cells)
        if np.min(reach) <= 0:
            raise BadValues(f"{self} gave {what} of which one is not positive")
        return reach

    def _speeds(self, answer: Speeds | None) -> Speeds | None:
        if answer is None:
            return None
        what = "speeds of a cycle with their shares of the distance"
        pairs = self.field(what, answer, (self.ask(len, answer), 2))
        if np.min(pairs) < 0:
            raise BadValues(f"{self} gave {what} of which one is negative")
        total = float(sum(pairs[:, 1]))
        if abs(total - 1) > WHOLE:
            raise BadValues(
                f"{self} gave shares of the distance that add up to {total:g}, not to 1"
            )
        return [(float(speed), float(share)) for speed, share in pairs]

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> dict[str, Exposure]:
        """Return how each body meets the contact; exposures not tribo's own are tried once."""
        answer = self.ask(self.component.exposures, grid, bodies)
        if not isinstance(answer, Mapping) or set(answer) != set(bodies):
            given = list(answer) if isinstance(answer, Mapping) else f"a {type(answer).__name__}"
            raise PluginError(
                f"{self} gave exposures of {given}, but the bodies are {list(bodies)}"
            )
        for body, exposure in answer.items():
            if not isinstance(exposure, Exposure):
                raise self.wrong(exposure, f"as exposure of body {body!r}")
            lengths = np.asarray(getattr(exposure, "length", 1.0))
            if not np.all((lengths > 0) & np.isfinite(lengths)):
                raise BadValues(f"{self} has a track of length {lengths!s:.60} m for body {body!r}")
            if type(exposure) not in (Stationary, Track, Passing):
                self._try(exposure, f"for body {body!r}", grid)
        return {body: answer[body] for body in bodies}

    def _try(self, exposure: Exposure, where: str, grid: Grid) -> None:
        """Hold an exposure to its contract, which is the same at each call."""
        rate, own = (
            readonly(np.ones(grid.cells)),
            (self.ask(getattr, exposure, "rows"), grid.cells[1]),
        )
        mean = self.ask(exposure.average, rate)
        if exposure.starts is None:
            mean = self.field(f"an average {where}", mean, own, at_least=0.0)
        elif not np.array_equal(mean, rate):
            raise PluginError(
                f"{self} gave an average {where} that is not the rate itself, which is laid on the "
                "body at each of its starts"
            )
        passing = rate if exposure.starts is None else readonly(np.ones(own))
        self.field(f"an envelope {where}", self.ask(exposure.envelope, passing), own)
        self.number(f"a volume {where}", self.ask(exposure.volume, readonly(mean)))
        given = self.ask(exposure.compliance, rate, rate)
        if given is None:
            return
        if not isinstance(given, WearCompliance):
            raise self.wrong(given, "instead of a WearCompliance")
        self.field(f"a local compliance {where}", given.local, grid.cells, at_least=0.0)
        self.field(f"a swept compliance {where}", given.swept, grid.cells[1:], at_least=0.0)

    def check_starts(self, exposure: Exposure, positions: int, grid: Grid) -> None:
        """Hold `starts` to one row for each position, in the body's rows, the middle one midway."""
        if exposure.starts is None:
            return
        rows, window = exposure.rows, grid.cells[0]
        starts = [int(self.number("a start", start)) for start in exposure.starts]
        if grid.period is not None and rows != window:
            raise PluginError(
                f"{self} has {rows} rows where the contact repeats with the window; it needs "
                f"the window's {window}, with starts that are counted round"
            )
        beyond = rows - window
        within = grid.period is not None or (min(starts) >= 0 and max(starts) <= beyond)
        midway = len(starts) == positions and starts[positions // 2] % rows == beyond // 2
        if not (within and midway):
            raise PluginError(
                f"{self} has starts {starts!s:.60} of {len(starts)} positions on {rows} rows; "
                f"one is needed for each of {positions} positions, from 0 to {beyond}, with "
                f"{beyond // 2} in the middle"
            )

    def end_time(self, distance: float | None) -> float:
        """Return when the motion ends, or has slid `distance` (m) if that is sooner, in s."""
        end = self.number("an end", self.ask(getattr, self.component, "end_time"))
        if distance is not None:
            end = min(end, self.time_at(distance))
        if end <= 0:
            raise PluginError(f"{self} ends at {end:g} s, before it begins")
        return end

    def edges(self) -> list[float]:
        """Return the times at which its speed jumps, in s."""
        answer = self.ask(lambda: list(self.component.edges))
        return [self.number("a time at which its speed jumps", time) for time in answer]

    def distance_at(self, time: float) -> float:
        """Return the sliding distance from 0 to `time` (s), in m."""
        return self.number(f"a distance at {time:g} s", self.ask(self.component.distance_at, time))

    def time_at(self, distance: float) -> float:
        """Return the time at which it has slid `distance` (m), in s."""
        return self.number(f"a time at {distance:g} m", self.ask(self.component.time_at, distance))

    def check_distance(self, end: float) -> None:
        """Refuse a distance that does not grow from 0 to `end` (s), or is not `time_at`'s inverse.

        A few times are tried; a run checks the ones it comes to.
        """
        start, total = self.distance_at(0.0), self.distance_at(end)
        if start != 0 or not total > 0:
            raise PluginError(
                f"{self} slides from {start:g} m to {total:g} m; it must slide on from 0"
            )
        for part in range(1, SAMPLES + 1):
            distance = total * part / SAMPLES
            time = self.time_at(distance)
            reached = self.distance_at(time)
            if not (time >= 0 and abs(reached - distance) <= INVERSE * total):
                raise PluginError(
                    f"{self} puts {distance:g} m at {time:g} s, but has slid {reached:g} m by "
                    "then: its time is not the inverse of its distance"
                )

    def check_contact(self, half_width_x: float) -> None:
        """Raise `CaseError` if its averaging makes no sense for the first contact."""
        self.ask(self.component.check_contact, half_width_x)

    def limitation(self, *seen: Any) -> str | None:
        """Return why its averaging no longer holds, if so; see `Kinematics.limitation`."""
        answer = self.ask(self.component.limitation, *seen)
        if not isinstance(answer, str | None):
            raise self.wrong(answer, "as its limitation")
        return answer
