"""Submit runs to an executor, and repeat those whose worker died."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from pathlib import Path

from tribo.component import components
from tribo.core.errors import Interrupted, OutputError
from tribo.core.writing import remove, write_file
from tribo.registry.registry import default_registry
from tribo.simulation.interrupt import interrupts_held
from tribo.study.sweeping.runs_table import Run
from tribo.study.sweeping.worker import carry_out

ATTEMPTS = 3
"""Attempts at a run whose worker dies."""
TICK = 0.2
"""Interval between checks for Ctrl-C, in s."""
_GOES_ON = "finished runs are kept; the same command continues"


def carry(
    runs: Sequence[Run],
    executor: Executor,
    stop: Path,
    ended: Callable[[Run, str], None],
    patience: float | None = None,
) -> None:
    """Complete every run; if its worker dies, give it to another worker, up to three times.

    The file `stop` tells workers to stop; `ended` is called with each run that
    ends, and with the reason if it failed; `patience` is the time that workers
    may take to stop, in s. Interrupted if it was stopped from outside,
    OutputError if the executor has broken.
    """
    begun = Counter[int]()
    futures: dict[Future[tuple[str, str]], Run] = {}

    def submit(run: Run) -> None:
        begun[run.number] += 1
        what = run.case.model_dump(mode="json"), str(run.path.resolve()), str(stop.resolve())
        classes = {type(component) for _, component in components(run.case)}
        own = [(c.__module__, c.__qualname__) for c in classes if default_registry().is_own(c)]
        try:
            futures[executor.submit(carry_out, *what, own)] = run
        except Exception as error:
            raise OutputError(
                f"the executor takes no more runs ({type(error).__name__}: {error}); {_GOES_ON}"
            ) from error

    with interrupts_held() as requested:
        for run in runs:
            submit(run)
        while futures:
            done, _ = wait(futures, TICK, FIRST_COMPLETED)
            if requested.is_set():
                # Cancelling would lose track of runs that dask has started.
                write_file(stop)
                try:
                    wait(futures, patience)
                finally:
                    remove(stop)
                raise Interrupted("stopped; the same command continues")
            for future in done:
                run = futures.pop(future)
                why, lost = _outcome(future, run)
                if lost and begun[run.number] < ATTEMPTS:
                    submit(run)
                else:
                    ended(run, f"begun {ATTEMPTS} times, and each time {why}" if lost else why)


def _outcome(future: Future[tuple[str, str]], run: Run) -> tuple[str, bool]:
    """Return the reason of a failure, or "", and whether to try another worker."""
    try:
        status, why = future.result()
    except BrokenExecutor:
        return "its worker process died: was it killed, or out of memory?", True
    except CancelledError:
        raise OutputError(
            f"the executor dropped its runs: has its scheduler ended? {_GOES_ON.capitalize()}"
        ) from None
    except Exception as error:
        return f"its worker did not do it: {type(error).__name__}: {error}", True
    if status == "interrupted":
        return "its worker was stopped", True
    if status == "done" and not run.path.exists():
        folder = run.path.parent
        return f"its worker wrote to a folder of its own: all workers must share {folder}", True
    return why, False
