"""One run of a sweep, carried out wherever its executor has it done."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from tribo.core.errors import CaseError, Interrupted, TriboError
from tribo.core.locks import BusyError
from tribo.core.state import Snapshot
from tribo.observers.observer import Observer
from tribo.simulation.run import Simulation
from tribo.study.completion import complete, is_done
from tribo.study.sweeping.locks import locked

GLANCE = 0.5
"""Time between two looks at whether to stop, in s."""


@dataclass(frozen=True)
class Task:
    """What a worker is told of a run; plain data, so that it can go to any machine.

    Parameters
    ----------
    case : dict
        The case, as plain data.
    path : str
        The result file to write, absolute.
    stop : str
        A file; when it is there, the run is to stop.
    validated_with : str
        The distributions that its components come from where it was validated.
    """

    case: dict[str, Any]
    path: str
    stop: str
    validated_with: str

    def as_data(self) -> dict[str, Any]:
        """Return the task as a dictionary."""
        return asdict(self)


def carry_out(data: dict[str, Any]) -> str:
    """Run a case into its file, or go on with what is there; never both of two workers at once.

    Parameters
    ----------
    data : dict
        A `Task`.

    Returns
    -------
    str
        ``"done"``, ``"interrupted"``, or ``"failed"``: the message is then in
        the file at `failure_path`.
    """
    task = Task(**data)
    path, stop = Path(task.path), Path(task.stop)
    try:
        with _alone(path, stop):
            _run(task, path, stop)
        return "done"
    except Interrupted:
        return "interrupted"
    except TriboError as error:
        message = str(error)
    except Exception as error:
        message = f"{type(error).__name__}: {error}"
    write_failure(path, message)
    return "failed"


def failure_path(result: Path) -> Path:
    """Return the file that says why a run failed."""
    return result.with_suffix(".failed.txt")


def write_failure(result: Path, message: str) -> None:
    """Keep why a run failed."""
    path = failure_path(result)
    fresh = path.with_name(path.name + ".new")
    fresh.write_text(message + "\n", encoding="utf-8")
    fresh.replace(path)


def _run(task: Task, path: Path, stop: Path) -> None:
    try:
        simulation = Simulation(task.case)
    except CaseError as error:
        raise CaseError(
            f"the worker on {socket.gethostname()} cannot compose this case: {error} (it was "
            f"validated with {task.validated_with}; install the same there, then use --retry)"
        ) from error
    if is_done(path, simulation):
        return
    complete(simulation, path, [_StopFile(path=stop)]).close()


@contextmanager
def _alone(path: Path, stop: Path) -> Iterator[None]:
    """Wait for another worker that is at the same run, left over from a sweep that was killed."""
    while True:
        if stop.exists():
            raise Interrupted("stopped before it began")
        try:
            with locked(path.with_suffix(".lock")):
                yield
            return
        except BusyError:
            time.sleep(GLANCE)


class _StopFile(Observer):
    """Stops a run when a file appears."""

    type = "stop_file"
    path: Path
    _last: float = 0.0

    def on_step(self, snapshot: Snapshot) -> None:
        """Now and then look for the file."""
        now = time.monotonic()
        if now - self._last > GLANCE:
            self._last = now
            if self.path.exists():
                raise KeyboardInterrupt
