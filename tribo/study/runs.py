"""Run variants into a folder; what is done already is not done again."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path

from tribo.core.errors import CaseError, OutputError, TriboError
from tribo.observers.observer import Observer
from tribo.registry.registry import Registry
from tribo.result.read import Result
from tribo.simulation.run import Simulation
from tribo.study.completion import complete, is_done
from tribo.study.variation import Variant

Observers = Callable[[], Sequence[Observer]]
_LONGEST_NAME = 100


def run_variants(
    variants: Sequence[Variant],
    folder: Path | None,
    *,
    registry: Registry | None = None,
    observers: Observers = list,
    tell: Callable[[str], None] = lambda text: None,
    overwrite: bool = False,
    alone: bool = False,
) -> list[Result]:
    """Run variants one after another, each into a file of a folder.

    A file there that is the finished result of the same case is taken as it
    is, and a run that was interrupted goes on.

    Parameters
    ----------
    variants : sequence of Variant
        What to run.
    folder : Path or None
        Where to; it is made if need be. In memory if None.
    registry : Registry, optional
        Where to look components up; the installed plugins if left out.
    observers : callable, optional
        Makes the watchers of a run.
    tell : callable, optional
        Gets a line on each run before it starts.
    overwrite : bool, optional
        Whether to run all anew, whatever is in the folder.
    alone : bool, optional
        Whether to refuse a folder that holds results of other variants.

    Returns
    -------
    list of Result
        The open results.

    Raises
    ------
    CaseError
        If the folder holds something else under the name of a variant.
    OutputError
        If the folder cannot be made.
    TriboError
        What a run raises; the message names the variant.
    """
    simulations = [Simulation(variant.case, registry) for variant in variants]
    paths: list[Path | None] = [None] * len(variants)
    if folder is not None:
        paths = [folder / name for name in file_names([variant.label for variant in variants])]
    if not overwrite:
        for path, simulation in zip(paths, simulations, strict=True):
            _check_own(path, simulation)
        if folder is not None and alone:
            _check_alone(folder, paths)
    if folder is not None:
        _make(folder)
    results = []
    for i, (variant, simulation) in enumerate(zip(variants, simulations, strict=True)):
        path, number = paths[i], f"{i + 1} of {len(variants)}, {variant.label}"
        if path is not None and not overwrite and is_done(path, simulation):
            tell(f"{number}: done already, {path}")
            results.append(Result.open(path))
            continue
        tell(number)
        try:
            if path is None or overwrite:
                results.append(simulation.run(path, observers=observers(), overwrite=True))
            else:
                results.append(complete(simulation, path, observers()))
        except TriboError as error:
            raise type(error)(f"{variant.label}: {error}") from error
    return results


def file_names(labels: Sequence[str]) -> list[str]:
    """Return a file name for each label, all different."""
    names: list[str] = []
    for label in labels:
        stem = re.sub(r"[^\w.,=+-]+", "_", label)[:_LONGEST_NAME]
        number = sum(name == stem or name.startswith(f"{stem}~") for name in names)
        names.append(f"{stem}~{number}" if number else stem)
    return [f"{name}.h5" for name in names]


def _check_alone(folder: Path, paths: Sequence[Path | None]) -> None:
    """Check that a folder holds no results of other variants."""
    others = sorted(path.name for path in folder.glob("*.h5") if path not in paths)
    if others:
        more = f" and {len(others) - 1} more" if len(others) > 1 else ""
        raise CaseError(
            f"{folder} holds another comparison, {others[0]}{more}; choose another folder with "
            "-o, or run all anew with --force"
        )


def _check_own(path: Path | None, simulation: Simulation) -> None:
    """Check that a file is not the result of another case; one that holds nothing is nobody's."""
    if path is None or not os.path.exists(path) or path.stat().st_size == 0:
        return
    otherwise = "choose another folder with -o, or run all anew with --force"
    try:
        with Result.open(path) as result:
            own = result.case == simulation.model.data
    except CaseError as error:
        raise CaseError(f"{error}; {otherwise}") from error
    if not own:
        raise CaseError(f"{path} is the result of another case; {otherwise}")


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the folder {folder}: {error.strerror}") from error
