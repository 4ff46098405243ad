"""Results that are there already: what is finished is taken, what was begun goes on."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from tribo.core.errors import CaseError
from tribo.interfaces.observer import Observer, ObserverConfig
from tribo.results.read import Result
from tribo.simulation.describe import describe
from tribo.simulation.run import Simulation


def is_done(path: Path, simulation: Simulation) -> bool:
    """Return whether a file is the sound, finished result of a simulation as it is now."""
    if not path.exists():
        return False
    try:
        with Result.open(path) as result:
            result.check()
            return (
                result.status == "done"
                and result.case == describe(simulation.model)
                and not simulation.changed_since(result)
            )
    except CaseError:
        return False


def complete(
    simulation: Simulation, path: Path, observers: Sequence[Observer[ObserverConfig]]
) -> Result:
    """Go on with the run that a file was left by, or else run anew into it.

    Parameters
    ----------
    simulation : Simulation
        What to run.
    path : Path
        The result file; what is there and cannot be gone on with is lost.
    observers : sequence of Observer
        Watchers besides those of the case.

    Returns
    -------
    Result
        Open.

    Raises
    ------
    TriboError
        What a run raises.
    """
    if path.exists():
        try:
            return simulation.resume(path, observers=observers)
        except CaseError:
            # Nothing to go on from: no good checkpoint, or other versions of components.
            pass
    return simulation.run(path, observers=observers, overwrite=True)
