"""What every benchmark does: interleave, take medians, print a table, write JSON."""

from __future__ import annotations

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path
from typing import Any

import scipy.fft
from rich.console import Console
from rich.table import Table

Row = dict[str, Any]
Tables = dict[str, list[Row]]

PACKAGES = (
    "tribo",
    "tribo-fast",
    "numpy",
    "scipy",
    "aspher",
    "tamaas",
    "ContactMechanics",
    "SurfaceTopography",
    "slippy",
)
LEAST_TURN = 0.05
SLIPPY = "SLIPPY_PYTHON"
"""Environment variable that names the interpreter, Python 3.9, with slippy."""
BLAS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def main(
    about: str | None,
    add_options: Callable[[argparse.ArgumentParser], None],
    measure: Callable[[argparse.Namespace], Tables],
) -> None:
    """Measure with the options of the command line; print the tables, write the JSON."""
    parser = argparse.ArgumentParser(
        description=about, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--json", type=Path, help="file to write the figures to")
    add_common_options(parser)
    add_options(parser)
    options = parser.parse_args()
    limit_threads(options.threads)
    # A benchmark says where it measures compiled code.
    os.environ["TRIBO_FAST"] = "0"
    # Those of tribo are about coarse grids, which a smoke run has.
    warnings.simplefilter("ignore")
    tables = measure(options)
    chosen = {name: value for name, value in vars(options).items() if name != "json"}
    found = {"machine": machine(options.threads), "options": chosen, "tables": tables}
    for title, rows in tables.items():
        show(title, rows)
    for name in PACKAGES:
        if found["machine"]["packages"][name] is None:
            print(f"{name} is not installed and took no part: see benchmarks/README.md")
    if options.json:
        write(options.json, found)


def add_common_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that all benchmarks have."""
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=5, help="interleaved rounds")


def limit_threads(threads: int) -> None:
    """Let the libraries start no more than `threads`; starts the program anew for it."""
    if any(os.environ.get(name) != str(threads) for name in BLAS):
        # They look once, when they are imported.
        os.environ.update(dict.fromkeys(BLAS, str(threads)))
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])


class CpuTime:
    """CPU time in s of this process, and of the processes that solve for it."""

    def __init__(self) -> None:
        self.elsewhere = 0.0

    def __call__(self) -> float:
        """Return the time so far."""
        return time.process_time() + self.elsewhere


cpu_time = CpuTime()


def interleaved(
    actions: Mapping[str, Callable[[], object]], repeats: int, threads: int = 1
) -> dict[str, list[float]]:
    """Return for each action its times in s, one a round; the actions take turns.

    In its turn an action is repeated for at least `LEAST_TURN` seconds and the
    mean is taken. With one thread the clock is the CPU time, which other programs
    on the machine disturb least; with more it is the wall.
    """
    clock = cpu_time if threads == 1 else time.perf_counter
    times: dict[str, list[float]] = {name: [] for name in actions}
    with scipy.fft.set_workers(threads):
        for _ in range(repeats):
            for name, action in actions.items():
                begun, calls = clock(), 0
                while not calls or clock() - begun < LEAST_TURN:
                    action()
                    calls += 1
                times[name].append((clock() - begun) / calls)
    return times


def ratio(slow: Sequence[float], fast: Sequence[float]) -> Row:
    """Return the ratio of two medians, and the range of the ratios of single rounds."""
    rounds = [s / f for s, f in zip(slow, fast, strict=True)]
    return {
        "ratio": statistics.median(slow) / statistics.median(fast),
        "ratio_low": min(rounds),
        "ratio_high": max(rounds),
    }


def machine(threads: int) -> Row:
    """Describe in general words what the figures were measured on."""
    return {
        "cpu": _cpu(),
        "cores": os.cpu_count(),
        "threads": threads,
        "system": platform.system(),
        "load_average": os.getloadavg()[0],
        "date": datetime.now(UTC).date().isoformat(),
        "commit": _commit(),
        "python": platform.python_version(),
        "packages": {name: _version(name) for name in PACKAGES},
    }


def show(title: str, rows: Sequence[Row]) -> None:
    """Print rows, which have the same keys, as a table."""
    table = Table(title=title, title_justify="left")
    for name in rows[0] if rows else ():
        table.add_column(name.replace("_", " "), justify="right")
    for row in rows:
        table.add_row(*map(cell, row.values()))
    width = None if sys.stdout.isatty() else 160
    Console(width=width).print(table)


def cell(value: object) -> str:
    """Return a value as it stands in a table."""
    if value is None:
        return "–"
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def write(path: Path, found: Mapping[str, Any]) -> None:
    """Write figures as JSON."""
    path.write_text(json.dumps(found, indent=1, default=str) + "\n", encoding="utf-8")


def _commit() -> str | None:
    """Return the commit of the code that is measured; None outside of a repository."""
    return _said("git", "-C", str(Path(__file__).parent), "rev-parse", "--short=10", "HEAD")


def _said(*command: str) -> str | None:
    with suppress(OSError, subprocess.CalledProcessError):
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    return None


def _cpu() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    return next((x.split(":")[1].strip() for x in lines if x.startswith("model name")), "unknown")


def _version(name: str) -> str | None:
    if name == "slippy":
        code = "from importlib import metadata; print(metadata.version('slippy'))"
        return _said(os.environ.get(SLIPPY, ""), "-c", code)
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return None
