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
from tribo.study.sweeping.worker import Task, carry_out, failure_path, write_failure

ATTEMPTS = 3
"""How often a run is begun whose worker dies."""
TICK = 0.2
"""Time between two looks at whether to stop, in s."""


def carry(
    tasks: Sequence[Task],
    executor: Executor,
    *,
    stop: Path,
    patience: float | None,
    tell: Callable[[str], None],
) -> None:
    """Have every task done.

    One whose worker dies is given to another worker, a few times; then it is
    recorded as failed.

    Parameters
    ----------
    tasks : sequence of Task
        What to do.
    executor : Executor
        What carries them.
    stop : Path
        The file that tells workers to stop.
    patience : float or None
        How long to wait for them when they are to stop, in s; None for as
        long as it takes.
    tell : callable
        Gets ``"done"`` or ``"failed"`` as a run ends.

    Raises
    ------
    Interrupted
        If it was stopped from outside.
    OutputError
        If the executor has broken.
    """
    begun: Counter[str] = Counter()
    futures: dict[Future[str], Task] = {}

    def submit(task: Task) -> None:
        begun[task.path] += 1
        futures[_submitted(executor, task)] = task

    with InterruptGuard() as guard:
        for task in tasks:
            submit(task)
        while futures:
            ended, _ = wait(futures, TICK, FIRST_COMPLETED)
            if guard.requested:
                _stop(futures, stop, patience)
            for future in ended:
                task = futures.pop(future)
                trouble = _trouble(future, task)
                if trouble is None:
                    tell("failed" if failure_path(Path(task.path)).exists() else "done")
                elif begun[task.path] < ATTEMPTS:
                    submit(task)
                else:
                    write_failure(
                        Path(task.path), f"begun {ATTEMPTS} times, and each time {trouble}"
                    )
                    tell("failed")


def _submitted(executor: Executor, task: Task) -> Future[str]:
    try:
        return executor.submit(carry_out, task.as_data())
    except Exception as error:
        raise OutputError(
            f"the executor takes no more runs ({type(error).__name__}: {error}); what is done is "
            "kept, and the same command goes on"
        ) from error


def _trouble(future: Future[str], task: Task) -> str | None:
    """Return in words why a run has not come to an end; None if it has."""
    try:
        status = future.result()
    except BrokenExecutor:
        return "its worker process died: was it killed, or out of memory?"
    except CancelledError:
        raise OutputError(
            "the executor dropped its runs: has its scheduler ended? What is done is kept, and the "
            "same command goes on"
        ) from None
    except Exception as error:
        return f"its worker did not do it: {type(error).__name__}: {error}"
    if status == "interrupted":
        return "its worker was stopped"
    path = Path(task.path)
    if not path.exists() and not failure_path(path).exists():
        return f"its worker wrote to a folder of its own: {path.parent} must be one that all share"
    return None


def _stop(futures: Collection[Future[str]], stop: Path, patience: float | None) -> None:
    """Let the workers stop; what has not begun then comes back at once.

    Cancelling instead would lose sight of runs that dask has begun.
    """
    stop.touch()
    try:
        wait(futures, patience)
    finally:
        stop.unlink(missing_ok=True)
    raise Interrupted("stopped; the same command goes on")
