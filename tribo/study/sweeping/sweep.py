"""Sweep: many runs of a case whose values vary."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas

from tribo.case import Case
from tribo.config.load import case_tables
from tribo.core.errors import CaseError
from tribo.core.writing import make_folder, remove, write_file, writing
from tribo.result.checkpoint import fingerprint, hold
from tribo.simulation.run import Simulation
from tribo.study.runs import is_done
from tribo.study.sweeping.carrying import carry
from tribo.study.sweeping.executors import processes
from tribo.study.sweeping.runs_table import Run, runs_table
from tribo.study.variation import points_of, variants

RUNS, STOP, LOCK = "runs.csv", "sweep.stop", "sweep.lock"


@dataclass(frozen=True)
class Sweep:
    """The results of a sweep.

    Parameters
    ----------
    folder : Path
        Holds ``runs.csv`` and the folder ``results``.
    runs : tuple of Run
        In the order of their settings.
    table : pandas.DataFrame
        The table in ``runs.csv``, one row per run.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> from tempfile import TemporaryDirectory
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> loads = {"load.normal": ["50 N", "100 N"]}
    >>> with TemporaryDirectory() as folder, ThreadPoolExecutor(1) as workers:
    ...     swept = tribo.sweep(case, loads, folder, executor=workers)
    >>> swept.failures(), swept.table["distance_m"].round(1).tolist()  # until 1 µm is worn
    ({}, [1.8, 1.3])
    """

    folder: Path
    runs: tuple[Run, ...] = field(repr=False)
    table: pandas.DataFrame

    def _repr_html_(self) -> str:
        return str(self.table.to_html())

    def failures(self) -> dict[str, list[Run]]:
        """Return the runs that failed, by message."""
        failed = self.table[self.table["status"] == "failed"]
        return {
            str(message): [self.runs[i] for i in group.index]
            for message, group in failed.groupby("message", sort=False)
        }

    def as_json(self) -> dict[str, Any]:
        """Return the folder and the rows of the table as plain data."""
        rows = self.table.astype(object).where(self.table.notna(), None)
        return {"folder": str(self.folder), "runs": rows.to_dict("records")}


def sweep(
    what: Case | Mapping[str, Any] | str | Path,
    vary: Mapping[str, Sequence[Any]] | Sequence[Mapping[str, Any]],
    folder: str | Path | None = None,
    *,
    executor: Executor | None = None,
    jobs: int | None = None,
    tell: Callable[[int, int, int], None] = lambda total, done, failed: None,
) -> Sweep:
    """Run variants of a case, in parallel.

    All are validated and composed before any is run. Finished results of the same case and
    components are reused, stopped runs continue from their checkpoints, and failed runs are
    repeated. A failing run is recorded, and the others continue.

    Parameters
    ----------
    what : Case, Mapping, str or Path
        The case: itself, its tables, or its TOML file.
    vary : Mapping or sequence of Mapping
        Values by path, every combination of which is run; or the settings of
        each run, values by path.
    folder : str or Path, optional
        Folder of the results; named as the file, with ``-sweep``, if left out.
    executor : Executor, optional
        Runs the cases; processes on this machine if left out. It gets a function that its workers
        can import, and plain data. They must see `folder` under the same path. It is left open.
    jobs : int, optional
        Number of processes if there is no `executor`; a core each if left out.
    tell : callable, optional
        Gets the numbers of all, finished and failed runs, at the beginning and
        as each run ends.

    Returns
    -------
    Sweep
        Where the results are, and a table of them.

    Raises
    ------
    CaseError
        If any of the cases is not valid, or another sweep is writing to the
        folder.
    OutputError
        If the folder cannot be written to.
    Interrupted
        If it was stopped from outside; calling it again continues.

    Examples
    --------
    >>> from concurrent.futures import ThreadPoolExecutor
    >>> from tempfile import TemporaryDirectory
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> rates = {"bodies.ball.wear.k": [1e-16, 1e-15]}
    >>> with TemporaryDirectory() as folder, ThreadPoolExecutor(1) as workers:
    ...     swept = tribo.sweep(case, rates, folder, executor=workers)
    >>> swept.table["distance_m"].round(1).tolist()
    [4.2, 0.4]
    """
    if folder is None:
        if not isinstance(what, str | Path):
            raise CaseError("a case in memory has no name; give the folder of the results")
        folder = Path(what).with_name(f"{Path(what).stem}-sweep")
    folder = Path(folder)
    runs, paths = plan(what, vary, folder)
    with _holding(folder):
        # A table must agree with the results, so there is none while they change.
        remove(folder / RUNS)
        left = [run for run in runs if not is_done(run.path, Simulation(run.case))]
        done, failures = len(runs) - len(left), dict[str, str]()
        tell(len(runs), done, 0)
        try:
            with nullcontext(executor) if executor else processes(jobs) as workers:
                for run, failure in carry(left, workers, folder / STOP):
                    if failure:
                        failures[run.path.name] = failure
                    done += not failure
                    tell(len(runs), done, len(failures))
        finally:
            table = runs_table(runs, paths, failures)
            write_file(folder / RUNS, table.dropna(axis=1, how="all").to_csv(index=False))
    return Sweep(folder, tuple(runs), table)


def plan(
    what: Case | Mapping[str, Any] | str | Path,
    vary: Mapping[str, Sequence[Any]] | Sequence[Mapping[str, Any]],
    folder: Path,
) -> tuple[list[Run], list[str]]:
    """Return the runs of a sweep, all validated, and the paths that vary."""
    settings = points_of(vary)
    runs = []
    for i, (label, case) in enumerate(variants(case_tables(what), settings).items(), start=1):
        # Named after the case, so that a sweep may grow and nothing runs twice.
        name = fingerprint(case.model_dump(mode="json"))[:16]
        runs.append(Run(i, label, case, folder / "results" / f"{name}.h5"))
    return runs, list({path: None for point in settings for path in point})


@contextmanager
def _holding(folder: Path) -> Iterator[None]:
    """Create the folder, and lock it against other sweeps."""
    with writing(folder):
        make_folder(folder / "results")
        # This raises if the folder cannot be entered.
        os.listdir(folder / "results")
    try:
        lock = hold(folder / LOCK)
    except BlockingIOError:
        raise CaseError(
            f"another sweep is writing to {folder}; wait for it, or choose another folder with -o"
        ) from None
    with lock, writing(folder):
        remove(folder / STOP)
        yield
