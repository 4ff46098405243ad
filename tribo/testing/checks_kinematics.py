"""What every motion must fulfil."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribo.case import Stop
from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid, RepeatingGrid
from tribo.guards.motion import GuardedMotion
from tribo.motion.exposure import Exposure
from tribo.testing import samples
from tribo.testing.checks import BODIES, Checks
from tribo.testing.compare import apply_if, expect_close, require
from tribo.testing.samples import GRID

_PARTS = np.linspace(0.0, 1.0, 201)
_TIMES = 0.999 * samples.pattern((2000,))


class KinematicsChecks(Checks):
    """Checks of a motion."""

    def _inputs(self, component: Any, number: int) -> dict[str, Any]:
        # Of as many cells, but not of the same size.
        size = tuple((1 - 0.1 * number) * length for length in GRID.size)
        grid = GRID.model_copy(update={"size": size})
        pattern = samples.pattern(GRID.cells) + number
        exposures = component.exposures(grid, BODIES)
        return {
            "grid": grid,
            "rate": 1e-7 * pattern,
            "slope": 1e-16 * pattern,
            "pressure": 1e9 * pattern,
            "own": {name: _field(exposures[name]) + number for name in BODIES},
        }

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        end = component.end_time
        answers: dict[str, Any] = {
            "end_time": float(end),
            "distance_at": np.array([component.distance_at(part * end) for part in _PARTS]),
            "edges": np.array(list(component.edges), dtype=float),
            "cycle": [
                {
                    "share": p.share,
                    "speeds": np.array([v for v, _ in p.speeds or ()]),
                    "rest": p.rest,
                }
                for p in component.cycle(inputs["grid"])
            ],
        }
        for name, exposure in component.exposures(inputs["grid"], BODIES).items():
            average = exposure.average(inputs["rate"])
            answers[name] = {
                "volume": exposure.volume(average),
                # Copies, for identity is allowed: a stationary point sees its own rate.
                "average": np.array(average),
                "envelope": np.array(exposure.envelope(inputs["own"][name])),
                "compliance": exposure.compliance(inputs["slope"], inputs["pressure"]),
            }
        return answers

    def _exposures(
        self, grid: Grid = GRID, bodies: Sequence[str] = BODIES
    ) -> Mapping[str, Exposure]:
        motion = GuardedMotion(self._make())
        return motion.exposures(grid, bodies, len(motion.cycle(grid)))

    def answers_fit_a_run(self) -> None:
        """It slides on from 0 to an end, and each body lies below the window at each position.

        Where the window repeats, a body with rows of its own has those of the window.
        """
        motion = GuardedMotion(self._make())
        motion.check_distance(motion.end_time(None))
        for grid in (GRID, RepeatingGrid(size=GRID.size, cells=GRID.cells)):
            rate = samples.hertz_pressure(grid)
            for exposure in self._exposures(grid).values():
                itself = exposure.swept or np.array_equal(exposure.average(rate), rate)
                require(itself, "the average of a body that is not swept is not the rate itself")

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

    def speeds_share_the_path(self) -> None:
        """Speeds are positive, their shares add up to 1, and they need no longer than it runs."""
        motion = self._make()
        cycle = GuardedMotion(motion).cycle(GRID)
        speeds = [(v, p.share * share) for p in cycle for v, share in p.speeds or ()]
        apply_if(bool(speeds), "speeds() is None: the mean speed is taken")
        slowest = min(speed for speed, _ in speeds)
        require(slowest > 0, f"speeds() has {slowest!r} m/s; it must be positive")
        end = motion.end_time
        mean = motion.distance_at(end) / end
        rest = sum(p.share * p.rest for p in cycle)
        stated = 1 / (sum(share / speed for speed, share in speeds) + rest)
        require(
            stated >= 0.99 * mean,
            f"its speeds have a mean of {stated:.4g} m/s, but it slides at {mean:.4g} m/s",
        )
        instant = 1e-8 * end
        at = [(motion.distance_at(t), motion.distance_at(t + instant)) for t in _TIMES * end]
        slid = np.array([later - now for now, later in at])
        found = float(np.sum(slid**2) / np.sum(slid)) / instant
        stated = sum(share * speed for speed, share in speeds)
        require(
            abs(stated - found) <= 0.05 * found,
            f"over the path its speeds have a mean of {stated:.4g} m/s, but by distance_at that is "
            f"{found:.4g} m/s",
        )

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
        """The average of a sum is the sum of averages."""
        one, other = samples.pattern(GRID.cells), samples.hertz_pressure(GRID) / samples.PEAK
        for name, exposure in self._exposures().items():
            both = exposure.average(2 * one + 3 * other)
            parts = 2 * exposure.average(one) + 3 * exposure.average(other)
            expect_close(f"{name!r}: average of a sum", both, parts, 1e-12)

    def finer_window_averages_the_same(self) -> None:
        """Cutting each cell in four changes no average."""
        fine = Grid(GRID.size, (2 * GRID.cells[0], 2 * GRID.cells[1]))
        rate = samples.hertz_pressure(GRID)
        coarse, finer = self._exposures(), self._exposures(fine)
        for name in BODIES:
            found = np.broadcast_to(finer[name].average(_split(rate)), fine.cells)
            # Two rows together: where tracks differ in length, the mean of theirs is near that of
            # one in the middle.
            found = 0.5 * (found[:, ::2] + found[:, 1::2])
            needed = np.repeat(np.broadcast_to(coarse[name].average(rate), GRID.cells), 2, axis=0)
            expect_close(f"{name!r}: average on cells of half the size", found, needed, 1e-6)

    def larger_window_averages_the_same(self) -> None:
        """A wider rim round the contact, in which nothing wears, changes no average."""
        (nx, ny), (dx, dy) = GRID.cells, GRID.spacing
        wide = Grid(((nx + 4) * dx, (ny + 4) * dy), (nx + 4, ny + 4))
        rate = samples.hertz_pressure(GRID)
        usual, wider = self._exposures(), self._exposures(wide)
        for name in BODIES:
            found = np.broadcast_to(wider[name].average(np.pad(rate, 2)), wide.cells)[2:-2, 2:-2]
            needed = np.broadcast_to(usual[name].average(rate), GRID.cells)
            expect_close(f"{name!r}: average in a larger window", found, needed, 1e-9)

    def bodies_may_have_any_names(self) -> None:
        """Nothing depends on what the bodies are called, unless the configuration names them."""
        names, rate = ("upper", "lower"), samples.hertz_pressure(GRID)
        try:
            renamed = self._exposures(bodies=names)
        except CaseError as error:
            raise self._refused(error) from error
        for name, usual in zip(names, self._exposures().values(), strict=True):
            found = renamed[name].average(rate)
            expect_close(f"average of a body called {name!r}", found, usual.average(rate), 0.0)

    def envelope_covers_the_field(self) -> None:
        """No point meets less than what it meets now, and meeting it twice adds nothing."""
        for name, exposure in self._exposures().items():
            field = _field(exposure)
            envelope = np.broadcast_to(exposure.envelope(field), field.shape)
            above = np.all(envelope >= field) and np.max(envelope) == np.max(field)
            require(above, f"{name!r}: the envelope is not between the field and its largest value")
            again = np.broadcast_to(exposure.envelope(envelope), field.shape)
            expect_close(f"{name!r}: envelope of an envelope", again, envelope, 0.0)

    def compliance_is_the_average_of_a_linear_law(self) -> None:
        """For a law linear in pressure the compliance is exact, but for what positions change."""
        pressure, slope = samples.hertz_pressure(GRID), np.full(GRID.cells, 3e-16)
        exposures = {name: e for name, e in self._exposures().items() if e.starts is None}
        asked = {name: e.compliance(slope, pressure) for name, e in exposures.items()}
        given = {name: compliance for name, compliance in asked.items() if compliance is not None}
        apply_if(given, "its exposures give no compliance")
        for name, compliance in given.items():
            needed = np.broadcast_to(exposures[name].average(slope * pressure), GRID.cells)
            found = compliance.depth(pressure, GRID.spacing[0])
            expect_close(f"{name!r}: depth of the compliance", found, needed, 1e-9)

    def larger_contacts_are_limited_no_less(self) -> None:
        """Contacts have no limitation up to some size, and are refused beyond a range of sizes."""
        motion = GuardedMotion(self._make())
        said, taken = [], []
        for half_width in map(float, np.geomspace(1e-6, 10.0, 50)):
            said.append(motion.limitation(half_width, 1e-5, 1e-6, 1.0, False) is not None)
            try:
                motion.check_contact(half_width)
            except CaseError:
                taken.append(False)
            else:
                taken.append(True)
        require(said == sorted(said), "a larger contact is less limited than a smaller one")
        require(any(taken), "check_contact refuses each half-width from 1 µm to 10 m")
        # Positions of a cycle may be too far apart for a small contact.
        resolved = len(motion.cycle(GRID)) > 1
        require(taken[0] or resolved, "check_contact refuses a half-width of 1 µm")
        accepted = taken[taken.index(True) :]
        require(
            accepted == sorted(accepted, reverse=True),
            "check_contact accepts more than what it refuses",
        )

    def runs_a_case(self) -> None:
        """In a small case each body loses just what its law says."""
        motion = self._make()
        distance = min(3.0, 0.999 * motion.distance_at(motion.end_time))
        samples.run(self._fields, kinematics=motion, stop=Stop(distance=distance))


def _field(exposure: Any) -> Array:
    """Return a field that an exposure finds the envelope of."""
    rows = GRID.cells[0] if exposure.starts is None else exposure.rows
    return samples.pattern((rows, GRID.cells[1]))


def _split(field: Array) -> Array:
    return np.repeat(np.repeat(field, 2, axis=0), 2, axis=1)
