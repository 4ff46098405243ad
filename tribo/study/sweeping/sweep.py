"""Sweep: many runs of a case whose values vary."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from tribo.core.errors import CaseError, OutputError
from tribo.core.locks import BusyError
from tribo.result.checkpoint import fingerprint
from tribo.result.provenance import origin
from tribo.simulation.run import Simulation
from tribo.study.completion import is_done
from tribo.study.sweeping.carrying import carry
from tribo.study.sweeping.locks import locked
from tribo.study.sweeping.points import count, points
from tribo.study.sweeping.processes import Processes, cores
from tribo.study.sweeping.runs_table import Row, Run, outcome, runs_table, saves_table, write_csv
from tribo.study.sweeping.study_file import load_study
from tribo.study.sweeping.worker import Task, failure_path
from tribo.study.variation import variants

MANY = 1000
"""More runs than these are only made when that is said to be meant."""
PATIENCE = 30.0
"""How long runs on an executor of the user's may take to stop, in s."""
RUNS, SAVES, STOP, LOCK = "runs.csv", "saves.csv", "sweep.stop", "sweep.lock"


@dataclass(frozen=True)
class Progress:
    """How many runs of a sweep there are, are done and have failed."""

    total: int
    done: int
    failed: int


@dataclass(frozen=True)
class Sweep:
    """What a sweep leaves.

    Parameters
    ----------
    folder : Path
        Holds ``runs.csv``, ``saves.csv`` and the folder ``results``.
    runs : tuple of Run
        In the order of the study.
    rows : tuple of dict
        What ``runs.csv`` has of them, a row a run.
    """

    folder: Path
    runs: tuple[Run, ...]
    rows: tuple[Row, ...]

    def failures(self) -> dict[str, list[Run]]:
        """Return the runs that failed, by message."""
        found: dict[str, list[Run]] = {}
        for run, row in zip(self.runs, self.rows, strict=True):
            if row["status"] == "failed":
                found.setdefault(row["message"], []).append(run)
        return found


def sweep(
    study: str | Path,
    output: str | Path | None = None,
    *,
    executor: Executor | None = None,
    jobs: int | None = None,
    retry: bool = False,
    many: bool = False,
    tell: Callable[[Progress], None] = lambda progress: None,
) -> Sweep:
    """Run all cases of a study, in parallel.

    All are validated and composed before any is run. Nothing is done twice:
    finished results of the same case and components are taken as they are,
    stopped runs go on from their checkpoints. A failing run is recorded, and
    the others go on.

    Parameters
    ----------
    study : str or Path
        The file of the study.
    output : str or Path, optional
        Folder of the results; named as the study, with ``-sweep``, if left out.
    executor : Executor, optional
        What carries the runs; processes on this machine if left out. It gets
        a function that its workers can import, and plain data. They must see
        `output` under the same name. It is left open.
    jobs : int, optional
        Number of processes if there is no `executor`; a core each if left out.
    retry : bool, optional
        Whether to run again what failed before.
    many : bool, optional
        Whether more than 1000 runs are meant.
    tell : callable, optional
        Gets a `Progress` at the beginning and as each run ends.

    Returns
    -------
    Sweep
        Where the results are, and a table of them.

    Raises
    ------
    CaseError
        If the study or any of its cases is not valid, or another sweep is
        writing to the folder.
    OutputError
        If the folder cannot be written to, or the executor has broken.
    Interrupted
        If it was stopped from outside; calling it again goes on.
    """
    study = Path(study)
    folder = Path(output) if output is not None else study.with_name(f"{study.stem}-sweep")
    runs, paths = plan(study, folder, many=many)
    with _holding(folder):
        for name in (RUNS, SAVES):
            # A table that is there agrees with the results; while they change, there is none.
            (folder / name).unlink(missing_ok=True)
        try:
            _complete(runs, folder / STOP, executor, jobs, retry, tell)
        finally:
            rows = runs_table(runs, paths)
            write_csv(folder / RUNS, rows)
            write_csv(folder / SAVES, saves_table(runs, paths))
    return Sweep(folder, tuple(runs), tuple(rows))


def plan(study: Path, folder: Path, *, many: bool = False) -> tuple[list[Run], list[str]]:
    """Return the runs of a study, all validated, and the paths of what varies.

    Raises
    ------
    CaseError
        If the study or any of its cases is not valid, or they are more than
        1000 and `many` does not say that this is meant.
    """
    tables, data = load_study(study)
    number = count(tables)
    if number > MANY and not many:
        raise CaseError(f"{study} asks for {number} runs; if that is meant, give --yes")
    settings = points(tables, data)
    runs = []
    for i, variant in enumerate(variants(data, settings), start=1):
        # The name stands for the case, so that a study may grow and nothing is done twice.
        name = fingerprint(variant.case.model_dump(mode="json"))[:16]
        runs.append(Run(i, variant.label, variant.case, folder / "results" / f"{name}.h5"))
    return runs, list({path: None for point in settings for path in point})


@contextmanager
def _holding(folder: Path) -> Iterator[None]:
    """Make the folder, and keep other sweeps out of it."""
    try:
        (folder / "results").mkdir(parents=True, exist_ok=True)
        with locked(folder / LOCK):
            (folder / STOP).unlink(missing_ok=True)
            yield
    except BusyError:
        raise CaseError(
            f"another sweep is writing to {folder}; wait for it, or choose another folder with -o"
        ) from None
    except OSError as error:
        raise OutputError(f"cannot write to {folder}: {error.strerror or error}") from error


def _complete(
    runs: Sequence[Run],
    stop: Path,
    executor: Executor | None,
    jobs: int | None,
    retry: bool,
    tell: Callable[[Progress], None],
) -> None:
    """Carry out what has not ended before."""
    if retry:
        for run in runs:
            failure_path(run.path).unlink(missing_ok=True)
    left, ended = [], Counter[str]()
    for run in runs:
        if _has_ended(run):
            ended[outcome(run).status] += 1
        else:
            left.append(run)

    def report(status: str) -> None:
        ended[status] += 1
        tell(Progress(len(runs), ended["done"], ended["failed"]))

    tell(Progress(len(runs), ended["done"], ended["failed"]))
    tasks = [_task(run, stop) for run in left]
    if executor is not None:
        carry(tasks, executor, stop=stop, patience=PATIENCE, tell=report)
    elif tasks:
        processes = Processes(min(jobs or cores(), len(tasks)))
        try:
            carry(tasks, processes, stop=stop, patience=None, tell=report)
        except BaseException:
            processes.kill()
            raise
        processes.shutdown()


def _has_ended(run: Run) -> bool:
    if failure_path(run.path).exists():
        return True
    return run.path.exists() and is_done(run.path, Simulation(run.case))


def _task(run: Run, stop: Path) -> Task:
    return Task(
        case=run.case.model_dump(mode="json"),
        path=str(run.path.resolve()),
        stop=str(stop.resolve()),
        validated_with=_makers(run),
    )


def _makers(run: Run) -> str:
    """Return the distributions that the components of a run come from."""
    made = [origin(component) for _, component in Simulation(run.case).model.case.components()]
    origins = {f"{each['distribution']} {each['version']}" for each in made}
    return ", ".join(sorted(origins))
