"""Tell the observers of a run what happens, in views that no slip of theirs changes it by.

The arrays are read-only. That does not stop one that means to: numpy gives access to the
array behind a view, as its `base`, and a plugin runs in this very process.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from copy import deepcopy
from dataclasses import replace

from tribo.core.arrays import Array, readonly
from tribo.core.errors import TriboError, TriboWarning
from tribo.core.state import RunInfo, Snapshot
from tribo.observers.observer import Observer
from tribo.simulation.guard import calling

Watcher = Observer


class Audience:
    """The observers of a run, the recorder before all others.

    Parameters
    ----------
    observers : sequence of Observer
        In the order in which they are told.
    """

    def __init__(self, observers: Sequence[Watcher]) -> None:
        self._observers = tuple(observers)
        self._started: list[Watcher] = []

    def start(self, run: RunInfo) -> None:
        """Tell that the run begins or goes on; each gets a copy of its own."""
        for observer in self._observers:
            with calling(observer):
                observer.on_start(deepcopy(run))
            self._started.append(observer)

    def step(self, snapshot: Snapshot, *, save: bool) -> None:
        """Tell of an accepted step, and of the save that it may be."""
        for observer in self._observers:
            shown = _view(snapshot)
            with calling(observer):
                observer.on_step(shown)
                if save:
                    observer.on_save(shown)

    def finish(self, snapshot: Snapshot, reason: str) -> None:
        """Tell those that were started of the end.

        What one raises then is only warned of where the run itself did not
        come to its end: the first cause is the one to be seen.
        """
        # The recorder comes last, so that nothing another one raises costs a result.
        with ExitStack() as finishing:
            for observer in self._started:
                finishing.callback(_finish, observer, _view(snapshot), reason)


def _finish(observer: Watcher, snapshot: Snapshot, reason: str) -> None:
    try:
        with calling(observer):
            observer.on_finish(snapshot, reason)
    except TriboError as error:
        if reason == "done":
            raise
        warnings.warn(str(error), TriboWarning, stacklevel=2)


def _view(snapshot: Snapshot) -> Snapshot:
    """Return `snapshot` with containers of its own and arrays that are read-only."""
    state, measures = snapshot.state, snapshot.measures
    bodies = {
        name: replace(
            body,
            wear=readonly(body.wear),
            plastic=readonly(body.plastic),
            law=_views(body.law),
        )
        for name, body in state.bodies.items()
    }
    rates = {
        name: replace(
            rate,
            depth_rate=readonly(rate.depth_rate),
            depth_slope=readonly(rate.depth_slope),
            state_rates=_views(rate.state_rates),
        )
        for name, rate in state.rates.items()
    }
    contact = replace(
        state.contact,
        pressure=readonly(state.contact.pressure),
        overlap=readonly(state.contact.overlap),
    )
    previous = None if state.previous is None else readonly(state.previous)
    return Snapshot(
        replace(state, bodies=bodies, rates=rates, contact=contact, previous=previous),
        replace(measures, bodies=dict(measures.bodies)),
        {name: _views(of_bodies) for name, of_bodies in snapshot.effects.items()},
    )


def _views(fields: Mapping[str, Array]) -> dict[str, Array]:
    return {name: readonly(values) for name, values in fields.items()}
