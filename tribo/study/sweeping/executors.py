"""The executor of a sweep: processes on this machine."""

from __future__ import annotations

import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context, parent_process
from typing import ParamSpec, TypeVar

from tribo.core.errors import TriboWarning
from tribo.registry.plugin_file import add_files, added_files

P = ParamSpec("P")
R = TypeVar("R")

THREADS = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
    "NUMEXPR_NUM_THREADS",
)


@contextmanager
def processes(count: int | None = None) -> Iterator[Executor]:
    """Run calls in single-threaded processes, by default one per core; they end with this one."""
    cores = os.cpu_count() or 1
    if sys.platform == "linux":
        cores = len(os.sched_getaffinity(0))
    with _environment(), _Processes(count or cores) as executor:
        yield executor


class _Processes(ThreadPoolExecutor):
    """Threads with one process each, so that a dying process loses only its own call."""

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self._mine = threading.local()
        self._pools: list[ProcessPoolExecutor] = []

    def submit(self, fn: Callable[P, R], /, *args: P.args, **kwargs: P.kwargs) -> Future[R]:
        return super().submit(self._in_process, partial(fn, *args, **kwargs))

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        super().shutdown(cancel_futures=cancel_futures)
        for pool in self._pools:
            pool.shutdown()

    def _in_process(self, call: Callable[[], R]) -> R:
        if getattr(self._mine, "pool", None) is None:
            spawned = get_context("spawn")
            begin = _begin, (added_files(),)
            self._mine.pool = ProcessPoolExecutor(1, spawned, *begin)
            self._pools.append(self._mine.pool)
        try:
            return self._mine.pool.submit(call).result()  # type: ignore[no-any-return]
        except BrokenProcessPool:
            self._mine.pool = None
            raise


@contextmanager
def _environment() -> Iterator[None]:
    """Limit processes that start now to one thread each for linear algebra.

    They import nothing from the folder that they start in.
    """
    before = dict(os.environ)
    os.environ.update(dict.fromkeys(THREADS, "1"), PYTHONSAFEPATH="1")
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


def _begin(files: Sequence[str]) -> None:
    """Prepare a process: ignore Ctrl-C, end with the parent, and let plugins of files take part."""
    parent = parent_process()
    assert parent is not None

    def end() -> None:
        parent.join()
        os._exit(1)

    # The results hold the warnings of the runs.
    warnings.simplefilter("ignore", TriboWarning)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=end, daemon=True).start()
    add_files(files)
