"""Show on the terminal how a run gets on."""

from __future__ import annotations

import math
import sys
import time

from pydantic import PrivateAttr
from rich.console import Console
from rich.live import Live
from rich.text import Text

from tribo.core.state import RunInfo, Snapshot
from tribo.interfaces.observer import Observer

QUIET = 2.0


class Progress(Observer):
    """A live line on stderr: time, step, pressure, worn depth, time to go.

    Runs shorter than two seconds stay silent. Where stderr is no terminal, a
    plain line is printed at each save.
    """

    type = "progress"

    _console: Console = PrivateAttr(default_factory=lambda: Console(file=sys.stderr))
    _live: Live | None = None
    _run: RunInfo | None = None
    _begun: float = 0.0
    _steps: int = 0
    _previous: float = 0.0

    def on_start(self, run: RunInfo) -> None:
        """Start the clock."""
        self._run = run
        self._begun = time.monotonic()
        self._previous = run.resumed_from.measures.distance if run.resumed_from is not None else 0.0

    def on_step(self, snapshot: Snapshot) -> None:
        """Renew the line."""
        assert self._run is not None
        distance = snapshot.measures.distance
        part = self._done(snapshot)
        self._previous = distance
        elapsed = time.monotonic() - self._begun
        if elapsed < QUIET or not self._console.is_terminal:
            return
        if self._live is None:
            self._live = Live(console=self._console, refresh_per_second=8, transient=True)
            self._live.start()
        self._live.update(self._line(snapshot, part, elapsed))

    def on_save(self, snapshot: Snapshot) -> None:
        """Print a plain line where there is no terminal."""
        assert self._run is not None
        if not self._console.is_terminal and time.monotonic() - self._begun > QUIET:
            self._console.print(
                f"{snapshot.measures.time:g} s of {self._run.end_time:g} s, "
                f"step {snapshot.state.steps}",
                highlight=False,
            )

    def on_finish(self, snapshot: Snapshot | None, reason: str) -> None:
        """Take the line away."""
        if self._live is not None:
            self._live.stop()
            self._live = None

    def _done(self, snapshot: Snapshot) -> float:
        """Return the part of the work that is done, from the steps taken and to come."""
        assert self._run is not None
        self._steps += 1
        s, end = snapshot.measures.distance, self._run.end_distance
        increment = s - self._previous
        if s >= end or increment <= 0:
            return 1.0 if s >= end else 0.0
        stepping = self._run.case.get("stepping")
        explicit = isinstance(stepping, dict) and stepping.get("type") == "explicit"
        # Implicit increments grow in proportion to the distance slid.
        left = (end - s) / increment if explicit else math.log(end / s) / math.log1p(increment / s)
        return self._steps / (self._steps + left)

    def _line(self, snapshot: Snapshot, part: float, elapsed: float) -> Text:
        assert self._run is not None
        m = snapshot.measures
        width = 16
        filled = round(part * width)
        bar = "[green]" + "━" * filled + "[/][dim]" + "━" * (width - filled) + "[/]"
        eta = elapsed * (1 - part) / part if part > 0 else math.inf
        worn = ", ".join(
            f"{name} {1e6 * body.max_wear_depth:.3g} µm" for name, body in m.bodies.items()
        )
        text = Text.from_markup(
            f"{bar} {_clock(eta)} left · {m.time:.4g} of {self._run.end_time:.4g} s · "
            f"step {snapshot.state.steps} · p max {1e-6 * m.max_pressure:.0f} MPa · {worn}",
            overflow="ellipsis",
        )
        text.no_wrap = True
        return text


def _clock(seconds: float) -> str:
    if not math.isfinite(seconds):
        return "…"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{rest:02d}" if hours else f"{minutes}:{rest:02d}"
