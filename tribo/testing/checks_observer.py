"""What every observer must fulfil."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import chdir
from copy import deepcopy
from dataclasses import replace
from functools import cache
from tempfile import TemporaryDirectory
from typing import Any

from tribo.case import Output
from tribo.core.state import RunInfo, Snapshot
from tribo.observers.observer import Observer
from tribo.simulation.run import Simulation
from tribo.testing import samples
from tribo.testing.checks import BODIES, Checks
from tribo.testing.compare import NotApplicable, locked, renamed, require


class ObserverChecks(Checks):
    """Checks of an observer."""

    def _units(self, component: Any) -> Mapping[str, float]:
        raise NotApplicable("an observer answers nothing")

    def _inputs(self, component: Any, number: int) -> tuple[RunInfo, list[Snapshot]]:
        run, *snapshots = renamed(deepcopy(_watched()[: 4 + number]), BODIES, self._bodies)
        return run, snapshots

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        _show(component, *inputs)
        return {}

    def any_run_is_survived(self) -> None:
        """A run may end early, fail, go on from a state not seen, or be the second one."""
        run, snapshots = locked(self._inputs(None, 1))
        for reason in ("done", "interrupted", "failed"):
            _show(self._make(), run, snapshots, reason)
        _show(self._make(), run, (), "failed")
        resumed = replace(run, resumed_from=snapshots[1], wall_time=5.0)
        _show(self._make(), resumed, snapshots[2:])
        observer = self._make()
        for _ in range(2):
            _show(observer, run, snapshots)


@cache
def _watched() -> list[Any]:
    """Return the inputs of an observer in a small run."""
    seen: list[Any] = []

    class Keeps(Observer):
        type = "tribo.testing.keeps"

        def on_start(self, run: RunInfo) -> None:
            seen.append(run)

        def on_step(self, snapshot: Snapshot) -> None:
            seen.append(snapshot)

    case = samples.small_case(output=Output(save_times=(5.0,)))
    with TemporaryDirectory() as folder, chdir(folder):
        Simulation(case).run(observers=[Keeps()]).close()
    return seen


def _show(observer: Any, run: RunInfo, snapshots: Sequence[Snapshot], reason: str = "done") -> None:
    """Show a run to an observer, in a folder that goes away."""
    with TemporaryDirectory() as folder, chdir(folder):
        observer.on_start(run)
        for number, snapshot in enumerate(snapshots):
            observer.on_step(snapshot)
            if number in (0, len(snapshots) - 1):
                observer.on_save(snapshot)
        observer.on_finish(snapshots[-1] if snapshots else None, reason)
        require(os.path.samefile(folder, "."), "it changed the working folder")
