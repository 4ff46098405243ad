"""How iterations and time grow with the cells and with the distance slid.

`exponent` is the slope of a straight line through the logarithms, `steepest`
that between neighbours. Solves are those of the paper's contact at equal
complementarity, in the windows that `contact_solve.py` describes.
"""

from __future__ import annotations

import argparse
import statistics
from collections.abc import Callable, Sequence

import numpy as np

from benchmarks.lib.common import Row, Tables, interleaved, main
from benchmarks.lib.memory import peak_of_run
from benchmarks.lib.peers import Tribo, meet
from benchmarks.lib.problems import BALLS, HARDNESS, Contact, ball
from benchmarks.speed.hour import CASE
from tribo import HalfSpace, Simulation, load_case, solve_bounded

DUTY = 1e-8
SPEED = 0.1
EXPLICIT = ["stepping.type=explicit", "stepping.time_step=0.25"]


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this benchmark's own options."""
    parser.add_argument("--cells", type=int, nargs="+", default=[256, 512, 1024, 2048])
    parser.add_argument(
        "--iteration-cells", type=int, nargs="+", default=[128, 256, 512, 1024, 2048]
    )
    parser.add_argument("--run-cells", type=int, default=64, help="of runs")
    parser.add_argument("--distances", type=float, nargs="+", default=[3.6, 36, 360], help="in m")


def measure(options: argparse.Namespace) -> Tables:
    """Return iterations and time against cells, time and memory against distance."""
    return {
        "Iterations of a cold solve, 2 mm window": [
            _iterations(cells) for cells in options.iteration_cells
        ],
        "Time of a solve": [row for name in BALLS for row in _solve_times(name, options)],
        "Sliding distance": [
            _distance("implicit", [], options),
            _distance("explicit", EXPLICIT, options),
        ],
    }


def _iterations(cells: int) -> Row:
    elastic, capped = ball(cells), ball(cells, 1000.0, cap=HARDNESS)
    return {
        "cells": cells,
        "from_even": _plain(elastic),
        "own_start": Tribo(elastic, DUTY).solve(elastic.gap).iterations,
        "capped_from_even": _plain(capped),
        "capped": Tribo(capped, DUTY).solve(capped.gap).iterations,
    }


def _plain(contact: Contact) -> int:
    system = Tribo(contact, DUTY).system
    operator = HalfSpace(system.grid.cells, system.grid.spacing, system.modulus)
    found = solve_bounded(operator, contact.gap, contact.load, contact.cap, tolerance=DUTY)
    return found.iterations


def _solve_times(name: str, options: argparse.Namespace) -> list[Row]:
    actions: dict[str, dict[str, Callable[[], object]]] = {"cold": {}, "warm": {}}
    for cells in options.cells:
        contact = BALLS[name](cells)
        cold = meet(Tribo, contact, DUTY)
        warm = meet(Tribo, contact.worn(cold.answer.pressure), DUTY, before=contact.gap)
        actions["cold"][str(cells)] = cold.again
        actions["warm"][str(cells)] = warm.again
    rows = []
    for start, solves in actions.items():
        times = interleaved(solves, options.repeats, options.threads)
        rows.append(
            {
                "solve": f"{start}, {name}",
                "cells": f"{options.cells[0]}² to {options.cells[-1]}²",
                **_slope([n**2 for n in options.cells], list(times.values())),
            }
        )
    return rows


def _distance(kind: str, settings: list[str], options: argparse.Namespace) -> Row:
    overrides = [
        [
            f"grid.cells={options.run_cells}",
            f"kinematics.duration={distance / SPEED}",
            f"output.save_times=[0, {distance / SPEED}]",
            *settings,
        ]
        for distance in options.distances
    ]
    runs = {str(case): Simulation(load_case(CASE, overrides=case)).run for case in overrides}
    times = interleaved(runs, options.repeats, options.threads)
    least, most = (peak_of_run(CASE, overrides[i]) for i in (0, -1))
    return {
        "stepping": kind,
        "cells": options.run_cells,
        "distance_m": f"{options.distances[0]:g} to {options.distances[-1]:g}",
        **_slope(options.distances, list(times.values())),
        "bytes_a_step": least and most and (most[0] - least[0]) / (most[1] - least[1]),
    }


def _slope(sizes: Sequence[float], times: Sequence[Sequence[float]]) -> Row:
    x, y = np.log(sizes), np.log([statistics.median(found) for found in times])
    return {
        "exponent": float(np.polyfit(x, y, 1)[0]),
        "steepest": float(np.max(np.diff(y) / np.diff(x))),
    }


if __name__ == "__main__":
    main(__doc__, add_options, measure)
