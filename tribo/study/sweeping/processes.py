"""Worker processes on this machine.

Nothing here imports NumPy: a worker has its threads limited before it does.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait
from typing import ParamSpec, TypeVar

import psutil

from tribo.core.errors import TriboWarning

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
_starting = threading.Lock()


def cores() -> int:
    """Return how many cores this process may use."""
    if sys.platform == "linux":
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Processes(ThreadPoolExecutor):
    """Single-threaded worker processes, each a pool of its own.

    The death of one then costs the run that it was at, and no other: that
    run's future raises `BrokenProcessPool`, and a new worker takes its place.

    Parameters
    ----------
    count : int
        How many.
    """

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self._mine = threading.local()
        self._workers: dict[int, ProcessPoolExecutor] = {}
        self._killed = False

    def submit(self, fn: Callable[P, R], /, *args: P.args, **kwargs: P.kwargs) -> Future[R]:
        """Have a worker call a function that can be imported, with plain data."""

        def in_worker() -> R:
            number = self._worker()
            try:
                return self._workers[number].submit(fn, *args, **kwargs).result()
            except BrokenProcessPool:
                self._workers.pop(number).shutdown()
                raise

        return super().submit(in_worker)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Let the workers end what they do, and then end."""
        super().shutdown(wait=True, cancel_futures=cancel_futures)
        for pool in self._workers.values():
            pool.shutdown()

    def kill(self) -> None:
        """End the workers at once, in the middle of what they do."""
        self._killed = True
        for number in list(self._workers):
            with suppress(psutil.NoSuchProcess):
                psutil.Process(number).kill()
        self.shutdown(cancel_futures=True)

    def _worker(self) -> int:
        """Return the worker of this thread, by the number of its process."""
        number: int | None = getattr(self._mine, "number", None)
        if number not in self._workers:
            with _starting, _environment():
                pool = ProcessPoolExecutor(1, mp_context=get_context("spawn"), initializer=_begin)
                # The process starts with the first call.
                first = pool.submit(os.getpid)
            number = self._mine.number = first.result()
            self._workers[number] = pool
        if self._killed:
            raise BrokenProcessPool("the workers are killed")
        return number


@contextmanager
def _environment() -> Iterator[None]:
    """Give processes that start now one thread each for linear algebra.

    The one that tidies up after this process, should it be killed, does so in silence.
    """
    quiet = os.environ.get("PYTHONWARNINGS"), "ignore:::multiprocessing.resource_tracker"
    changed = dict.fromkeys(THREADS, "1") | {"PYTHONWARNINGS": ",".join(filter(None, quiet))}
    before = {name: os.environ.get(name) for name in changed}
    os.environ.update(changed)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def be_quiet() -> None:
    """Keep a worker from printing what its runs warn of, which is in their results."""
    warnings.simplefilter("ignore", TriboWarning)


def _begin() -> None:
    """Prepare a worker: its parent hears Ctrl-C, and it does not outlive its parent."""
    be_quiet()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)
