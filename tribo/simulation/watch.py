"""Numbers, warnings and reasons to stop, from models and observers at a state."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import nan

from tribo.component import Component, components
from tribo.core.arrays import view
from tribo.core.column import Column
from tribo.core.errors import CaseError
from tribo.core.findings import Finding
from tribo.core.state import Snapshot, State
from tribo.evolution.measure import measure, with_effects
from tribo.guards.guard import Guard
from tribo.model.model import Model
from tribo.observers.observer import Observer
from tribo.result.columns import BODY_COLUMNS, COLUMNS

OWN = {column.name for column in (*COLUMNS, *BODY_COLUMNS)}


class Watch:
    """The models and observers that have columns or findings, and their findings so far.

    They come from the case, from its motion, and from `observers`. `CaseError` if a column has the
    name of another column, or of a column of every result.
    """

    def __init__(self, model: Model, observers: Sequence[Observer] = ()) -> None:
        self.model = model
        self.columns: dict[str, Column] = {}
        self.said: list[Finding] = []
        self._asked: dict[tuple[str, str], tuple[Guard[Component], Column]] = {}
        self._last: Snapshot | None = None
        parts = [*components(model.case)]
        known = [id(part) for _, part in parts]
        effects = (each.component for each in model.laws.effects)
        more = (("kinematics", effects), ("observers", observers))
        parts += ((at, each) for at, those in more for each in those if id(each) not in known)
        for place, part in parts:
            guard, (first, *path) = Guard(part), place.split(".")
            bodies = path[:1] if first == "bodies" else [*model.case.bodies]
            for column in guard.ask(getattr, part, "columns"):
                self._add(guard, guard.typed(column, Column, "one of its columns"), bodies)
        silent = Component.findings
        self._speakers = [each for each in parts if type(each[1]).findings is not silent]

    def _add(self, guard: Guard[Component], column: Column, bodies: Sequence[str]) -> None:
        other, name = self.columns.setdefault(column.name, column), column.name
        alike = (other.unit, other.of_bodies) == (column.unit, column.of_bodies)
        keys = [(name, body) for body in (bodies if column.of_bodies else ("",))]
        if not (alike and name.isidentifier()) or name in OWN or self._asked.keys() & keys:
            raise CaseError(
                f"{guard} has a column {name!r}; it needs a name of its own, of letters and digits"
            )
        self._asked |= dict.fromkeys(keys, (guard, column))

    def snapshot(self, state: State) -> Snapshot:
        """Return a state with its measures; with fields and columns too where any is read."""
        last = self._last
        if last is not None and _is_same(last.state, state):
            return replace(last, state=state)
        snapshot = Snapshot(state, measure(self.model, state))
        if self._asked or self._speakers:
            snapshot = with_effects(self.model, snapshot)
            seen = view(snapshot)
            values = {
                (name, body): guard.ask(_read, column, seen, *filter(None, [body]))
                for (name, body), (guard, column) in self._asked.items()
            }
            columns: dict[str, float | dict[str, float]] = {
                name: {body: values.get((name, body), nan) for body in state.bodies}
                if column.of_bodies
                else values[name, ""]
                for name, column in self.columns.items()
            }
            snapshot = replace(snapshot, columns=columns)
        self._last = snapshot
        return snapshot

    def told(self, state: State) -> State:
        """Return the state with its findings, each kind once at a place."""
        for finding in self._findings(state):
            known, state = len(state.findings), state.from_here(finding)
            self.said += state.findings[known:]
        return state

    def _findings(self, state: State) -> Iterator[Finding]:
        """Yield the findings on a state, with their places."""
        for place, component in self._speakers:
            guard, seen = Guard(component), view(self.snapshot(state))
            for answer in guard.ask(_said, component, seen):
                finding = guard.typed(answer, Finding, "a finding")
                yield finding if finding.place else replace(finding, place=place)


def _is_same(one: State, other: State) -> bool:
    """Whether two states differ in their findings alone."""
    parts = one.bodies is other.bodies and one.contacts is other.contacts
    return parts and one.time == other.time


def _read(column: Column, snapshot: Snapshot, *body: str) -> float:
    return float(column.read(snapshot, *body))


def _said(component: Component, snapshot: Snapshot) -> tuple[Finding, ...]:
    return tuple(component.findings(snapshot))
