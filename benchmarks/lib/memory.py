"""Peak memory of a task, in a process of its own."""

from __future__ import annotations

import multiprocessing
import os
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar
from unittest.mock import patch

from benchmarks.lib.peers import Package
from benchmarks.lib.problems import CONTACTS
from tribo import Simulation, load_case

T = TypeVar("T")

PROCESSES = Path("/proc")
WARM_UP = 256


def peak_of_solve(
    package: type[Package], contact: str, cells: int, tolerance: float
) -> float | None:
    """Return the bytes a package takes to solve one of `CONTACTS`.

    None where Linux does not tell, and on grids no larger than the one that warms up,
    whose kernel may be used again.
    """
    return _alone(_solve, package, contact, cells, tolerance) if cells > WARM_UP else None


def peak_of_run(case: Path, overrides: list[str]) -> tuple[float, int] | None:
    """Return the bytes a process takes for a run, its result in a file, and the run's steps."""
    return _alone(_run, case, overrides)


def _alone(task: Callable[..., T], *arguments: object) -> T | None:
    if not PROCESSES.exists():
        return None
    # Spawned, so that it does not begin with the memory of this process.
    spawn = multiprocessing.get_context("spawn")
    # An array gets memory of its own, which goes back when the array does.
    own = patch.dict(os.environ, MALLOC_MMAP_THRESHOLD_="65536")
    with own, ProcessPoolExecutor(1, mp_context=spawn) as pool:
        return pool.submit(task, *arguments).result()


def _solve(package: type[Package], name: str, cells: int, tolerance: float) -> float:
    small, contact = CONTACTS[name](WARM_UP), CONTACTS[name](cells)
    warm_up = package(small, tolerance)
    warm_up.solve(small.gap)
    # Its peak begins again here: to make the contact took memory too.
    (PROCESSES / str(warm_up.process) / "clear_refs").write_text("5", encoding="utf-8")
    before = _status("VmRSS", warm_up.process)
    package(contact, tolerance).solve(contact.gap)
    return _status("VmHWM", warm_up.process) - before


def _run(case: Path, overrides: list[str]) -> tuple[float, int]:
    warnings.simplefilter("ignore")
    simulation = Simulation(load_case(case, overrides=overrides))
    with TemporaryDirectory() as folder, simulation.run(Path(folder) / "run.h5") as result:
        return _status("VmHWM", os.getpid()), int(result.totals()["steps"])


def _status(name: str, process: int) -> float:
    lines = (PROCESSES / str(process) / "status").read_text(encoding="utf-8").splitlines()
    return 1024.0 * int(next(x for x in lines if x.startswith(name)).split()[1])
