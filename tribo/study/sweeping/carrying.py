"""Submit runs to an executor, and stop them together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from pathlib import Path

from tribo.component import components
from tribo.core.errors import Interrupted
from tribo.core.writing import write_file
from tribo.registry.registry import default_registry
from tribo.simulation.interrupt import interrupts_held
from tribo.study.sweeping.runs_table import Run
from tribo.study.sweeping.worker import carry_out

TICK = 0.2
"""Interval between checks for Ctrl-C, in s, which is answered at once to the eye."""


def carry(runs: Sequence[Run], executor: Executor, stop: Path) -> Iterator[tuple[Run, str]]:
    """Complete every run; yield each as it ends, with the reason if it failed.

    Whatever ends this early makes the file `stop`, at which workers stop. Interrupted if it was
    stopped from outside.
    """
    futures: dict[Future[str], Run] = {}
    with interrupts_held() as requested:
        try:
            for run in runs:
                futures[_submitted(run, executor, stop)] = run
            left = set(futures)
            while left:
                done, left = wait(left, TICK, FIRST_COMPLETED)
                if requested.is_set():
                    raise Interrupted("stopped; the same command continues")
                for future in done:
                    yield futures[future], _failure(future, futures[future])
        except BaseException:
            # Cancelling would lose track of runs that dask has started.
            write_file(stop)
            wait(futures)
            raise


def _submitted(run: Run, executor: Executor, stop: Path) -> Future[str]:
    what = run.case.model_dump(mode="json"), str(run.path.resolve()), str(stop.resolve())
    classes = {type(component) for _, component in components(run.case)}
    own = [(c.__module__, c.__qualname__) for c in classes if default_registry().is_own(c)]
    return executor.submit(carry_out, *what, own)


def _failure(future: Future[str], run: Run) -> str:
    """Return the reason of a failure, or ""."""
    try:
        why = future.result()
    except BrokenExecutor:
        return "its worker process died: was it killed, or out of memory?"
    except Exception as error:
        return f"its worker did not do it: {type(error).__name__}: {error}"
    if not why and not run.path.exists():
        folder = run.path.parent
        return f"its worker wrote to a folder of its own: all workers must share {folder}"
    return why
