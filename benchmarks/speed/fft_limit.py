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
from contextlib import ExitStack
from functools import partial
from math import prod
from typing import Any
from unittest.mock import patch

import numpy as np
import scipy.fft

from benchmarks.lib.common import Row, Tables, interleaved, main
from benchmarks.lib.peers import Tribo, meet
from benchmarks.lib.problems import CONTACTS
from benchmarks.speed.hour import CASE
from tribo import Array, HalfSpace, Simulation, load_case
from tribo.contact.elastic import ElasticSolver
from tribo.kernel_api import PeriodicHalfSpace

Shape = tuple[int, int]


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this benchmark's own options."""
    parser.add_argument("--cells", type=int, nargs="+", default=[256, 512, 1024, 2048])
    parser.add_argument("--hour-cells", type=int, default=256)
    parser.add_argument("--contacts", nargs="+", choices=list(CONTACTS), default=list(CONTACTS))
    parser.add_argument("--duty", type=float, default=1e-8, help="complementarity to reach")


def measure(options: argparse.Namespace) -> Tables:
    """Return the rows of cold solves, warm solves and the hour."""
    rows = []
    for name in options.contacts:
        for cells in options.cells:
            contact = CONTACTS[name](cells)
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
    solves = _traced(action)
    boxes = Counter(max(boxes, key=prod) for boxes in solves)
    trips = {str(box): partial(_round_trip, np.ones(box)) for box in boxes}
    times = interleaved({"own": action, **trips}, options.repeats, options.threads)
    spent = {name: statistics.median(found) for name, found in times.items()}
    ends = dict.fromkeys((min(boxes), max(boxes)))
    return {
        "what": what,
        "cells": cells,
        "padded_boxes": " to ".join("×".join(map(str, box)) for box in ends),
        "solves": len(solves),
        "applications": sum(map(len, solves)) / len(solves),
        "round_trips": spent["own"] / sum(boxes[box] * spent[str(box)] for box in boxes),
    }


def _traced(action: Callable[[], object]) -> list[list[Shape]]:
    """Run `action`; return for each contact solve the padded boxes its operator was applied on."""
    solves: list[list[Shape]] = []
    solve = ElasticSolver.solve

    def solved(solver: ElasticSolver, *arguments: Any) -> Any:
        solves.append([])
        return solve(solver, *arguments)

    def counting(apply: Callable[..., Array]) -> Callable[..., Array]:
        def applied(operator: HalfSpace | PeriodicHalfSpace, pressure: Array) -> Array:
            if solves:
                solves[-1].append(operator.padded)
            return apply(operator, pressure)

        return applied

    with ExitStack() as patches:
        patches.enter_context(patch.object(ElasticSolver, "solve", solved))
        for half_space in (HalfSpace, PeriodicHalfSpace):
            patches.enter_context(patch.object(half_space, "apply", counting(half_space.apply)))
        action()
    return solves


def _round_trip(values: Array) -> None:
    """What no solve can avoid: a transform there and back, on one core."""
    scipy.fft.irfft2(scipy.fft.rfft2(values, workers=1), values.shape, workers=1)


if __name__ == "__main__":
    main(__doc__, add_options, measure)
