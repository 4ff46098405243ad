"""What every motion must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribo.case import Stop
from tribo.core.grid import Grid, RepeatingGrid
from tribo.guards.motion import GuardedMotion
from tribo.motion.exposure import Exposure
from tribo.testing import samples
from tribo.testing.checks import BODIES, OTHER_NAMES, Checks
from tribo.testing.compare import apply_if, expect_close, renamed, require
from tribo.testing.rescaling import renewed
from tribo.testing.samples import GRID

_PARTS = np.sort(samples.pattern((2000,)))
"""Of a run, at which it is asked how far it has slid."""


class KinematicsChecks(Checks):
    """Checks of a motion."""

    def _inputs(self, component: Any, number: int) -> dict[str, Any]:
        pattern = samples.pattern(GRID.cells) + number
        return {
            "grid": samples.sized(GRID, 1 - 0.1 * number),
            "rate": 1e-7 * pattern,
            "slope": 1e-16 * pattern,
            "pressure": 1e9 * pattern,
            "own": pattern,
        }

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        end, cycle = component.end_time, component.cycle(inputs["grid"])
        answers: dict[str, Any] = {
            "end_time": float(end),
            "distance_at": np.array([component.distance_at(part * end) for part in _PARTS[::10]]),
            "edges": np.array(list(component.edges), dtype=float),
            "share": np.array([position.share for position in cycle]),
            "rest": np.array([position.rest for position in cycle]),
            "speeds": np.array([v for position in cycle for v, _ in position.speeds or ()]),
        }
        for name, exposure in component.exposures(inputs["grid"], self._bodies).items():
            worn = exposure.gather(inputs["rate"], 0)
            own = exposure.lay(inputs["own"], 0)
            answers[name] = {
                "volume": exposure.volume(worn),
                "average": worn,
                # A copy: where each point meets its own value alone it is the same array.
                "envelope": np.array(exposure.envelope(own)),
                "compliance": exposure.compliance(inputs["slope"], inputs["pressure"]),
            }
        return answers

    def _exposures(self, grid: Grid = GRID) -> Mapping[str, Exposure]:
        motion = GuardedMotion(self._make())
        return motion.exposures(grid, BODIES, len(motion.cycle(grid)))

    def answers_fit_a_run(self) -> None:
        """It slides from 0 to an end, and each body lies below the window at each position.

        `time_at` is the first time at a distance, at rests and reversals too.
        """
        motion = GuardedMotion(self._make())
        end = motion.end_time(None)
        # The whole of it, and closely over the first hundredth, where cycles are resolved.
        few = _PARTS[::10]
        motion.check_distance(end, sorted([*few, *0.01 * few]))
        for grid in (GRID, RepeatingGrid(size=GRID.size, cells=GRID.cells)):
            self._exposures(grid)

    def speeds_share_the_path(self) -> None:
        """Its speeds need no longer than it runs, and their mean over the path is its own."""
        motion = self._make()
        cycle = GuardedMotion(motion).cycle(GRID)
        speeds = [(v, p.share * share) for p in cycle for v, share in p.speeds or ()]
        apply_if(bool(speeds), "its positions have no speeds: the mean speed is taken")
        require(min(speeds)[0] > 0, "a speed is 0; it must be positive")
        end = motion.end_time
        rest = sum(p.share * p.rest for p in cycle)
        needs = motion.distance_at(end) * (sum(share / speed for speed, share in speeds) + rest)
        require(needs <= 1.01 * end, f"at its speeds it needs {needs:.4g} s, but runs {end:.4g} s")
        instant = 1e-8 * end
        times = 0.999 * end * _PARTS
        at = [(motion.distance_at(t), motion.distance_at(t + instant)) for t in times]
        slid = np.array([later - now for now, later in at])
        stated = sum(share * speed for speed, share in speeds)
        found = float(np.sum(slid**2) / np.sum(slid)) / instant
        expect_close("mean of its speeds over the path, and by distance_at", stated, found, 0.05)

    def averages_are_linear(self) -> None:
        """The wear of a sum is the sum of wear, and each row wears as it is worn.

        Without positions, a compliance gives the average of a law that is linear in pressure.
        """
        motion = self._make()
        rates = [1e-7 * samples.pattern(GRID.cells), samples.hertz_pressure(GRID) / samples.PEAK]
        rates.append(2 * rates[0] + 3 * rates[1])
        row = np.where(np.arange(GRID.cells[1]) == 4, rates[0], 0.0)
        for name, exposure in self._exposures().items():
            track = exposure.track(GRID) if exposure.averaged else 0.0
            extent = motion.track_extent
            require(track <= 1.01 * extent, f"{name!r}: its track is longer than {extent:.4g} m")
            other = np.delete(exposure.average(row), 4, axis=1)
            require(not np.any(other), f"{name!r}: wear in one row of cells is laid in others too")
            worn = [exposure.average(rate) for rate in rates]
            parts = 2 * worn[0] + 3 * worn[1]
            expect_close(f"{name!r}: average of a sum", worn[2], parts, 1e-12)
            given = exposure.compliance(np.ones(GRID.cells), rates[1])
            if given is not None and len(motion.cycle(GRID)) == 1:
                depth = given.depth(rates[1], GRID.spacing[0])
                needed = np.broadcast_to(worn[1], GRID.cells)
                expect_close(f"{name!r}: depth of the compliance", depth, needed, 1e-9)

    def another_window_changes_little(self) -> None:
        """Cells a third of the size, and a rim in which nothing wears, change no average."""
        rate, wide = samples.hertz_pressure(GRID), samples.wider(GRID)
        usual, other = self._exposures(), self._exposures(samples.finer(wide, (3, 3)))
        split = np.pad(rate, [(rim, rim) for rim in samples.RIM]).repeat(3, 0).repeat(3, 1)
        for name in BODIES:
            needed = np.broadcast_to(usual[name].average(rate), GRID.cells)
            found = np.broadcast_to(other[name].average(split), split.shape)[1::3, 1::3]
            what = f"{name!r}: average in a wider window of finer cells"
            expect_close(what, samples.inside(found), needed, 1e-6)

    def bodies_change_places_as_named(self) -> None:
        """The body called `swept` moves; if it is the other, each meets what the other met."""
        apply_if("swept" in self._cls.model_fields, "it has no key `swept`")
        rate, met = samples.pattern(GRID.cells), {}
        for name in BODIES:
            exposures = type(self)(renewed(self._config, {"swept": name}))._exposures()
            require(exposures[name].swept, f"{name!r} does not move although `swept` names it")
            met[name] = {body: exposures[body].average(rate) for body in BODIES}
        first, second = BODIES
        turned = renamed(renamed(met, BODIES, OTHER_NAMES), OTHER_NAMES, (second, first))
        expect_close("as the other body moves", met, turned, 1e-12)

    def runs_a_case(self) -> None:
        """In a small case each body loses just what its law says."""
        motion = self._make()
        stop = Stop(distance=min(3.0, 0.999 * motion.distance_at(motion.end_time)))
        samples.run(lambda: {"kinematics": self._make(), "stop": stop})
