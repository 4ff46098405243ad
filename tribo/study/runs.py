"""Run a case into a file: take a finished result, or continue a stopped run."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from tribo.case import Case
from tribo.core.errors import CaseError, about, warn
from tribo.core.writing import make_folder
from tribo.observers.observer import Observer
from tribo.registry.registry import Registry
from tribo.result.read import Result
from tribo.simulation.run import Simulation

_LONGEST_NAME = 100
"""Characters, of up to two bytes; file systems allow 255 bytes with the ending."""
_OTHERWISE = (
    "choose another folder with -o, or run all again with --force (in Python overwrite=True)"
)


def is_done(path: Path, simulation: Simulation) -> bool:
    """Return whether a file is the sound, finished result of a simulation with these components."""
    if not os.path.exists(path):
        return False
    try:
        with Result.open(path) as result:
            return (
                result.status == "done"
                and result.case_tables == simulation.model.data
                and not simulation.changed_since(result)
            )
    except CaseError:
        return False


def complete(simulation: Simulation, path: Path, observers: Sequence[Observer]) -> Result:
    """Continue the stopped run of a file, or else run the case from its beginning.

    A file that cannot be resumed is replaced, with a warning that names the reason.
    """
    if os.path.exists(path):
        try:
            go_on = simulation.reopen(path, observers=observers)
        except CaseError as error:
            # There is no sound checkpoint, or components have changed.
            warn(f"{path} is started again: {error}")
        else:
            return go_on()
    return simulation.run(path, observers=observers, overwrite=True)


def run_variants(
    cases: Mapping[str, Case],
    folder: Path | None,
    *,
    registry: Registry | None = None,
    observers: Callable[[], Sequence[Observer]] = list,
    tell: Callable[[str], None] = lambda text: None,
    overwrite: bool = False,
) -> list[Result]:
    """Run cases one after another, each into a file of a folder, named after its label.

    Finished results of the same cases are taken as they are, and interrupted
    runs are continued; see `tribo.compare`. CaseError if a file is no result
    of its case.
    """
    simulations = [Simulation(case, registry) for case in cases.values()]
    paths = [folder / name if folder else None for name in file_names(list(cases))]
    if folder is not None:
        for path, simulation in zip(paths, simulations, strict=True):
            if path is not None and not overwrite:
                _check_own(path, simulation)
        make_folder(folder)
    results = []
    for number, (label, path, simulation) in enumerate(
        zip(cases, paths, simulations, strict=True), start=1
    ):
        done = path is not None and not overwrite and is_done(path, simulation)
        tell(f"{number} of {len(cases)}, {label}" + (f": done already, {path}" if done else ""))
        with about(label):
            if path is None or overwrite:
                results.append(simulation.run(path, observers=observers(), overwrite=True))
            elif done:
                results.append(Result.open(path))
            else:
                results.append(complete(simulation, path, observers()))
    return results


def file_names(labels: Sequence[str]) -> list[str]:
    """Return a file name for each label, all different."""
    stems = [re.sub(r"[^\w.,=+-]+", "_", label)[:_LONGEST_NAME] for label in labels]
    before = [stems[:i].count(stem) for i, stem in enumerate(stems)]
    return [f"{stem}~{n}.h5" if n else f"{stem}.h5" for stem, n in zip(stems, before, strict=True)]


def _check_own(path: Path, simulation: Simulation) -> None:
    """Check that a file, if there is one, is a result of this simulation."""
    # A killed run may leave an empty file.
    if not os.path.exists(path) or path.stat().st_size == 0:
        return
    try:
        with Result.open(path) as result:
            own = result.case_tables == simulation.model.data
    except CaseError as error:
        raise CaseError(f"{error}; {_OTHERWISE}") from error
    if not own:
        raise CaseError(f"{path} is the result of another case; {_OTHERWISE}")
