"""The recorded steps of a run, for its adjoint."""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from tempfile import TemporaryFile

import numpy as np
from numpy.typing import NDArray
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


@dataclass(frozen=True)
class Gave:
    """The overlap at some positions became plastic depth."""

    places: Sequence[int]


@dataclass(frozen=True)
class Enveloped:
    """The plastic depth of averaged bodies, by name, became the depth of one row at each y."""

    rows: Mapping[str, NDArray[np.intp]]


@dataclass(frozen=True)
class Saved:
    """A state that is the input of an objective."""

    time: float


Record = Pressed | Gave | Enveloped | Saved


class Tape:
    """The records of a run in their order, which are read backwards.

    They lie in a temporary file, so that the memory does not grow with the run.
    `touched` is the region that holds all contacts, None before the first.
    """

    def __init__(self) -> None:
        self._file = TemporaryFile()  # noqa: SIM115
        self._ends = [0]
        self.touched: Region | None = None

    def append(self, record: Record) -> None:
        """Append a record."""
        if isinstance(record, Pressed):
            self.touched = union(self.touched or record.region, record.region)
        pickle.dump(record, self._file, pickle.HIGHEST_PROTOCOL)
        self._ends.append(self._file.tell())

    def __reversed__(self) -> Iterator[Record]:
        for start in self._ends[-2::-1]:
            self._file.seek(start)
            yield pickle.load(self._file)

    def close(self) -> None:
        """Discard the records."""
        self._file.close()


def recorded(model: Model, looked_at: Sequence[float], tape: Tape) -> dict[float, State]:
    """Run a model, recorded on a tape; return the states at saved times (s).

    The state for the model's own end is the last state, also where a depth ends the run sooner.
    """
    heard = _Heard(model)
    states: dict[float, State] = {}
    telling = replace(model, listener=heard)
    state = begin(telling)
    heard.keep(tape, "after", 0.0, 0.0)
    if 0.0 in looked_at:
        states[0.0] = state
        tape.append(Saved(0.0))
    for accepted in march(telling, state):
        before, state = state, accepted.state
        heard.keep(tape, "before", state.time, before.time)
        time = model.end_time if accepted.last else state.time
        if accepted.save and time in looked_at:
            states[time] = state
            tape.append(Saved(time))
    for each in state.findings:
        if each.kind == "stop" and not each.place.startswith("stop"):
            raise CaseError(
                f"a model ends the run at {state.time:g} s ({each.words}), which has no gradient; "
                "let stop.depth or the motion end it",
                each.place,
            )
    if missing := [time for time in looked_at if time not in states]:
        raise CaseError(
            f"nothing is saved at {missing[0]} s, the time of an objective: the run ends at "
            f"{state.time:.6g} s; add the time to output.save_times, or raise stop.depth"
        )
    return states


class _Heard(Listener):
    """The records of the events since the last accepted state."""

    def __init__(self, model: Model) -> None:
        self._model = model
        self._records: list[Record] = []

    def worn(
        self,
        contacts: Sequence[ContactSolution],
        interval: Interval,
        before: Memory,
        plan: Sequence[Share],
        *,
        ahead: bool = False,
    ) -> None:
        laws = {name: before.laws[name] for name in self._model.laws.wear}
        kept = Memory(laws, before.between if self._model.laws.effects else {})
        self._press(contacts, Slid(interval, kept, plan, ahead))

    def solved(self, contacts: Sequence[ContactSolution]) -> None:
        self._press(contacts)

    def yielded(self, places: Sequence[int]) -> None:
        self._records.append(Gave(tuple(places)))

    def drawn(self, before: Mapping[str, Array]) -> None:
        averaged = [name for name, each in self._model.cycle.maps.items() if each.averaged]
        rows = {name: np.argmax(before[name], axis=0) for name in averaged}
        self._records.append(Enveloped(rows))

    def _press(self, contacts: Sequence[ContactSolution], slid: Slid | None = None) -> None:
        region = reduce(union, (bounds(contact.pressure > 0) for contact in contacts))
        yields = any(np.any(contact.overlap > 0) for contact in contacts)
        self._records.append(
            Pressed(
                region=region,
                pressure=np.stack([contact.pressure[region] for contact in contacts]),
                overlap=np.stack([c.overlap[region] for c in contacts]) if yields else None,
                load="mean",
                times=(slid.interval.time, slid.interval.end_time) if slid else (),
                slid=slid,
            )
        )

    def keep(self, tape: Tape, load: str, time: float, begun: float) -> None:
        """Record the events up to an accepted state, without the steps that were rejected.

        Contacts solved before the step carry the load after the time at which it begun.
        """
        each = enumerate(self._records)
        steps = [i for i, of in each if isinstance(of, Pressed) and of.slid is not None]
        first, last = (steps[0], steps[-1]) if steps else (0, 0)
        for record in self._records[:first]:
            tape.append(_under(record, "after", begun))
        for record in self._records[last:]:
            tape.append(_under(record, load, time))
        self._records.clear()


def _under(record: Record, load: str, time: float) -> Record:
    """Return the record of an event; contacts solved without wear carry a load at a time (s)."""
    if isinstance(record, Pressed) and record.slid is None:
        return replace(record, load=load, times=(time,))
    return record
