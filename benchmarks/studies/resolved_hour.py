"""The paper's hour with its cycle resolved into positions, beside the average.

The page on the paper shows the figures. They come from a run of some minutes:

    python -m benchmarks.studies.resolved_hour --json docs/_data/resolved_hour.json
"""

from __future__ import annotations

import argparse
import time
import tomllib
from collections.abc import Iterator

import numpy as np

from benchmarks.lib.common import Row, Tables, main
from tribo import Grid, Result, Simulation
from tribo.case import Case, Output
from tribo.config.load import validate_case
from tribo.core.measures import centre
from tribo.lab.scar import crown
from tribo.templates import template

CASES = {
    "equal coefficients": ("ball_on_disk", 1.5e-3),
    "weighed losses": ("weighed_split", 2.7e-3),
}


def paper_case(name: str, cells: int, positions: int | str, duration: float) -> Case:
    """Return a case of the paper on a grid, with its fields saved at the end alone."""
    kind, window = CASES[name]
    given = validate_case(tomllib.loads(template(kind)))
    kinematics = given.kinematics.model_copy(
        update={"positions": positions, "duration": duration, "cycles": None, "distance": None}
    )
    return given.model_copy(
        update={"grid": Grid(window, cells), "kinematics": kinematics, "output": Output()}
    )


def resolved(name: str, cells: int, positions: int | str, duration: float) -> Row:
    """Run a case of the paper; return what is left at its end."""
    case = paper_case(name, cells, positions, duration)
    began = time.process_time()
    with Simulation(case).run() as result:
        spent = time.process_time() - began
        end = result.dataset.isel(time=-1)
        ball, disk = (result.body(body) for body in ("ball", "disk"))
        across = np.mean(ball.surface(-1)[(cells - 1) // 2 : cells // 2 + 1], axis=0)
        worn = np.mean(ball.wear_depth[-1][(cells - 1) // 2 : cells // 2 + 1], axis=0)
        row: Row = {
            "case": name,
            "positions": positions,
            "cells": cells,
            "groove_um": 1e6 * centre(disk.wear_depth[-1]),
            "end_of_stroke_um": 1e6 * _at_the_end(result, case.kinematics.stroke),
            "ball_um": 1e6 * centre(ball.wear_depth[-1]),
            "crown_um": 1e6 * crown(across, worn),
            "along_mm": 2e3 * float(end.contact_half_width_x),
            "centre_MPa": 1e-6 * float(end.centre_pressure),
            "solves": int(end.contact_solves),
            "seconds": spent,
        }
    return row


def _at_the_end(result: Result, stroke: float) -> float:
    if "track_depth" not in result.dataset:
        return float(np.max(result.body("disk").wear_depth[-1]))
    track = result.track_depth.sel(body="disk").isel(time=-1)
    middle = track.isel(y=slice((track.sizes["y"] - 1) // 2, track.sizes["y"] // 2 + 1)).mean("y")
    return float(middle.interp(track_x=0.5 * stroke))


def runs(options: argparse.Namespace) -> Iterator[Row]:
    """Yield the runs, each with how many times longer it took than the average's."""
    for name in CASES:
        for cells in options.cells:
            average = resolved(name, cells, "average", options.duration)
            yield {**average, "times": 1.0}
            for positions in options.positions if cells == min(options.cells) else [33]:
                row = resolved(name, cells, positions, options.duration)
                yield {**row, "times": row["seconds"] / average["seconds"]}


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add grids, positions and duration."""
    parser.add_argument("--cells", type=int, nargs="+", default=[48, 96])
    parser.add_argument("--positions", type=int, nargs="+", default=[33])
    parser.add_argument("--duration", type=float, default=3600.0, help="in s")


def measure(options: argparse.Namespace) -> Tables:
    """Return the table."""
    rows = list(runs(options))
    for row in rows:
        del row["seconds"]
    return {"resolved hour": rows}


if __name__ == "__main__":
    main(__doc__, add_options, measure)
