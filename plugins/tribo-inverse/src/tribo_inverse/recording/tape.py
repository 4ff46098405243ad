"""The recorded steps of a run, for its adjoint."""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from tempfile import TemporaryFile
from typing import Any

import numpy as np
from tribo import Array, CaseError, ContactSolution, Region, State
from tribo.kernel_api import (
    Interval,
    Listener,
    Memory,
    Model,
    Share,
    begin,
    bounds,
    march,
    union,
)


@dataclass(frozen=True)
class Slid:
    """The interval that a step slid or rested.

    `before` has the states of laws and effects, and `plan` the parts of the step, to be used again;
    `ahead` is whether it wore under contacts solved before it.
    """

    interval: Interval
    before: Memory
    plan: Sequence[Share]
    ahead: bool


@dataclass(frozen=True)
class Pressed:
    """The contacts of a cycle, in a region of the window that contains all their pressure.

    Pressures, and depths by which the bodies overlap at the hardness (None where nothing yields),
    have the shape (positions, rows, columns). The method `load` of `tribo.core.loads.Loads` gave
    their load at `times` (s), and the step `slid` wore the bodies under them, if any.
    """

    region: Region
    pressure: Array
    overlap: Array | None
    load: str
    times: tuple[float, ...]
    slid: Slid | None

    def in_window(self, values: Array, cells: tuple[int, int]) -> Array:
        """Return values in its region in a window of so many cells, 0 around it."""
        found = np.zeros((len(values), *cells))
        found[(slice(None), *self.region)] = values
        return found


Event = tuple[str, Any]
"""What happened, the name of a method of `Backwards`, and to what."""


class Tape(Listener):
    """The events of a run of a model in their order, which are read backwards.

    They lie in a temporary file, so that the memory does not grow with the run.
    `touched` is the region that holds all contacts, None before the first.
    """

    def __init__(self, model: Model) -> None:
        self._model, self._events = model, list[Event]()
        self._file = TemporaryFile()  # noqa: SIM115
        self._ends = [0]
        self.touched: Region | None = None

    def append(self, *event: Any) -> None:
        """Append an event: contacts that were `pressed`, or another."""
        if isinstance(event[1], Pressed):
            self.touched = union(self.touched or event[1].region, event[1].region)
        pickle.dump(event, self._file, pickle.HIGHEST_PROTOCOL)
        self._ends.append(self._file.tell())

    def __reversed__(self) -> Iterator[Event]:
        for start in self._ends[-2::-1]:
            self._file.seek(start)
            yield pickle.load(self._file)

    def close(self) -> None:
        """Discard the records."""
        self._file.close()

    def worn(
        self,
        contacts: Sequence[ContactSolution],
        interval: Interval,
        before: Memory,
        plan: Sequence[Share],
        *,
        ahead: bool = False,
    ) -> None:
        """Note the contacts of a step, and what it started from."""
        laws = {name: before.laws[name] for name in self._model.laws.wear}
        kept = Memory(laws, before.between if self._model.laws.effects else {})
        self._press(contacts, Slid(interval, kept, plan, ahead))

    def solved(self, contacts: Sequence[ContactSolution]) -> None:
        """Note contacts without wear."""
        self._press(contacts)

    def yielded(self, places: Sequence[int]) -> None:
        """Note positions whose overlap became plastic depth."""
        self._events.append(("yielded", tuple(places)))

    def drawn(self, before: Mapping[str, Array]) -> None:
        """Note the deepest cell in each row of a track."""
        averaged = [name for name, each in self._model.cycle.maps.items() if each.averaged]
        rows = {name: np.argmax(before[name], axis=0) for name in averaged}
        self._events.append(("drawn", rows))

    def _press(self, contacts: Sequence[ContactSolution], slid: Slid | None = None) -> None:
        region = reduce(union, (bounds(contact.pressure > 0) for contact in contacts))
        yields = any(np.any(contact.overlap > 0) for contact in contacts)
        pressed = Pressed(
            region=region,
            pressure=np.stack([contact.pressure[region] for contact in contacts]),
            overlap=np.stack([c.overlap[region] for c in contacts]) if yields else None,
            load="mean",
            times=(slid.interval.time, slid.interval.end_time) if slid else (),
            slid=slid,
        )
        self._events.append(("pressed", pressed))

    def keep(self, load: str, time: float, begun: float) -> None:
        """Record the events up to an accepted state, without the steps that were rejected.

        Contacts solved without wear carry the load at a time, those before the step the load after
        the time at which it begun.
        """
        wore = [isinstance(of, Pressed) and of.slid is not None for _, of in self._events]
        steps = [i for i, wears in enumerate(wore) if wears]
        first, last = (steps[0], steps[-1]) if steps else (0, 0)
        kept = [(event, "after", begun) for event in self._events[:first]]
        kept += [(event, load, time) for event in self._events[last:]]
        for (name, of), of_load, at in kept:
            solved = isinstance(of, Pressed) and of.slid is None
            self.append(name, replace(of, load=of_load, times=(at,)) if solved else of)
        self._events.clear()


def recorded(model: Model, looked_at: Sequence[float], tape: Tape) -> dict[float, State]:
    """Run a model, recorded on a tape; return the states at saved times (s).

    The state for the model's own end is the last state, also where a depth ends the run sooner.
    """
    states: dict[float, State] = {}
    telling = replace(model, listener=tape)
    state = begin(telling)
    tape.keep("after", 0.0, 0.0)
    if 0.0 in looked_at:
        states[0.0] = state
        tape.append("saved", 0.0)
    for accepted in march(telling, state):
        before, state = state, accepted.state
        tape.keep("before", state.time, before.time)
        time = model.end_time if accepted.last else state.time
        if accepted.save and time in looked_at:
            states[time] = state
            tape.append("saved", time)
    for each in state.findings:
        if each.kind == "stop" and not each.place.startswith("stop"):
            raise CaseError(
                f"a model ends the run at {state.time:g} s ({each.words}), which has no gradient; "
                "let stop.depth or the motion end it",
                each.place,
            )
    if missing := [time for time in looked_at if time not in states]:
        raise CaseError(
            f"nothing is saved at {missing[0]!r}, the time of an objective in s: the run ends at "
            f"{state.time:.6g} s; give a time up to then that is in output.save_times"
        )
    return states
