"""Call the observers of a run with read-only views.

A malicious observer can still change the run: numpy gives access to the array
behind a view, as its `base`, and a plugin runs in this very process.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from copy import deepcopy

from tribo.core.arrays import view
from tribo.core.errors import TriboError, warn
from tribo.core.state import RunInfo, Snapshot
from tribo.guards.guard import Guard
from tribo.observers.observer import Observer


class Audience:
    """The observers of a run, in the order of their calls, the recorder first."""

    def __init__(self, observers: Sequence[Observer]) -> None:
        self._observers = tuple(observers)
        self._started: list[Observer] = []

    def start(self, run: RunInfo) -> None:
        """Report that the run begins or continues; each observer gets its own copy."""
        for observer in self._observers:
            Guard(observer).ask(observer.on_start, deepcopy(run))
            self._started.append(observer)

    def step(self, snapshot: Snapshot, *, save: bool) -> None:
        """Report an accepted step, which may be saved; all observers get the same view."""
        shown = view(snapshot)
        for observer in self._observers:
            guard = Guard(observer)
            guard.ask(observer.on_step, shown)
            if save:
                guard.ask(observer.on_save, shown)

    def finish(self, snapshot: Snapshot, reason: str) -> None:
        """Report the end to the observers that were started.

        Where the run itself did not finish, an error of an observer is only a warning.
        """
        # The recorder comes last, so that nothing another one raises costs a result.
        with ExitStack() as finishing:
            for observer in self._started:
                finishing.callback(_finish, observer, view(snapshot), reason)


def _finish(observer: Observer, snapshot: Snapshot, reason: str) -> None:
    try:
        Guard(observer).ask(observer.on_finish, snapshot, reason)
    except TriboError as error:
        if reason == "done":
            raise
        warn(str(error))
