"""Peak memory of a task, in a process of its own."""

from __future__ import annotations

import multiprocessing
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

from benchmarks.lib.peers import Tribo
from benchmarks.lib.problems import ball
from tribo import Simulation, load_case

T = TypeVar("T")

STATUS = Path("/proc/self/status")
WARM_UP = 64


def peak_of_solve(cells: int, width: float, tolerance: float) -> float | None:
    """Return the bytes a cold solve takes beyond its problem; None where Linux does not tell."""
    return _alone(_solve, cells, width, tolerance)


def peak_of_run(case: Path, overrides: list[str]) -> tuple[float, int] | None:
    """Return the bytes a process takes for a run, its result in a file, and the run's steps."""
    return _alone(_run, case, overrides)


def _alone(task: Callable[..., T], *arguments: object) -> T | None:
    if not STATUS.exists():
        return None
    # Spawned, so that it does not begin with the memory of this process.
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=spawn) as pool:
        return pool.submit(task, *arguments).result()


def _solve(cells: int, width: float, tolerance: float) -> float:
    small = ball(WARM_UP, width=width)
    Tribo(small, tolerance).solve(small.gap)
    contact = ball(cells, width=width)
    solver = Tribo(contact, tolerance)
    before = _status("VmRSS")
    solver.solve(contact.gap)
    return _status("VmHWM") - before


def _run(case: Path, overrides: list[str]) -> tuple[float, int]:
    warnings.simplefilter("ignore")
    simulation = Simulation(load_case(case, overrides=overrides))
    with TemporaryDirectory() as folder, simulation.run(Path(folder) / "run.h5") as result:
        return _status("VmHWM"), int(result.totals()["steps"])


def _status(name: str) -> float:
    lines = STATUS.read_text(encoding="utf-8").splitlines()
    return 1024.0 * int(next(x for x in lines if x.startswith(name)).split()[1])
