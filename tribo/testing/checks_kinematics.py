"""What every motion must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import Any

import numpy as np

from tribo.config.stop import Stop
from tribo.core.arrays import Array
from tribo.core.contact import WearCompliance
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.motion.exposure import Exposure
from tribo.testing import samples
from tribo.testing.checks import Checks, units_of
from tribo.testing.compare import apply_if, expect_array, expect_close, require
from tribo.testing.samples import BODIES, GRID

_PARTS = np.linspace(0.0, 1.0, 201)
_HALF_WIDTHS = np.geomspace(1e-6, 10.0, 50)


class KinematicsChecks(Checks):
    """Checks of a motion."""

    def _inputs(self, component: Any, number: int) -> dict[str, Array]:
        pattern = samples.pattern(GRID.cells) + number
        return {"rate": 1e-7 * pattern, "derivative": 1e-16 * pattern, "pressure": 1e9 * pattern}

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        end = component.end_time
        answers: dict[str, Any] = {"path": [component.distance_at(part * end) for part in _PARTS]}
        for name, exposure in component.exposures(GRID, BODIES).items():
            average = exposure.average(inputs["rate"])
            answers[name] = {
                "volume": exposure.volume(average),
                # Copies, for identity is allowed: a stationary point sees its own rate.
                "average": np.array(average),
                "envelope": np.array(exposure.envelope(inputs["rate"])),
                "compliance": exposure.compliance(inputs["derivative"], inputs["pressure"]),
            }
        return answers

    def _exposures(self, grid: Grid = GRID) -> Mapping[str, Exposure]:
        exposures: Mapping[str, Exposure] = self._make().exposures(grid, BODIES)
        return exposures

    def motion_ends(self) -> None:
        """The end time and the sliding distance by then are positive and finite."""
        motion = self._make()
        end = motion.end_time
        for what, value in (("end_time", end), ("distance_at(end_time)", motion.distance_at(end))):
            fine = value > 0 and isfinite(value)
            require(fine, f"{what} is {value!r}; it must be positive and finite")

    def path_begins_at_zero(self) -> None:
        """Nothing has been slid at time 0."""
        start = self._make().distance_at(0.0)
        require(start == 0, f"distance_at(0) is {start!r} m; it must be 0")

    def path_never_shrinks(self) -> None:
        """The sliding distance never decreases, also where the motion turns round."""
        motion = self._make()
        # The whole of it, and closely over the first hundredth, where cycles are resolved.
        for last in (motion.end_time, 0.01 * motion.end_time):
            path = np.array([motion.distance_at(part * last) for part in _PARTS])
            at = int(np.argmin(np.diff(path)))
            require(
                path[at + 1] >= path[at],
                f"the sliding distance falls from {path[at]:.6g} m to {path[at + 1]:.6g} m between "
                f"{_PARTS[at] * last:.6g} s and {_PARTS[at + 1] * last:.6g} s",
            )

    def time_inverts_distance(self) -> None:
        """By time_at(s) the motion has slid s."""
        motion = self._make()
        total = motion.distance_at(motion.end_time)
        for needed in _PARTS * total:
            time = motion.time_at(needed)
            found = motion.distance_at(time)
            require(
                abs(found - needed) <= 1e-9 * total,
                f"time_at({needed:.6g} m) is {time:.6g} s, by when {found:.6g} m are slid",
            )

    def cycles_add_up(self) -> None:
        """N cycles slide N times as far as one, from wherever they begin."""
        motion = self._make()
        units = units_of(self._config)
        frequencies = [getattr(self._config, name) for name in units if "Hz" in units[name]]
        apply_if(len(frequencies) == 1, "its configuration has no frequency")
        period = 1 / frequencies[0]
        one = motion.distance_at(period)
        for start in (0.0, 0.3 * period):
            for count in (2, 7):
                found = motion.distance_at(start + count * period) - motion.distance_at(start)
                require(
                    abs(found - count * one) <= 1e-9 * count * one,
                    f"{count} cycles from {start:.4g} s slide {found:.9g} m, one {one:.9g} m",
                )

    def speeds_share_the_path(self) -> None:
        """Speeds are positive, their shares add up to 1, and they need no longer than it runs."""
        motion = self._make()
        speeds = motion.speeds()
        apply_if(speeds is not None, "speeds() is None: the mean speed is taken")
        for speed, share in speeds:
            fine = speed > 0 and share > 0 and isfinite(speed)
            require(fine, f"speeds() has {speed!r} m/s for {share!r} of the path")
        total = sum(share for _, share in speeds)
        require(abs(total - 1) <= 1e-9, f"the shares of the path add up to {total:.9g}, not to 1")
        mean = motion.distance_at(motion.end_time) / motion.end_time
        stated = 1 / sum(share / speed for speed, share in speeds)
        require(
            stated >= 0.99 * mean,
            f"its speeds have a mean of {stated:.4g} m/s, but it slides at {mean:.4g} m/s",
        )

    def every_body_is_exposed(self) -> None:
        """There is one exposure for each body of the case, by its name, and no other."""
        exposures = self._exposures()
        fits = set(exposures) == set(BODIES)
        require(fits, f"exposures of {sorted(exposures)} for the bodies {BODIES}")
        for name, exposure in exposures.items():
            require(isinstance(exposure, Exposure), f"{name!r} has {exposure!r}, no Exposure")

    def body_fields_fit_the_window(self) -> None:
        """Averages and envelopes have one shape, which broadcasts to the window's."""
        rate = samples.hertz_pressure(GRID)
        for name, exposure in self._exposures().items():
            average = exposure.average(rate)
            shape = np.shape(average)
            fits = shape in (GRID.cells, (1, GRID.cells[1]), (GRID.cells[0], 1), (1, 1))
            require(fits, f"{name!r}: average has shape {shape}, which does not fit {GRID.cells}")
            expect_array(f"{name!r}: average", average, shape)
            expect_array(f"{name!r}: envelope", exposure.envelope(rate), shape)

    def what_passes_is_swept(self) -> None:
        """A body whose points share the wear along x is swept; one that stays is not."""
        rate = samples.hertz_pressure(GRID)
        for name, exposure in self._exposures().items():
            average = exposure.average(rate)
            if np.shape(average) != GRID.cells:
                require(exposure.swept, f"{name!r} has one average for all x; set swept = True")
            elif np.array_equal(average, rate):
                require(not exposure.swept, f"{name!r} keeps its own rate at each x, but is swept")

    def worn_volume_is_conserved(self) -> None:
        """The volume of an average is the integral of the rate over the contact."""
        for rate in (1e-7 * samples.pattern(GRID.cells), samples.hertz_pressure(GRID)):
            needed = float(np.sum(rate)) * GRID.cell_area
            for name, exposure in self._exposures().items():
                found = exposure.volume(exposure.average(rate))
                require(
                    abs(found - needed) <= 1e-9 * needed,
                    f"body {name!r} loses {found:.6g} m³ per metre where {needed:.6g} m³ is worn "
                    f"away ({found / needed:.4g} times as much)",
                )

    def averages_are_linear(self) -> None:
        """The average of a sum is the sum of averages, and none is negative."""
        one, other = samples.pattern(GRID.cells), samples.hertz_pressure(GRID) / samples.PEAK
        for name, exposure in self._exposures().items():
            both = exposure.average(2 * one + 3 * other)
            parts = 2 * exposure.average(one) + 3 * exposure.average(other)
            expect_close(f"{name!r}: average of a sum", both, parts, 1e-12)
            require(np.min(both) >= 0, f"{name!r}: rates that are nowhere negative average to less")

    def finer_window_averages_the_same(self) -> None:
        """Cutting each cell in four changes no average."""
        fine = Grid(GRID.size, (2 * GRID.cells[0], 2 * GRID.cells[1]))
        rate = samples.hertz_pressure(GRID)
        coarse, finer = self._exposures(), self._exposures(fine)
        for name in BODIES:
            found = np.broadcast_to(finer[name].average(_split(rate)), fine.cells)
            needed = _split(np.broadcast_to(coarse[name].average(rate), GRID.cells))
            expect_close(f"{name!r}: average on cells of half the size", found, needed, 1e-9)

    def envelope_covers_the_field(self) -> None:
        """No point meets less than what it meets now, and meeting it twice adds nothing."""
        field = samples.pattern(GRID.cells)
        for name, exposure in self._exposures().items():
            envelope = np.broadcast_to(exposure.envelope(field), GRID.cells)
            above = np.all(envelope >= field) and np.max(envelope) == np.max(field)
            require(above, f"{name!r}: the envelope is not between the field and its largest value")
            again = np.broadcast_to(exposure.envelope(envelope), GRID.cells)
            expect_close(f"{name!r}: envelope of an envelope", again, envelope, 0.0)

    def compliance_is_the_average_of_a_linear_law(self) -> None:
        """For a law linear in pressure the compliance is exact, and it is never negative."""
        pressure, slope = samples.hertz_pressure(GRID), np.full(GRID.cells, 3e-16)
        exposures = self._exposures()
        asked = {name: e.compliance(slope, pressure) for name, e in exposures.items()}
        given = {name: compliance for name, compliance in asked.items() if compliance is not None}
        apply_if(given, "its exposures give no compliance")
        for name, compliance in given.items():
            require(isinstance(compliance, WearCompliance), f"{name!r}: no WearCompliance is given")
            expect_array(f"{name!r}: local compliance", compliance.local, GRID.cells)
            expect_array(f"{name!r}: swept compliance", compliance.swept, GRID.cells[1:])
            least = min(np.min(compliance.local), np.min(compliance.swept))
            require(least >= 0, f"{name!r}: the compliance falls to {least:.3g}")
            needed = np.broadcast_to(exposures[name].average(slope * pressure), GRID.cells)
            found = compliance.depth(pressure, GRID.spacing[0])
            expect_close(f"{name!r}: depth of the compliance", found, needed, 1e-9)

    def limitation_is_said_in_words(self) -> None:
        """Up to some size of contact there is no limitation; beyond, there is one, in words."""
        motion = self._make()
        said = [
            motion.limitation(float(half_width), 1e-5, 1e-6, 1.0) for half_width in _HALF_WIDTHS
        ]
        for text in said:
            plain = text is None or (isinstance(text, str) and text.strip())
            require(plain, f"limitation gave {text!r}; a sentence or None is needed")
        first = next((number for number, text in enumerate(said) if text is not None), len(said))
        require(None not in said[first:], "a larger contact is less limited than a smaller one")

    def absurd_contacts_are_refused(self) -> None:
        """A contact of a micrometre is accepted; beyond some size `CaseError` refuses all."""
        motion = self._make()
        refused = []
        for half_width in _HALF_WIDTHS:
            try:
                motion.check_contact(float(half_width))
            except CaseError:
                refused.append(True)
            else:
                refused.append(False)
        require(not refused[0], "check_contact refuses a half-width of 1 µm")
        require(refused == sorted(refused), "check_contact accepts more than what it refuses")

    def runs_a_case(self) -> None:
        """In a small case each body loses just what its law says."""
        motion = self._make()
        distance = min(3.0, 0.999 * motion.distance_at(motion.end_time))
        samples.run(self._fields, kinematics=motion, stop=Stop(distance=distance))


def _split(field: Array) -> Array:
    return np.repeat(np.repeat(field, 2, axis=0), 2, axis=1)
