"""Show on the terminal how a run gets on."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable

from pydantic import PrivateAttr
from rich.console import Console
from rich.live import Live
from rich.text import Text

from tribo.core.state import RunInfo, Snapshot
from tribo.observers.observer import Observer

QUIET = 2.0
RENEWED = 0.1
"""Time between two renewals of the line, in s."""


class Progress(Observer):
    """A live line on stderr: time, step, pressure, worn depth, time to go.

    Runs shorter than two seconds stay silent. Where stderr is no terminal, a
    plain line is printed at each save.
    """

    type = "progress"

    _console: Console = PrivateAttr(default_factory=lambda: Console(file=sys.stderr))
    # Whatever the environment says of colours, a line is renewed on a terminal only.
    _on_terminal: bool = PrivateAttr(default_factory=lambda: sys.stderr.isatty())
    _clock: Callable[[], float] = PrivateAttr(default=time.monotonic)
    _live: Live | None = None
    _run: RunInfo | None = None
    _begun: float = 0.0
    _renewed: float = 0.0
    _part_before: float = 0.0

    def on_start(self, run: RunInfo) -> None:
        """Start the clock."""
        self._run = run
        self._begun = self._clock()
        before = run.resumed_from
        self._part_before = 0.0 if before is None else self._part(before)

    def on_step(self, snapshot: Snapshot) -> None:
        """Renew the line."""
        now = self._clock()
        if not self._on_terminal or now - self._begun < QUIET or now - self._renewed < RENEWED:
            return
        self._renewed = now
        if self._live is None:
            self._live = Live(console=self._console, auto_refresh=False, transient=True)
            self._live.start()
        self._live.update(self._line(snapshot, now - self._begun), refresh=True)

    def on_save(self, snapshot: Snapshot) -> None:
        """Print a plain line where there is no terminal."""
        assert self._run is not None
        if not self._on_terminal and self._clock() - self._begun > QUIET:
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

    def _part(self, snapshot: Snapshot) -> float:
        """Return the part of the work that is done, from the path alone: it never goes back."""
        assert self._run is not None
        part = min(1.0, snapshot.measures.distance / self._run.end_distance)
        stepping = self._run.case.get("stepping")
        explicit = isinstance(stepping, dict) and stepping.get("type") == "explicit"
        # Implicit steps grow as a scar does, whose width is the fourth root of the path.
        return part if explicit else part**0.25

    def _line(self, snapshot: Snapshot, elapsed: float) -> Text:
        assert self._run is not None
        m = snapshot.measures
        part = self._part(snapshot)
        done = part - self._part_before
        width = 16
        filled = round(part * width)
        bar = "[green]" + "━" * filled + "[/][dim]" + "━" * (width - filled) + "[/]"
        left = elapsed * (1 - part) / done if done > 0 else math.inf
        worn = ", ".join(
            f"{name} {1e6 * body.max_wear_depth:.3g} µm" for name, body in m.bodies.items()
        )
        text = Text.from_markup(
            f"{bar} {_words(left)} left · {m.time:.4g} of {self._run.end_time:.4g} s · "
            f"step {snapshot.state.steps} · p max {1e-6 * m.max_pressure:.0f} MPa · {worn}",
            overflow="ellipsis",
        )
        text.no_wrap = True
        return text


def _words(seconds: float) -> str:
    if not math.isfinite(seconds):
        return "…"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{rest:02d}" if hours else f"{minutes}:{rest:02d}"
