"""What every observer must fulfil."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from contextlib import chdir, contextmanager
from copy import deepcopy
from dataclasses import replace
from functools import cache
from tempfile import TemporaryDirectory
from typing import Any

from pydantic import PrivateAttr

from tribo.case import Output
from tribo.core.state import RunInfo, Snapshot
from tribo.observers.observer import Observer
from tribo.simulation.run import Simulation
from tribo.testing import samples
from tribo.testing.checks_calls import Exercise, call_checks, locked
from tribo.testing.compare import first_difference
from tribo.testing.subject import Subject, fact, require


class Keeps(Observer):
    """Keeps what a run shows to its observers."""

    type = "tribo.testing.keeps"

    _run: RunInfo | None = None
    _snapshots: list[Snapshot] = PrivateAttr(default_factory=list)

    @property
    def run(self) -> RunInfo | None:
        """What was told at the start."""
        return self._run

    @property
    def snapshots(self) -> list[Snapshot]:
        """Every step."""
        return self._snapshots

    def on_start(self, run: RunInfo) -> None:
        """Keep what is told at the start."""
        self._run = run

    def on_step(self, snapshot: Snapshot) -> None:
        """Keep every step."""
        self._snapshots.append(snapshot)


def _watched(subject: Subject, *observers: Any) -> Keeps:
    """Return what a small run shows, with `observers` watching it."""
    keeps = Keeps()
    model = samples.small_model(subject, observers=observers, output=Output(save_times=(5.0,)))
    with _elsewhere(), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        Simulation(model.case).run(observers=[keeps]).close()
    return keeps


@cache
def _plain(kind: str) -> tuple[RunInfo, tuple[Snapshot, ...]]:
    """Return what a small run shows that nothing watches."""
    keeps = _watched(Subject(Keeps, kind, Keeps(), {}, None, 0))  # type: ignore[arg-type]
    assert keeps.run is not None
    return keeps.run, tuple(keeps.snapshots)


@contextmanager
def _elsewhere() -> Iterator[None]:
    """Work in a folder that goes away, for observers that write files."""
    with TemporaryDirectory() as folder, chdir(folder):
        yield


def _inputs(subject: Subject, observer: Any, number: int) -> Any:
    run, snapshots = _plain(subject.kind)
    return deepcopy((run, snapshots[: 3 + number]))


def _call(observer: Any, inputs: Any) -> Mapping[str, Any]:
    run, snapshots = inputs
    with _elsewhere():
        _show(observer, run, snapshots)
    return {}


EXERCISE = Exercise(_inputs, _call)


def _show(
    observer: Any, run: RunInfo, snapshots: tuple[Snapshot, ...], reason: str = "done"
) -> None:
    observer.on_start(run)
    for number, snapshot in enumerate(snapshots):
        observer.on_step(snapshot)
        if number in (0, len(snapshots) - 1):
            observer.on_save(snapshot)
    observer.on_finish(snapshots[-1] if snapshots else None, reason)


@fact
def watching_changes_no_bit(subject: Subject) -> None:
    """A run gives the same bits with and without it."""
    _, plain = _plain(subject.kind)
    watched = _watched(subject, subject.make()).snapshots
    require(len(watched) == len(plain), f"{len(plain)} steps became {len(watched)}")
    for number, (one, other) in enumerate(zip(plain, watched, strict=True)):
        where = first_difference(one, other)
        require(where is None, f"{where} of step {number} differs when it watches")


@fact
def every_end_is_survived(subject: Subject) -> None:
    """A run may be done, interrupted or failed, and even end before its first contact."""
    run, snapshots = locked(_inputs(subject, None, 0))
    for reason in ("done", "interrupted", "failed"):
        with _elsewhere():
            _show(subject.make(), run, snapshots, reason)
    with _elsewhere():
        _show(subject.make(), run, (), "failed")


@fact
def resumed_run_is_survived(subject: Subject) -> None:
    """A run may go on from a state that the observer has not seen."""
    run, snapshots = locked(_inputs(subject, None, 1))
    resumed = replace(run, resumed_from=snapshots[1], wall_time=5.0)
    with _elsewhere():
        _show(subject.make(), resumed, snapshots[2:])


@fact
def second_run_is_survived(subject: Subject) -> None:
    """An observer of a case may watch one run after another."""
    run, snapshots = locked(_inputs(subject, None, 0))
    observer = subject.make()
    with _elsewhere():
        for _ in range(2):
            _show(observer, run, snapshots)


# An observer answers nothing, so what concerns answers does not apply.
CHECKS = (
    *(c for c in call_checks(EXERCISE) if c.name != "answers_may_be_overwritten"),
    watching_changes_no_bit,
    every_end_is_survived,
    resumed_run_is_survived,
    second_run_is_survived,
)
