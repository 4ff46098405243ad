"""Cold and warm solves of four contacts, beside the peers.

A paraboloid of 5 mm under 100 N on steel, in a window of 2 mm and in one four
contact radii wide; the same under 1000 N, limited to 4 GPa; and a self-affine
surface that repeats, about a twentieth of it in contact. Each package is set to
the loosest tolerance at which one judge, an exact convolution of its own, finds
a complementarity of at most --duty, relative to Hertz's approach or the rms
height. Kernels are made before the clock starts. A warm solve follows wear of
1 nm at the largest pressure and starts from the answer before it. A peer whose
solve took longer than --patience is left out on finer grids.

Ratios are times over the time of tribo with NumPy; `growth` is tribo's time over
its time on the coarsest grid. `bytes a cell` is the largest resident size of a
process that solves once, less its size before the solver is set up.
"""

from __future__ import annotations

import argparse
import statistics

from benchmarks.lib.common import Row, Tables, interleaved, main, ratio
from benchmarks.lib.memory import peak_of_solve
from benchmarks.lib.peers import Meeting, Package, Tribo, meet, packages
from benchmarks.lib.problems import CONTACTS


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this benchmark's own options."""
    parser.add_argument("--cells", type=int, nargs="+", default=[256, 512, 1024, 2048])
    parser.add_argument("--starts", nargs="+", choices=["cold", "warm"], default=["cold", "warm"])
    parser.add_argument("--contacts", nargs="+", choices=list(CONTACTS), default=list(CONTACTS))
    parser.add_argument("--patience", type=float, default=4.0, help="in s")
    parser.add_argument("--duty", type=float, default=1e-8, help="complementarity to reach")


def measure(options: argparse.Namespace) -> Tables:
    """Return one table of all solves."""
    return {
        "Solves": [
            row
            for name in options.contacts
            for start in options.starts
            for row in _rows(start, name, options)
        ]
    }


def _rows(start: str, name: str, options: argparse.Namespace) -> list[Row]:
    rows: list[Row] = []
    loosest: dict[type[Package], float] = {}
    slow: set[type[Package]] = set()
    coarsest = None
    for cells in options.cells:
        contact, before = CONTACTS[name](cells), None
        if start == "warm":
            fresh = Tribo(contact, options.duty).solve(contact.gap)
            contact, before = contact.worn(fresh.pressure), contact.gap
        found: dict[type[Package], Meeting] = {}
        for package in packages(contact):
            if package in slow:
                continue
            loose = loosest.get(package)
            found[package] = meet(package, contact, options.duty, before=before, loosest=loose)
            # A finer grid hardly asks for a looser tolerance; searching on takes long there.
            loosest[package] = 2 * found[package].package.tolerance
        times = interleaved(
            {package.name: meeting.again for package, meeting in found.items()},
            options.repeats,
            options.threads,
        )
        spent = {package: statistics.median(times[package.name]) for package in found}
        slow |= {p for p in found if spent[p] > options.patience and not issubclass(p, Tribo)}
        own = times["tribo"]
        coarsest = coarsest or spent[Tribo]
        rows += [
            {
                "contact": name,
                "start": start,
                "cells": cells,
                "package": package.name,
                "tolerance": meeting.package.tolerance,
                "complementarity": meeting.verdict.complementarity,
                "penetration": meeting.verdict.penetration,
                "iterations": meeting.answer.iterations,
                **ratio(times[package.name], own),
                "growth": spent[Tribo] / coarsest if package is Tribo else None,
                "bytes_a_cell": _memory(start, name, cells, meeting.package),
            }
            for package, meeting in found.items()
        ]
    return rows


def _memory(start: str, name: str, cells: int, package: Package) -> float | None:
    if start == "warm":
        return None
    peak = peak_of_solve(type(package), name, cells, package.tolerance)
    return peak and peak / cells**2


if __name__ == "__main__":
    main(__doc__, add_options, measure)
