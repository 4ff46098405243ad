"""Run a case into a file: take a finished result, or continue a stopped run."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from tribo.case import Case
from tribo.core.errors import CaseError, warn
from tribo.core.writing import make_folder
from tribo.observers.observer import Observer
from tribo.result.read import Result
from tribo.simulation.run import Simulation

_LONGEST_NAME = 100
"""Characters, of up to two bytes; file systems allow 255 bytes with the ending."""


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
    """Return the result of a file that is done; else continue its run, or run from the beginning.

    A file that cannot be resumed is replaced, with a warning that names the reason.
    """
    if is_done(path, simulation):
        return Result.open(path)
    if os.path.exists(path):
        try:
            return simulation.resume(path, observers=observers)
        except CaseError as error:
            # There is no sound checkpoint, or components have changed.
            warn(f"{path} is started again: {error}")
    return simulation.run(path, observers=observers, overwrite=True)


def own_files(cases: Mapping[str, Case], folder: Path) -> list[Path]:
    """Make a folder for the results of cases, and return their files, named after their labels.

    `CaseError` if a file is no result of its case.
    """
    files = [folder / name for name in file_names(list(cases))]
    for path, case in zip(files, cases.values(), strict=True):
        # A killed run may leave an empty file.
        if os.path.exists(path) and path.stat().st_size > 0:
            with Result.open(path) as result:
                if result.case_tables != Simulation(case).model.data:
                    raise CaseError(
                        f"{path} is the result of another case; choose another folder with -o"
                    )
    make_folder(folder)
    return files


def file_names(labels: Sequence[str]) -> list[str]:
    """Return a file name for each label, all different."""
    stems = [re.sub(r"[^\w.,=+-]+", "_", label)[:_LONGEST_NAME] for label in labels]
    before = [stems[:i].count(stem) for i, stem in enumerate(stems)]
    return [f"{stem}~{n}.h5" if n else f"{stem}.h5" for stem, n in zip(stems, before, strict=True)]
