"""Have runs carried out by an executor, and see them through."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from pathlib import Path

from tribo.core.errors import Interrupted, OutputError
from tribo.simulation.interrupt import InterruptGuard
from tribo.study.sweeping.runs_table import Run
from tribo.study.sweeping.worker import carry_out

ATTEMPTS = 3
"""How often a run is begun whose worker dies."""
TICK = 0.2
"""Time between two looks at whether to stop, in s."""
Outcome = tuple[str, str]


def carry(
    runs: Sequence[Run],
    executor: Executor,
    stop: Path,
    ended: Callable[[Run, str], None],
    patience: float | None = None,
) -> None:
    """Have every run done; one whose worker dies is given to another one, a few times.

    `stop` is the file that tells workers to stop, `ended` gets each run as it
    ends and why if it failed, and `patience` is how long workers may take to
    stop, in s.

    Raises
    ------
    Interrupted
        If it was stopped from outside.
    OutputError
        If the executor has broken.
    """
    begun = Counter[int]()
    futures: dict[Future[Outcome], Run] = {}

    def submit(run: Run) -> None:
        begun[run.number] += 1
        futures[_submitted(executor, run, stop)] = run

    with InterruptGuard() as guard:
        for run in runs:
            submit(run)
        while futures:
            done, _ = wait(futures, TICK, FIRST_COMPLETED)
            if guard.requested:
                _stop(futures, stop, patience)
            for future in done:
                run = futures.pop(future)
                status, why = _outcome(future, run)
                if status != "lost":
                    ended(run, why)
                elif begun[run.number] < ATTEMPTS:
                    submit(run)
                else:
                    ended(run, f"begun {ATTEMPTS} times, and each time {why}")


def _submitted(executor: Executor, run: Run, stop: Path) -> Future[Outcome]:
    case = run.case.model_dump(mode="json")
    try:
        return executor.submit(carry_out, case, str(run.path.resolve()), str(stop.resolve()))
    except Exception as error:
        raise OutputError(
            f"the executor takes no more runs ({type(error).__name__}: {error}); what is done is "
            "kept, and the same command goes on"
        ) from error


def _outcome(future: Future[Outcome], run: Run) -> Outcome:
    """Return what became of a run: ``"done"``, ``"failed"`` or ``"lost"``, and why."""
    try:
        status, why = future.result()
    except BrokenExecutor:
        return "lost", "its worker process died: was it killed, or out of memory?"
    except CancelledError:
        raise OutputError(
            "the executor dropped its runs: has its scheduler ended? What is done is kept, and the "
            "same command goes on"
        ) from None
    except Exception as error:
        return "lost", f"its worker did not do it: {type(error).__name__}: {error}"
    if status == "interrupted":
        return "lost", "its worker was stopped"
    if status == "done" and not run.path.exists():
        folder = run.path.parent
        return (
            "lost",
            f"its worker wrote to a folder of its own: {folder} must be one that all share",
        )
    return status, why


def _stop(futures: Collection[Future[Outcome]], stop: Path, patience: float | None) -> None:
    """Let the workers stop; what has not begun then comes back at once.

    Cancelling instead would lose sight of runs that dask has begun.
    """
    stop.touch()
    try:
        wait(futures, patience)
    finally:
        stop.unlink(missing_ok=True)
    raise Interrupted("stopped; the same command goes on")
