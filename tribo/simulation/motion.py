"""Ask the kinematics, and hold what it answers to the contract."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tribo.core.errors import PluginError, located
from tribo.core.grid import Grid
from tribo.motion.exposure import Exposure
from tribo.motion.kinematics import Kinematics
from tribo.simulation.answers import number
from tribo.simulation.calling import calling, named
from tribo.simulation.exposed import CheckedExposure

Motion = Kinematics

SAMPLES = 8
INVERSE = 1e-6
WHOLE = 1e-9


def exposures(motion: Motion, grid: Grid, bodies: Sequence[str]) -> dict[str, Exposure]:
    """Return how each body meets the contact; what the exposures answer is checked.

    Raises
    ------
    PluginError
        If there is not just one exposure for each body.
    """
    with calling(motion):
        answer = motion.exposures(grid, bodies)
        if not isinstance(answer, Mapping) or set(answer) != set(bodies):
            given = list(answer) if isinstance(answer, Mapping) else f"a {type(answer).__name__}"
            raise PluginError(
                f"{named(motion)} gave exposures of {given}, but the bodies are {list(bodies)}"
            )
        for body, exposure in answer.items():
            if not isinstance(exposure, Exposure):
                kind = type(exposure).__name__
                raise PluginError(f"{named(motion)} gave a {kind} as exposure of body {body!r}")
        return {body: CheckedExposure(answer[body], motion, body, grid) for body in bodies}


def end_time(motion: Motion, distance: float | None) -> float:
    """Return when the motion ends, or reaches `distance` (m) if that is sooner, in s."""
    with calling(motion):
        duration = motion.end_time
    end = number(named(motion), "an end", duration)
    if distance is not None:
        end = min(end, time_at(motion, distance))
    if end <= 0:
        raise PluginError(f"{named(motion)} ends at {end:g} s, before it begins")
    return end


def path_at(motion: Motion, time: float) -> float:
    """Return the path slid from 0 to `time` (s), in m."""
    with calling(motion):
        answer = motion.distance_at(time)
    return number(named(motion), f"a path at {time:g} s", answer)


def time_at(motion: Motion, distance: float) -> float:
    """Return the time at which the path reaches `distance` (m), in s."""
    with calling(motion):
        answer = motion.time_at(distance)
    return number(named(motion), f"a time at {distance:g} m", answer)


def cycle_speeds(motion: Motion) -> list[tuple[float, float]] | None:
    """Return the speeds of a cycle (m/s) with their shares of the path, if the motion has any."""
    with calling(motion):
        answer = motion.speeds()
        if answer is None:
            return None
        pairs = [(speed, share) for speed, share in answer]
    who = named(motion)
    speeds = [
        (number(who, "a speed of a cycle", speed), number(who, "a share of the path", share))
        for speed, share in pairs
    ]
    if min((min(pair) for pair in speeds), default=-1.0) < 0:
        raise PluginError(
            f"{who} gave no speeds of a cycle, or a negative speed or share: {speeds}"
        )
    total = sum(share for _, share in speeds)
    if abs(total - 1) > WHOLE:
        raise PluginError(f"{who} gave shares of the path that add up to {total:g}, not to 1")
    return speeds


def averaging_limit(
    motion: Motion,
    grid: Grid,
    half_width_x: float,
    depth: float,
    approach: float,
    volume_ratio: float,
) -> str | None:
    """Return why the motion's averaging no longer holds, if so."""
    with calling(motion):
        answer = motion.track_limitation(grid, half_width_x, depth, approach, volume_ratio)
    if not isinstance(answer, str | None):
        raise PluginError(f"{named(motion)} gave a {type(answer).__name__} as its limitation")
    return answer


def check_first_contact(motion: Motion, half_width_x: float) -> None:
    """Raise `CaseError` if the motion's averaging makes no sense for the first contact."""
    with located("kinematics"), calling(motion):
        motion.check_contact(half_width_x)


def check_path(motion: Motion, end: float) -> None:
    """Raise `PluginError` unless the path grows from 0 until `end` (s) and `time` is its inverse.

    A few times are tried; a run checks the ones it comes to.
    """
    who = named(motion)
    start, total = path_at(motion, 0.0), path_at(motion, end)
    if start != 0 or not total > 0:
        raise PluginError(f"{who} slides from {start:g} m to {total:g} m; it must slide on from 0")
    for part in range(1, SAMPLES + 1):
        distance = total * part / SAMPLES
        time = time_at(motion, distance)
        reached = path_at(motion, time)
        if not (time >= 0 and abs(reached - distance) <= INVERSE * total):
            raise PluginError(
                f"{who} puts {distance:g} m at {time:g} s, but has slid {reached:g} m by then: its "
                "time is not the inverse of its distance"
            )
