"""Run one case of a sweep in a worker."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import Any

from tribo.core.errors import CaseError, Interrupted, TriboError, about
from tribo.core.locks import BusyError
from tribo.core.state import Snapshot
from tribo.core.writing import remove
from tribo.observers.observer import Observer
from tribo.registry.registry import default_registry
from tribo.result.checkpoint import hold
from tribo.simulation.run import Simulation
from tribo.study.runs import complete, is_done

GLANCE = 0.5
"""Interval between checks of the stop file, in s."""


def carry_out(
    case: dict[str, Any], path: str, stop: str, own: Sequence[tuple[str, str]] = ()
) -> tuple[str, str]:
    """Run a case into its file, or continue a stopped run; waits for a worker already at it.

    `own` has the modules and names of the classes that no plugin offers. The run stops once the
    file `stop` exists. Return ``"done"``, ``"interrupted"``, or ``"failed"`` and why.
    """
    result = Path(path)
    try:
        with _alone(result, Path(stop)):
            _know(own)
            with about(f"the worker on {socket.gethostname()} cannot compose this case"):
                simulation = Simulation(case)
            if not is_done(result, simulation):
                complete(simulation, result, [_StopFile(path=Path(stop))]).close()
    except Interrupted:
        return "interrupted", ""
    except TriboError as error:
        return "failed", str(error)
    except Exception as error:
        return "failed", f"{type(error).__name__}: {error}"
    return "done", ""


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold a lock file; it is created, and removed at the end.

    BusyError if another process or thread holds it, or has just released it.
    """
    with hold(path):
        try:
            yield
        finally:
            # Windows cannot remove an open file.
            with suppress(TriboError):
                remove(path)


def _know(own: Sequence[tuple[str, str]]) -> None:
    for module, name in own:
        try:
            default_registry().know(attrgetter(name)(import_module(module)))
        except (ImportError, AttributeError) as error:
            raise CaseError(
                f"a worker cannot import the class {name} from {module} ({error}); define it in a "
                "file that can be imported, outside of any function, and import it from there"
            ) from error


@contextmanager
def _alone(path: Path, stop: Path) -> Iterator[None]:
    """Hold the lock of a run; a worker of a killed sweep may still be at it, so wait for it."""
    while not stop.exists():
        try:
            with locked(path.with_suffix(".lock")):
                yield
                return
        except BusyError:
            time.sleep(GLANCE)
    raise Interrupted("stopped before it began")


class _StopFile(Observer):
    """Stop a run when a file appears."""

    type = "stop_file"
    path: Path
    _last: float = 0.0

    def on_step(self, snapshot: Snapshot) -> None:
        """Look for the file every half second."""
        now = time.monotonic()
        if now - self._last > GLANCE:
            self._last = now
            if self.path.exists():
                raise KeyboardInterrupt
