"""Progress of a run on the terminal."""

from __future__ import annotations

import math
import sys
import time
from typing import Any

from pydantic import PrivateAttr
from rich.console import Console
from rich.progress import BarColumn, TaskID, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bar
from rich.table import Column

from tribo.core.state import RunInfo, Snapshot
from tribo.core.words import readable
from tribo.observers.observer import Observer

QUIET = 2.0
"""Time without a word, in s: a run that is done by then needs none."""


def progress_bar(**options: Any) -> Bar:
    """Return a bar on stderr: the time to go, and what a task is described as.

    It is gone at the end, and silent where stderr is no terminal, even where the
    environment forces colours. `options` go to `rich.progress.Progress`.
    """
    return Bar(
        BarColumn(6, table_column=Column(no_wrap=True)),
        TimeRemainingColumn(compact=True, table_column=Column(no_wrap=True)),
        # Cut where a narrow terminal ends: the other parts stay whole.
        TextColumn(
            "left · {task.description}",
            table_column=Column(ratio=1, no_wrap=True, overflow="ellipsis"),
        ),
        expand=True,
        console=Console(file=sys.stderr),
        transient=True,
        disable=not sys.stderr.isatty(),
        **options,
    )


class Progress(Observer):
    """A live line on stderr: time to go, time, pressure, worn depths, step.

    Runs shorter than two seconds stay silent. Where stderr is no terminal, a
    plain line is printed at each save.
    """

    type = "progress"

    _bar: Bar = PrivateAttr()
    _task: TaskID = PrivateAttr()
    _run: RunInfo = PrivateAttr()
    _begun: float = PrivateAttr()

    def on_start(self, run: RunInfo) -> None:
        """Start the clock."""
        self._run, self._begun = run, time.monotonic()
        self._bar = progress_bar(speed_estimate_period=math.inf)
        before = run.resumed_from
        done = 0.0 if before is None else self._part(before)
        self._task = self._bar.add_task("", total=1.0)
        self._bar.update(self._task, completed=done)

    def on_step(self, snapshot: Snapshot) -> None:
        """Renew the line."""
        if self._bar.disable or time.monotonic() - self._begun < QUIET:
            return
        m = snapshot.measures
        worn = [f"{name} {1e6 * body.max_wear_depth:.3g}" for name, body in m.bodies.items()]
        words = (
            f"{m.time:.4g}/{self._run.end_time:.4g} s · "
            f"p max {readable(1e-6 * m.max_pressure, '.0f')} MPa · {', '.join(worn)} µm · "
            f"step {snapshot.state.steps}"
        )
        self._bar.update(self._task, completed=self._part(snapshot), description=words)
        self._bar.start()

    def on_save(self, snapshot: Snapshot) -> None:
        """Print a plain line where there is no terminal."""
        if self._bar.disable and time.monotonic() - self._begun > QUIET:
            print(
                f"{snapshot.measures.time:g} s of {self._run.end_time:g} s, "
                f"step {snapshot.state.steps}",
                file=sys.stderr,
            )

    def on_finish(self, snapshot: Snapshot | None, reason: str) -> None:
        """Take the line away."""
        if self._bar.live.is_started:
            self._bar.stop()

    def _part(self, snapshot: Snapshot) -> float:
        """Return the part of the work that is done, from the distance alone: it never goes back."""
        part = min(1.0, snapshot.measures.distance / self._run.end_distance)
        stepping = self._run.case.get("stepping")
        explicit = isinstance(stepping, dict) and stepping.get("type") == "explicit"
        # Implicit steps grow as a scar does, whose width is the fourth root of the distance.
        return part if explicit else part**0.25
