"""How well a sweep uses the cores: the time of one process over that of several.

The same runs are made twice in new folders, by one worker process and by
`--jobs` of them; starting the processes, validating the runs and writing the
tables count. The parallel efficiency is t(1) / (jobs t(jobs)); what else the
machine does meanwhile enters. It hardly enters the part of their time that the
workers spend inside runs, which is the efficiency but for what runs side by
side cost each other.

Run it with ``python -m benchmarks.speed.sweep [--runs 64] [--cells 64] [--jobs 2] [--json]``.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from tribo import sweep
from tribo.templates import template


def timed(case: Path, loads: list[float], jobs: int) -> tuple[float, float]:
    """Return how long a sweep takes from nothing, and which part its workers spend inside runs."""
    begun = time.perf_counter()
    swept = sweep(case, {"load.normal": loads}, case.with_name(f"jobs-{jobs}"), jobs=jobs)
    taken = time.perf_counter() - begun
    assert not swept.failures()
    return taken, float(swept.table["wall_time_s"].sum()) / (jobs * taken)


def main() -> None:
    """Print the parallel efficiency."""
    parser = argparse.ArgumentParser(description="How well a sweep uses the cores.")
    parser.add_argument("--runs", type=int, default=64)
    parser.add_argument("--cells", type=int, default=64)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--json", action="store_true")
    chosen = parser.parse_args()
    with TemporaryDirectory() as folder:
        case = Path(folder) / "case.toml"
        cells = f"cells = {chosen.cells}"
        case.write_text(template("ball_on_disk").replace("cells = [256, 256]", cells))
        loads = [60.0 + 40.0 * run / chosen.runs for run in range(chosen.runs)]
        (one, _), (several, inside) = timed(case, loads, 1), timed(case, loads, chosen.jobs)
    found = {
        "runs": chosen.runs,
        "cells": chosen.cells,
        "jobs": chosen.jobs,
        "speedup": one / several,
        "efficiency": one / (chosen.jobs * several),
        "inside_runs": inside,
    }
    if chosen.json:
        print(json.dumps(found, indent=2))
    else:
        print(
            f"{chosen.runs} runs on {chosen.cells}² cells: {chosen.jobs} processes are "
            f"{found['speedup']:.2f} times as fast as one (efficiency {found['efficiency']:.0%}); "
            f"{inside:.0%} of the workers' time is inside runs"
        )


if __name__ == "__main__":
    main()
