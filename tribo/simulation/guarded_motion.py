"""A motion, and how it exposes the bodies, held to their contract at every call."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.contact import WearCompliance
from tribo.core.errors import BadValues, PluginError
from tribo.core.grid import Grid
from tribo.motion.cycle import Position, Speeds
from tribo.motion.exposure import Exposure, Passing, Stationary, Track
from tribo.motion.kinematics import Kinematics
from tribo.simulation.guard import Guard

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
        return tuple(
            Position(share, self._speeds(position.speeds), self._reach(position.reach, grid))
            for share, position in zip(shares, answer, strict=True)
        )

    def _reach(self, answer: Array | None, grid: Grid) -> Array | None:
        if answer is None:
            return None
        what = "a sliding distance of each row"
        reach = self.field(what, answer, grid.cells[1:])
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

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> dict[str, GuardedExposure]:
        """Return how each body meets the contact."""
        answer = self.ask(self.component.exposures, grid, bodies)
        if not isinstance(answer, Mapping) or set(answer) != set(bodies):
            given = list(answer) if isinstance(answer, Mapping) else f"a {type(answer).__name__}"
            raise PluginError(
                f"{self} gave exposures of {given}, but the bodies are {list(bodies)}"
            )
        for body, exposure in answer.items():
            if not isinstance(exposure, Exposure):
                raise self.wrong(exposure, f"as exposure of body {body!r}")
        return {body: GuardedExposure(answer[body], self.component, body, grid) for body in bodies}

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

    def limitation(
        self, half_width_x: float, depth: float, approach: float, volume_ratio: float
    ) -> str | None:
        """Return why its averaging no longer holds, if so; see `Kinematics.limitation`."""
        asked = self.component.limitation
        answer = self.ask(asked, half_width_x, depth, approach, volume_ratio)
        if not isinstance(answer, str | None):
            raise self.wrong(answer, "as its limitation")
        return answer


class GuardedExposure(Guard[Kinematics]):
    """An exposure of which every answer is checked; what is wrong names the motion it is from.

    Tribo's own are linear in finite rates, and so are asked themselves.
    """

    def __init__(self, exposure: Exposure, motion: Kinematics, body: str, grid: Grid) -> None:
        super().__init__(motion)
        self.swept = exposure.swept
        self.shape_stays = exposure.shape_stays
        self._asked = exposure
        self._whose = body
        self._cells = grid.cells
        self._repeats = grid.period is not None
        self.starts = exposure.starts
        self.averaged = exposure.averaged
        self.rows = exposure.rows or grid.cells[0]
        self._own = (self.rows, grid.cells[1])
        if type(exposure) in (Stationary, Track, Passing):
            lengths = np.asarray(getattr(exposure, "length", 1.0))
            if not np.all((lengths > 0) & np.isfinite(lengths)):
                raise BadValues(f"{self} has a track of length {lengths!s:.60} m")
            for name in ("average", "envelope", "volume", "compliance"):
                setattr(self, name, getattr(exposure, name))

    def __str__(self) -> str:
        """Return what messages call it."""
        return f"{super().__str__()}, for body {self._whose!r},"

    def check_starts(self, positions: int) -> None:
        """Hold `starts` to one row for each position, in the body's rows, the middle one midway."""
        if self.starts is None:
            return
        beyond = self.rows - self._cells[0]
        starts = [int(self.number("a start", start)) for start in self.starts]
        if self._repeats and beyond != 0:
            raise PluginError(
                f"{self} has {self.rows} rows where the contact repeats with the window; it needs "
                f"the window's {self._cells[0]}, with starts that are counted round"
            )
        within = self._repeats or (min(starts) >= 0 and max(starts) <= beyond)
        if (
            len(starts) != positions
            or not within
            or starts[positions // 2] % self.rows != beyond // 2
        ):
            raise PluginError(
                f"{self} has starts {starts!s:.60} of {len(starts)} positions on {self.rows} rows; "
                f"one is needed for each of {positions} positions, from 0 to {beyond}, with "
                f"{beyond // 2} in the middle"
            )

    def average(self, rate: Array) -> Array:
        """Return the rate each point of the body sees."""
        asked = readonly(rate)
        answer = self.ask(self._asked.average, asked)
        if answer is asked and (self.starts is not None or not self.swept):
            # What was held to the contract as a law's answer.
            return asked
        if self.starts is not None:
            if not np.array_equal(self.field("an average", answer, self._cells), asked):
                raise PluginError(
                    f"{self} gave an average that is not the rate itself, which is laid on the "
                    "body at each of its starts"
                )
            return asked
        # Rates of a state may be negative; the mean of what is nowhere negative is not either.
        least = 0.0 if np.min(rate) >= 0 else -np.inf
        return self.field("an average", answer, self._own, at_least=least)

    def envelope(self, field: Array) -> Array:
        """Return the largest value each point of the body meets, on its own surface."""
        answer = self.ask(self._asked.envelope, readonly(field))
        return self.field("an envelope", answer, self._own)

    def volume(self, depth: Array) -> float:
        """Return the volume of a depth on the body's own surface, in m³."""
        return self.number("a volume", self.ask(self._asked.volume, readonly(depth)))

    def compliance(self, derivative: Array, pressure: Array) -> WearCompliance | None:
        """Return the wear per metre of sliding as a compliance, or None."""
        asked = readonly(derivative)
        answer = self.ask(self._asked.compliance, asked, readonly(pressure))
        if answer is None:
            return None
        if not isinstance(answer, WearCompliance):
            raise self.wrong(answer, "instead of a WearCompliance")
        local = answer.local
        if local is not asked:
            local = self.field("a local compliance", local, self._cells, at_least=0.0)
        swept = self.field("a swept compliance", answer.swept, self._cells[1:], at_least=0.0)
        return WearCompliance(local, swept)
