"""How far tribo is from the transforms that a contact solve cannot avoid.

`limit` is the time that the transforms of all applications of the operator take, there
and back, with scipy.fft on one core, over the time of the solve or the hour.
"""

from __future__ import annotations

import argparse
import statistics
from collections import Counter
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from unittest.mock import patch

import numpy as np
import scipy.fft

from benchmarks.lib.common import Row, Tables, interleaved, main
from benchmarks.lib.peers import Tribo, meet
from benchmarks.lib.problems import CONTACTS
from benchmarks.speed.hour import CASE
from tribo import Array, HalfSpace, Simulation, load_case
from tribo.kernel_api import PeriodicHalfSpace

Shape = tuple[int, int]
Boxes = Counter[tuple[Shape, Shape]]
"""How often an operator was applied, by the shape of its box and of the padded one."""


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
    boxes = _traced(action)
    trips = {str(box): partial(_round_trip, np.ones(box[0]), box[1]) for box in boxes}
    times = interleaved({"own": action, **trips}, options.repeats, options.threads)
    spent = {name: statistics.median(found) for name, found in times.items()}
    ends = dict.fromkeys((min(boxes)[1], max(boxes)[1]))
    return {
        "what": what,
        "cells": cells,
        "padded_boxes": " to ".join("×".join(map(str, box)) for box in ends),
        "applications": boxes.total(),
        "limit": sum(count * spent[str(box)] for box, count in boxes.items()) / spent["own"],
    }


def _traced(action: Callable[[], object]) -> Boxes:
    """Run `action`; return the boxes that operators were applied on."""
    boxes = Boxes()

    def counting(apply: Callable[..., Array]) -> Callable[..., Array]:
        def applied(operator: HalfSpace | PeriodicHalfSpace, pressure: Array) -> Array:
            boxes[operator.shape, operator.padded] += 1
            return apply(operator, pressure)

        return applied

    with ExitStack() as patches:
        for half_space in (HalfSpace, PeriodicHalfSpace):
            patches.enter_context(patch.object(half_space, "apply", counting(half_space.apply)))
        action()
    return boxes


def _round_trip(values: Array, padded: Shape) -> None:
    modes = scipy.fft.fft(scipy.fft.rfft(values, padded[1]), padded[0], axis=0)
    scipy.fft.irfft(scipy.fft.ifft(modes, axis=0)[: len(values)], padded[1])


if __name__ == "__main__":
    main(__doc__, add_options, measure)
