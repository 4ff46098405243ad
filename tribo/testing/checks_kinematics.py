"""What every motion must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import Any

import numpy as np

from tribo.config.stop import Stop
from tribo.core.arrays import Array
from tribo.core.contact import WearCompliance
from tribo.core.grid import Grid
from tribo.motion.exposure import Exposure
from tribo.testing import samples
from tribo.testing.checks_calls import Exercise, call_checks
from tribo.testing.checks_config import has_unit
from tribo.testing.compare import expect_array, expect_close
from tribo.testing.subject import Subject, fact, require

GRID = samples.GRID
_PARTS = np.linspace(0.0, 1.0, 201)


def _inputs(subject: Subject, motion: Any, number: int) -> dict[str, Array]:
    pattern = samples.pattern(GRID.cells) + number
    return {"rate": 1e-7 * pattern, "derivative": 1e-16 * pattern, "pressure": 1e9 * pattern}


def _call(motion: Any, inputs: Any) -> Mapping[str, Any]:
    answers: dict[str, Any] = {"path": [motion.distance_at(p * motion.end_time) for p in _PARTS]}
    for name, exposure in motion.exposures(GRID, samples.BODIES).items():
        average = exposure.average(inputs["rate"])
        answers[name] = {
            "volume": exposure.volume(average),
            # Copies, for identity is allowed: a stationary point sees its own rate.
            "average": np.array(average),
            "envelope": np.array(exposure.envelope(inputs["rate"])),
            "compliance": exposure.compliance(inputs["derivative"], inputs["pressure"]),
        }
    return answers


EXERCISE = Exercise(_inputs, _call)


def _exposures(subject: Subject, grid: Grid = GRID) -> Mapping[str, Exposure]:
    exposures: Mapping[str, Exposure] = subject.make().exposures(grid, samples.BODIES)
    return exposures


def _without_compliance(subject: Subject) -> str | None:
    one = np.ones(GRID.cells)
    none = all(e.compliance(one, one) is None for e in _exposures(subject).values())
    return "its exposures give no compliance" if none else None


def _without_cycles(subject: Subject) -> str | None:
    given = has_unit(subject.config, "Hz")
    return None if len(given) == 1 else "its configuration has no frequency"


@fact
def motion_ends(subject: Subject) -> None:
    """The duration and the path slid by its end are positive and finite."""
    motion = subject.make()
    for what, value in (
        ("duration", motion.end_time),
        ("distance(duration)", motion.distance_at(motion.end_time)),
    ):
        require(value > 0 and isfinite(value), f"{what} is {value!r}; it must be positive, finite")


@fact
def path_begins_at_zero(subject: Subject) -> None:
    """Nothing has been slid at time 0."""
    start = subject.make().distance_at(0.0)
    require(start == 0, f"distance(0) is {start!r} m; it must be 0")


@fact
def path_never_shrinks(subject: Subject) -> None:
    """The path slid never decreases, also where the motion turns round."""
    motion = subject.make()
    # Whole durations, and closely over the first hundredth, where cycles are resolved.
    for last in (motion.end_time, 0.01 * motion.end_time):
        path = np.array([motion.distance_at(part * last) for part in _PARTS])
        at = int(np.argmin(np.diff(path)))
        require(
            path[at + 1] >= path[at],
            f"the path shrinks from {path[at]:.6g} m to {path[at + 1]:.6g} m between "
            f"{_PARTS[at] * last:.6g} s and {_PARTS[at + 1] * last:.6g} s",
        )


@fact
def time_inverts_distance(subject: Subject) -> None:
    """The path slid by time(s) is s."""
    motion = subject.make()
    total = motion.distance_at(motion.end_time)
    for part in _PARTS:
        needed = part * total
        time = motion.time_at(needed)
        found = motion.distance_at(time)
        require(
            abs(found - needed) <= 1e-9 * total,
            f"time({needed:.6g} m) is {time:.6g} s, by when {found:.6g} m are slid",
        )


@fact(unless=_without_cycles)
def cycles_add_up(subject: Subject) -> None:
    """N cycles slide N times as far as one, from wherever they begin."""
    motion = subject.make()
    period = 1 / has_unit(subject.config, "Hz")[0]
    one = motion.distance_at(period)
    for start in (0.0, 0.3 * period):
        for count in (2, 7):
            found = motion.distance_at(start + count * period) - motion.distance_at(start)
            require(
                abs(found - count * one) <= 1e-9 * count * one,
                f"{count} cycles from {start:.4g} s slide {found:.9g} m, one slides {one:.9g} m",
            )


@fact
def every_body_is_exposed(subject: Subject) -> None:
    """There is one exposure for each body of the case, by its name, and no other."""
    exposures = _exposures(subject)
    require(
        set(exposures) == set(samples.BODIES),
        f"exposures of {sorted(exposures)} for the bodies {sorted(samples.BODIES)}",
    )
    for name, exposure in exposures.items():
        require(
            isinstance(exposure, Exposure), f"{name!r} has a {type(exposure).__name__}, no Exposure"
        )


@fact
def body_fields_fit_the_window(subject: Subject) -> None:
    """Averages and envelopes have one shape, which broadcasts to the window's, and are finite."""
    rate = samples.hertz_pressure(GRID)
    for name, exposure in _exposures(subject).items():
        average = exposure.average(rate)
        shape = np.shape(average)
        fits = len(shape) == 2 and all(n in (1, m) for n, m in zip(shape, GRID.cells, strict=False))
        require(fits, f"{name!r}: average has shape {shape}, which does not fit {GRID.cells}")
        expect_array(f"{name!r}: average", average, shape)
        expect_array(f"{name!r}: envelope", exposure.envelope(rate), shape)


@fact
def what_passes_is_swept(subject: Subject) -> None:
    """A body whose points share the wear along x says that it is swept; one that stays does not."""
    rate = samples.hertz_pressure(GRID)
    for name, exposure in _exposures(subject).items():
        average = exposure.average(rate)
        if np.shape(average) != GRID.cells:
            require(exposure.swept, f"{name!r} has one average for all x; set swept = True")
        elif np.array_equal(average, rate):
            require(not exposure.swept, f"{name!r} keeps its own rate at each x, but is swept")


@fact
def worn_volume_is_conserved(subject: Subject) -> None:
    """The volume of an average is the integral of the rate over the contact."""
    for rate in (1e-7 * samples.pattern(GRID.cells), samples.hertz_pressure(GRID)):
        needed = float(np.sum(rate)) * GRID.cell_area
        for name, exposure in _exposures(subject).items():
            found = exposure.volume(exposure.average(rate))
            require(
                abs(found - needed) <= 1e-9 * needed,
                f"body {name!r} loses {found:.6g} m³ per metre where {needed:.6g} m³ is worn away "
                f"({found / needed:.4g} times as much)",
            )


@fact
def averages_are_linear(subject: Subject) -> None:
    """The average of a sum is the sum of averages, and none is negative."""
    one, other = samples.pattern(GRID.cells), samples.hertz_pressure(GRID) / samples.PEAK
    for name, exposure in _exposures(subject).items():
        both = exposure.average(2 * one + 3 * other)
        parts = 2 * exposure.average(one) + 3 * exposure.average(other)
        expect_close(f"{name!r}: average of a sum", both, parts, 1e-12)
        require(np.min(both) >= 0, f"{name!r}: a rate that is nowhere negative averages to less")


@fact
def finer_window_averages_the_same(subject: Subject) -> None:
    """Cutting each cell in four changes no average."""
    fine = Grid(GRID.size, (2 * GRID.cells[0], 2 * GRID.cells[1]))
    rate = samples.hertz_pressure(GRID)
    coarse, finer = _exposures(subject), _exposures(subject, fine)
    for name in samples.BODIES:
        found = np.broadcast_to(finer[name].average(_split(rate)), fine.cells)
        needed = _split(np.broadcast_to(coarse[name].average(rate), GRID.cells))
        expect_close(f"{name!r}: average on cells of half the size", found, needed, 1e-9)


@fact
def envelope_covers_the_field(subject: Subject) -> None:
    """No point of a body meets less than what it meets now, and meeting it twice adds nothing."""
    field = samples.pattern(GRID.cells)
    for name, exposure in _exposures(subject).items():
        envelope = np.broadcast_to(exposure.envelope(field), GRID.cells)
        require(np.all(envelope >= field), f"{name!r}: the envelope lies below the field somewhere")
        require(
            np.max(envelope) == np.max(field),
            f"{name!r}: the envelope reaches {np.max(envelope):.6g}, the field {np.max(field):.6g}",
        )
        again = np.broadcast_to(exposure.envelope(envelope), GRID.cells)
        expect_close(f"{name!r}: envelope of an envelope", again, envelope, 0.0)


@fact(unless=_without_compliance)
def compliance_is_the_average_of_a_linear_law(subject: Subject) -> None:
    """For a law linear in pressure the compliance is exact, and it is never negative."""
    pressure = samples.hertz_pressure(GRID)
    slope = np.full(GRID.cells, 3e-16)
    for name, exposure in _exposures(subject).items():
        compliance = exposure.compliance(slope, pressure)
        if compliance is None:
            continue
        require(isinstance(compliance, WearCompliance), f"{name!r}: no WearCompliance was given")
        local = expect_array(f"{name!r}: local compliance", compliance.local, GRID.cells)
        swept = expect_array(f"{name!r}: swept compliance", compliance.swept, GRID.cells[1:])
        least = min(np.min(local), np.min(swept))
        require(least >= 0, f"{name!r}: the compliance falls to {least:.3g}")
        needed = np.broadcast_to(exposure.average(slope * pressure), GRID.cells)
        found = compliance.depth(pressure, GRID.spacing[0])
        expect_close(f"{name!r}: depth of the compliance", found, needed, 1e-9)


@fact
def limitation_is_said_in_words(subject: Subject) -> None:
    """Up to some size of contact there is no limitation; beyond, there is one, in words."""
    motion = subject.make()
    said = [motion.limitation(GRID, half_width) for half_width in np.geomspace(1e-6, 10.0, 50)]
    for text in said:
        plain = text is None or (isinstance(text, str) and bool(text.strip()))
        require(plain, f"limitation gave {text!r}; a sentence or None is needed")
    first = next((number for number, text in enumerate(said) if text is not None), len(said))
    require(None not in said[first:], "a larger contact is less limited than a smaller one")


@fact
def runs_a_case(subject: Subject) -> None:
    """In a small case each body loses just what its law says."""
    motion = subject.make()
    distance = min(3.0, 0.999 * motion.distance_at(motion.end_time))
    stop = Stop(distance=distance)
    samples.expect_volume_balance(samples.small_model(subject, kinematics=motion, stop=stop))


CHECKS = (
    *call_checks(EXERCISE),
    motion_ends,
    path_begins_at_zero,
    path_never_shrinks,
    time_inverts_distance,
    cycles_add_up,
    every_body_is_exposed,
    body_fields_fit_the_window,
    what_passes_is_swept,
    worn_volume_is_conserved,
    averages_are_linear,
    finer_window_averages_the_same,
    envelope_covers_the_field,
    compliance_is_the_average_of_a_linear_law,
    limitation_is_said_in_words,
    runs_a_case,
)


def _split(field: Array) -> Array:
    return np.repeat(np.repeat(field, 2, axis=0), 2, axis=1)
