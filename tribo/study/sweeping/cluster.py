"""Runs on the workers of dask.distributed."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from queue import Empty, Queue
from threading import Thread
from typing import Any

from tribo.core.errors import CaseError, TriboWarning
from tribo.study.sweeping.processes import be_quiet, cores

PATIENCE = 15.0
"""How long a scheduler may take to answer, in s."""
ELSE = "something else may be listening there"


@contextmanager
def on_scheduler(address: str, patience: float = PATIENCE) -> Iterator[Executor]:
    """Connect to a scheduler that runs already.

    Parameters
    ----------
    address : str
        As ``"tcp://host:8786"``.
    patience : float, optional
        Time it may take to answer, in s.

    Raises
    ------
    CaseError
        If dask is not installed, or the scheduler does not answer.
    """
    client = _connected(_distributed(), address, patience)
    with client:
        if not client.scheduler_info(n_workers=-1)["workers"]:
            warnings.warn(
                f"the scheduler at {address} has no workers yet; the runs wait for some",
                TriboWarning,
                stacklevel=3,
            )
        yield client.get_executor(pure=False)


@contextmanager
def on_local_cluster(workers: int | None) -> Iterator[Executor]:
    """Start a scheduler and single-threaded workers on this machine, one a core if not told.

    Raises
    ------
    CaseError
        If dask is not installed.
    """
    distributed = _distributed()
    with (
        distributed.LocalCluster(
            n_workers=workers or cores(),
            threads_per_worker=1,
            dashboard_address=None,
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        client.register_worker_callbacks(be_quiet)
        yield client.get_executor(pure=False)


def _connected(distributed: Any, address: str, patience: float) -> Any:
    """Return a client; whatever answers at the address, and however, it does not take for ever."""
    answer: Queue[Any] = Queue()

    def connect() -> None:
        try:
            answer.put(distributed.Client(address, timeout=patience))
        except Exception as error:
            # What is no scheduler may answer anything, and dask raise anything of it.
            answer.put(error)

    # Dask's own time limit ends with the connection, not with the first answer.
    Thread(target=connect, daemon=True).start()
    try:
        found = answer.get(timeout=patience + 1.0)
    except Empty:
        found = TimeoutError(ELSE)
    if isinstance(found, Exception):
        raise CaseError(
            f"no scheduler answers at {address} within {patience:g} s ({_reason(found)}); start "
            "one with 'dask scheduler', and give the address that it prints"
        ) from None
    return found


def _distributed() -> Any:
    try:
        import distributed
    except ImportError:
        raise CaseError(
            "dask.distributed is not installed; install it with: pip install 'tribo[dask]'"
        ) from None
    # What it logs, tracebacks among it, is told by the errors that follow.
    for name in list(logging.root.manager.loggerDict):
        if name.split(".")[0] == "distributed":
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    return distributed


def _reason(error: Exception) -> str:
    if not isinstance(error, OSError | ValueError):
        # Bytes that mean something else were read as dask's.
        return ELSE
    return str(error).splitlines()[0] if str(error) else type(error).__name__
