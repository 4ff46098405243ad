"""Results that are there already: what is finished is taken, what was begun goes on."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from pathlib import Path

from tribo.core.errors import CaseError, TriboWarning
from tribo.observers.observer import Observer
from tribo.result.read import Result
from tribo.simulation.run import Simulation


def is_done(path: Path, simulation: Simulation) -> bool:
    """Return whether a file is the sound, finished result of a simulation as it is now."""
    if not os.path.exists(path):
        return False
    try:
        with Result.open(path) as result:
            result.check()
            return (
                result.status == "done"
                and result.case == simulation.model.data
                and not simulation.changed_since(result)
            )
    except CaseError:
        return False


def complete(simulation: Simulation, path: Path, observers: Sequence[Observer]) -> Result:
    """Go on with the run that a file was left by, or else run anew into it.

    Parameters
    ----------
    simulation : Simulation
        What to run.
    path : Path
        The result file; what is there and cannot be gone on with is lost, with
        a warning that says why.
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
    if os.path.exists(path):
        try:
            go_on = simulation.reopen(path, observers=observers)
        except CaseError as error:
            # Nothing to go on from: no good checkpoint, or other versions of components.
            warnings.warn(f"{path} is begun anew: {error}", TriboWarning, stacklevel=2)
        else:
            return go_on()
    return simulation.run(path, observers=observers, overwrite=True)
