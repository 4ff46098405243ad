"""How far tribo is from the transforms that a contact solve cannot avoid.

A solve has to apply its operator once at least: one round trip rfft2, irfft2 of
its own box, padded. `round trips` is the time of a solve over that of one round
trip with scipy.fft on one core; of the hour, over that of one for each of its
solves. `applications` is how often the operator was applied in a solve, on
coarser grids too.
"""

from __future__ import annotations

import argparse
import statistics
from collections import Counter
from collections.abc import Callable

from benchmarks.lib.boxes import own_box, padded, round_trip, traced
from benchmarks.lib.common import Row, Tables, interleaved, main
from benchmarks.lib.peers import Tribo, meet
from benchmarks.lib.problems import BALLS
from benchmarks.speed.hour import CASE
from tribo import Simulation, load_case


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this benchmark's own options."""
    parser.add_argument("--cells", type=int, nargs="+", default=[256, 512, 1024])
    parser.add_argument("--hour-cells", type=int, default=256)
    parser.add_argument("--duty", type=float, default=1e-8, help="complementarity to reach")


def measure(options: argparse.Namespace) -> Tables:
    """Return the rows of cold solves, warm solves and the hour."""
    rows = []
    for name, make in BALLS.items():
        for cells in options.cells:
            contact = make(cells)
            cold = meet(Tribo, contact, options.duty)
            worn = contact.worn(cold.answer.pressure)
            warm = meet(Tribo, worn, options.duty, before=contact.gap)
            rows.append(_row(f"cold, {name}", cells, cold.again, options))
            rows.append(_row(f"warm, {name}", cells, warm.again, options))
    cells = options.hour_cells
    hour = Simulation(load_case(CASE, overrides=[f"grid.cells={cells}"]))
    rows.append(_row("the paper's hour", cells, hour.run, options))
    return {"Distance to the limit": rows}


def _row(what: str, cells: int, action: Callable[[], object], options: argparse.Namespace) -> Row:
    solves = traced(action)
    boxes = Counter(map(own_box, solves))
    trips = {str(box): round_trip(box) for box in boxes}
    times = interleaved({"own": action, **trips}, options.repeats, options.threads)
    spent = {name: statistics.median(found) for name, found in times.items()}
    least, most = min(boxes), max(boxes)
    return {
        "what": what,
        "cells": cells,
        "padded_boxes": " to ".join(
            "×".join(map(str, padded(box))) for box in dict.fromkeys((least, most))
        ),
        "solves": len(solves),
        "applications": sum(map(len, solves)) / len(solves),
        "round_trips": spent["own"] / sum(boxes[box] * spent[str(box)] for box in boxes),
    }


if __name__ == "__main__":
    main(__doc__, add_options, measure)
