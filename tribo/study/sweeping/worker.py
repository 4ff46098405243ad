"""Run one case of a sweep in a worker."""

from __future__ import annotations

import socket
from collections.abc import Sequence
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import Any

from tribo.core.errors import CaseError, Interrupted, TriboError, about
from tribo.core.state import Snapshot
from tribo.observers.observer import Observer
from tribo.registry.registry import default_registry
from tribo.simulation.run import Simulation
from tribo.study.runs import complete


def carry_out(
    case: dict[str, Any], path: str, stop: str, own: Sequence[tuple[str, str]] = ()
) -> str:
    """Run a case into its file, or continue a stopped run; return why it failed, or "".

    `own` has the modules and names of the classes that no plugin offers. The run stops once the
    file `stop` exists.
    """
    result = Path(path)
    if Path(stop).exists():
        return "stopped before it began"
    try:
        _know(own)
        with about(f"the worker on {socket.gethostname()} cannot compose this case"):
            simulation = Simulation(case)
        complete(simulation, result, [_StopFile(path=Path(stop))]).close()
    except Interrupted:
        return "its worker was stopped"
    except TriboError as error:
        return str(error)
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return ""


def _know(own: Sequence[tuple[str, str]]) -> None:
    for module, name in own:
        try:
            default_registry().know(attrgetter(name)(import_module(module)))
        except (ImportError, AttributeError) as error:
            raise CaseError(
                f"a worker cannot import the class {name} from {module} ({error}); define it in a "
                "file that can be imported, outside of any function, and import it from there"
            ) from error


class _StopFile(Observer):
    """Stop a run when a file appears."""

    path: Path

    def on_step(self, snapshot: Snapshot) -> None:
        """Look for the file."""
        if self.path.exists():
            raise KeyboardInterrupt
