"""A motion held to its contract at every call, and how it exposes the bodies."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.contact import WearCompliance
from tribo.core.errors import BadValues, PluginError
from tribo.core.grid import Grid
from tribo.core.rounding import ROUND_OFF, SAME
from tribo.effects.effect import Effect
from tribo.guards.guard import Guard
from tribo.motion.cycle import Position, Speeds
from tribo.motion.exposure import Exposure, Passing, Stationary, Track
from tribo.motion.kinematics import Kinematics

PARTS = tuple(part / 8 for part in range(1, 9))
"""Of a run, at which its path is tried before it begins: eighths, within which stages are seen."""


class GuardedMotion(Guard[Kinematics]):
    """A motion whose answers are checked."""

    def cycle(self, grid: Grid) -> tuple[Position, ...]:
        """Return the positions of a cycle, whose shares add up to 1."""
        positions = []
        for each in self.ask(lambda: tuple(self.component.cycle(grid))):
            position = self.typed(each, Position, "a position of its cycle")
            reach = position.reach
            positions.append(
                Position(
                    self.number("share", position.share),
                    self._speeds(position.speeds),
                    None if reach is None else self.array("reach", reach, grid.cells),
                    self.number("rest", position.rest),
                    self._heading(position.heading, grid),
                )
            )
        self._add_up("share", [position.share for position in positions])
        return tuple(positions)

    def effects(self) -> tuple[Effect, ...]:
        """Return the effects that it brings along."""
        answer = self.ask(lambda: tuple(self.component.effects()))
        return tuple(self.typed(each, Effect, "an effect of its own") for each in answer)

    def _heading(self, answer: Any, grid: Grid) -> tuple[Array, Array]:
        pair = self.typed(self.ask(tuple, answer), tuple, "a heading")
        x, y = (self.array("heading", part, np.shape(part)) for part in pair)
        if np.any(np.abs(np.hypot(x, y) - 1) > SAME):
            raise BadValues(f"{self} gave a 'heading' that is no vector of length 1")
        return x, y

    def _speeds(self, answer: Speeds | None) -> Speeds | None:
        if answer is None:
            return None
        pairs = self.array("speeds", answer, (self.ask(len, answer), 2))
        self._add_up("speeds", pairs[:, 1])
        return [(float(speed), float(share)) for speed, share in pairs]

    def _add_up(self, name: str, shares: Iterable[float]) -> None:
        total = float(sum(shares))
        if abs(total - 1) > ROUND_OFF:
            raise BadValues(f"{self} gave {name!r} with shares that add up to {total:g}, not to 1")

    def exposures(self, grid: Grid, bodies: Sequence[str], positions: int) -> dict[str, Exposure]:
        """Return how each body meets the contact; exposures not tribo's own are tried once."""
        answer = self.ask(self.component.exposures, grid, bodies)
        if not isinstance(answer, Mapping) or set(answer) != set(bodies):
            given = list(answer) if isinstance(answer, Mapping) else f"a {type(answer).__name__}"
            raise PluginError(
                f"{self} gave exposures of {given}, but the bodies are {list(bodies)}"
            )
        for body, exposure in answer.items():
            self.typed(exposure, Exposure, f"the exposure of body {body!r}")
            where = f" for body {body!r}"
            length = np.asarray(getattr(exposure, "length", 1.0))
            self.array("length", length, length.shape, where)
            if exposure.starts is not None:
                self._check_starts(exposure, exposure.starts, positions, grid)
                across = exposure.across
                if across is not None:
                    self.array("across", across, (positions,), where)
            elif exposure.swept and exposure.rows != 1:
                raise PluginError(
                    f"{self} has points of body {body!r} pass through the contact, but keeps them "
                    f"on {exposure.rows} rows without starts, where they would not move: average "
                    "them on one row, or give starts"
                )
            if type(exposure) not in (Stationary, Track, Passing):
                self._try(exposure, where, grid, positions // 2)
        return {body: answer[body] for body in bodies}

    def _try(self, exposure: Exposure, where: str, grid: Grid, position: int) -> None:
        """Hold an exposure to its contract, which is the same at each call."""
        x, y = (axis / length for axis, length in zip(grid.mesh, grid.size, strict=True))
        rate = readonly(1.5 + x + 0.5 * y)
        own = self.ask(getattr, exposure, "rows"), grid.cells[1]
        passing = self.ask(exposure.lay, rate, position)
        mean = self.ask(exposure.average, rate)
        if not exposure.averaged and not np.array_equal(mean, rate):
            rule = "of a body that is not averaged along a track it must be the rate itself"
            raise self.bad("average", "not the rate itself", where, rule)
        mean = self.ask(exposure.lay, mean, position)
        mean = self.array("average", mean, own, where)
        envelope = self.ask(exposure.envelope, readonly(passing))
        envelope = self.array("envelope", envelope, own, where)
        if np.any(envelope < passing) or np.max(envelope) != np.max(passing):
            rule = "it must be the largest value that each point meets"
            raise self.bad("envelope", "not the largest value", where, rule)
        volume = self.number("volume", self.ask(exposure.volume, mean), where)
        worn = float(np.sum(rate)) * grid.cell_area
        if abs(volume - worn) > SAME * worn:
            rule = f"it must be {worn:.6g} m³, as of the rate"
            raise self.bad("volume", f"{volume:.6g} m³ of an average", where, rule)
        given = self.ask(exposure.compliance, rate, rate)
        if given is not None:
            self.typed(given, WearCompliance, f"a compliance{where}")
            self.array("local", given.local, grid.cells, where)
            self.array("swept", given.swept, grid.cells[1:], where)

    def _check_starts(
        self, exposure: Exposure, given: Sequence[int], positions: int, grid: Grid
    ) -> None:
        """Hold `starts` to one row for each position, in the body's rows, the middle one midway."""
        rows, beyond = exposure.rows, exposure.rows - grid.cells[0]
        starts = [int(self.number("starts", start)) for start in given]
        # In a window that repeats rows are counted round.
        within = beyond == 0 if grid.period else 0 <= min(starts) <= max(starts) <= beyond
        midway = len(starts) == positions and starts[positions // 2] % rows == beyond // 2
        if not (within and midway):
            raise PluginError(
                f"{self} has starts {starts!s:.60} of {len(starts)} positions on {rows} rows; "
                f"one is needed for each of {positions} positions, from 0 to {beyond}, with "
                f"{beyond // 2} in the middle, and as many rows as a window that repeats"
            )

    def end_time(self, distance: float | str | None) -> float:
        """Return when the motion ends, or has slid `distance` if that is sooner, in s."""
        end = self.number("end_time", self.ask(getattr, self.component, "end_time"))
        if distance is None:
            return end
        return min(end, self.time_at(self.ask(self.component.metres, distance)))

    def moment(self, given: float | str) -> float:
        """Return a time in s, which may be given as text by the path slid then; inf if never."""
        if not isinstance(given, str):
            return given
        path = self.ask(self.component.metres, given)
        time = self.time_at(path)
        return time if self.distance_at(time) >= path * (1 - SAME) else np.inf

    def edges(self) -> list[float]:
        """Return the times at which its speed jumps, in s."""
        times = self.ask(lambda: list(self.component.edges))
        return [self.number("edges", time) for time in times]

    def distance_at(self, time: float) -> float:
        """Return the sliding distance from 0 to `time` (s), in m."""
        distance = self.ask(self.component.distance_at, time)
        return self.number("distance_at", distance, f" at {time:g} s")

    def time_at(self, distance: float) -> float:
        """Return the time at which it has slid `distance` (m), in s."""
        time = self.ask(self.component.time_at, distance)
        return self.number("time_at", time, f" at {distance:g} m")

    def check_distance(self, end: float, parts: Sequence[float] = PARTS) -> None:
        """Refuse a distance that does not grow from 0 to `end` (s), or is not `time_at`'s inverse.

        Times are tried that are `parts` of the end; a run checks its own times.
        """
        start, total = self.distance_at(0.0), self.distance_at(end)
        if start != 0 or not total > 0:
            raise PluginError(
                f"{self} slides from {start:g} m to {total:g} m; it must slide on from 0"
            )
        before = start
        for time in (end * part for part in parts):
            distance = self.distance_at(time)
            if distance < before:
                raise PluginError(
                    f"{self} slides back from {before:.6g} m to {distance:.6g} m before {time:g} s"
                )
            first = self.time_at(distance)
            reached = self.distance_at(first)
            if not (0 <= first <= time + SAME * end and abs(reached - distance) <= SAME * distance):
                raise PluginError(
                    f"{self} slides {distance:.9g} m in {time:.9g} s, and puts that at {first:.9g} "
                    f"s, by when it has slid {reached:.9g} m: its time is not the inverse of its "
                    "distance, the first time there"
                )
            before = distance
