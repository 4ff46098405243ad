"""Cold and warm solves of the paper's contact, against tamaas and ContactMechanics.

The contact (a paraboloid of 5 mm, 100 N, steel) lies in a window of 2 mm, and in
a tight one four contact radii wide. Each package is set to the loosest tolerance
at which one judge, an exact convolution of its own, finds a complementarity of
at most --duty. Kernels are made before the clock starts. A warm solve follows
wear of 1 nm at the largest pressure and starts from the answer before it.

Ratios are times over that of tribo; `growth` is tribo's time over that on its
coarsest grid.
"""

from __future__ import annotations

import argparse
import statistics

from benchmarks.lib.common import Row, Tables, interleaved, main, ratio
from benchmarks.lib.peers import Meeting, Package, Tribo, meet, packages
from benchmarks.lib.problems import WINDOW, ball, tight

WINDOWS = {"2 mm": WINDOW, "4a": tight()}


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this benchmark's own options."""
    parser.add_argument("--cells", type=int, nargs="+", default=[128, 256, 512, 1024, 2048])
    parser.add_argument("--starts", nargs="+", choices=["cold", "warm"], default=["cold", "warm"])
    parser.add_argument("--windows", nargs="+", choices=list(WINDOWS), default=list(WINDOWS))
    parser.add_argument(
        "--peers-up-to", type=int, default=512, help="cells beyond which peers, slow, are left out"
    )
    parser.add_argument("--duty", type=float, default=1e-8, help="complementarity to reach")


def measure(options: argparse.Namespace) -> Tables:
    """Return one table for cold and one for warm solves."""
    return {
        f"{start.capitalize()} solve": [
            row for window in options.windows for row in _rows(start, window, options)
        ]
        for start in options.starts
    }


def _rows(start: str, window: str, options: argparse.Namespace) -> list[Row]:
    rows: list[Row] = []
    loosest: dict[type[Package], float] = {}
    coarsest = None
    for cells in options.cells:
        found = {}
        for package in packages(None if cells <= options.peers_up_to else "tribo"):
            found[package] = _meet(package, start, window, cells, loosest.get(package), options)
            # A finer grid hardly asks for a looser tolerance; searching on takes long there.
            loosest[package] = 2 * found[package].package.tolerance
        times = interleaved(
            {package.name: meeting.again for package, meeting in found.items()},
            options.repeats,
            options.threads,
        )
        own = times["tribo"]
        coarsest = coarsest or statistics.median(own)
        rows += [
            {
                "window": window,
                "cells": cells,
                "package": package.name,
                "tolerance": meeting.package.tolerance,
                "complementarity": meeting.verdict.complementarity,
                "penetration": meeting.verdict.penetration,
                "iterations": meeting.answer.iterations,
                **ratio(times[package.name], own),
                "growth": statistics.median(own) / coarsest if package is Tribo else None,
            }
            for package, meeting in found.items()
        ]
    return rows


def _meet(
    package: type[Package],
    start: str,
    window: str,
    cells: int,
    loosest: float | None,
    options: argparse.Namespace,
) -> Meeting:
    contact = ball(cells, width=WINDOWS[window])
    if start == "cold":
        return meet(package, contact, options.duty, loosest=loosest)
    fresh = Tribo(contact, options.duty).solve(contact.gap)
    worn = contact.worn(fresh.pressure)
    return meet(package, worn, options.duty, before=contact.gap, loosest=loosest)


if __name__ == "__main__":
    main(__doc__, add_options, measure)
