"""Where the time of the paper's run goes.

The run is sampled as its CPU time passes. A sample counts for the module of
tribo that is at work, or for `transforms` if that is waiting for scipy.fft.
"""

from __future__ import annotations

import argparse
import signal
from collections import Counter
from types import FrameType

from benchmarks.lib.common import Row, Tables, main
from benchmarks.speed.hour import CASE
from tribo import Simulation, load_case

INTERVAL = 1e-3
ELSEWHERE = "elsewhere"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this benchmark's own options."""
    parser.add_argument("--cells", type=int, default=256)
    parser.add_argument("--set", nargs="+", default=[], help="as for tribo run")
    parser.add_argument("--rows", type=int, default=15, help="modules to show")


def measure(options: argparse.Namespace) -> Tables:
    """Return the shares of subpackages and of modules."""
    overrides = [f"grid.cells={options.cells}", *options.set]
    simulation = Simulation(load_case(CASE, overrides=overrides))
    simulation.run()
    modules: Counter[str] = Counter()

    def sample(_: int, frame: FrameType | None) -> None:
        modules[_module(frame)] += 1

    before = signal.signal(signal.SIGPROF, sample)
    signal.setitimer(signal.ITIMER_PROF, INTERVAL, INTERVAL)
    try:
        for _ in range(options.repeats):
            simulation.run()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
    packages: Counter[str] = Counter()
    for module, samples in modules.items():
        packages[".".join(module.split(".")[:2])] += samples
    return {
        "By subpackage": _shares(packages),
        "By module": _shares(modules)[: options.rows],
    }


def _module(frame: FrameType | None) -> str:
    transforming = False
    while frame is not None:
        name = frame.f_globals.get("__name__", "")
        transforming |= name.startswith("scipy.fft")
        if name.startswith("tribo."):
            return "transforms" if transforming else name
        frame = frame.f_back
    return ELSEWHERE


def _shares(samples: Counter[str]) -> list[Row]:
    total = samples.total()
    return [{"part": name, "percent": 100 * count / total} for name, count in samples.most_common()]


if __name__ == "__main__":
    main(__doc__, add_options, measure)
