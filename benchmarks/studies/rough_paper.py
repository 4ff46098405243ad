"""The paper's ball and disk with the roughness of its disk: the whole contact, and a patch of it.

The page *The paper, with its roughness* shows the figures. They come from a run of some minutes on
the coarser grid, and about four times as many on the finer:

    python -m benchmarks.studies.rough_paper --json docs/_data/rough_paper.json
"""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Iterator
from importlib.resources import files

import numpy as np
from tribo_topography.running_in import worn_roughness

import tribo
from benchmarks.lib.common import Row, Tables, main
from tribo import Result, Simulation, TriboWarning, load_case
from tribo.core.measures import centre

SQ = 11e-9
"""Sq of Gaussian heights with an Ra of 9 nm; the paper measured 6.7 to 10.8 nm."""
CUT_OFF, ROLL_OFF, WINDOW = 60e-6, 200e-6, 1.4e-3
TIMES = (0.0, 0.1, 1.0, 10.0, 100.0, 600.0, 3600.0)
PATCH, PATCH_CUT_OFF, PATCH_ROLL_OFF = 50e-6, 1.6e-6, 10e-6
MEAN_PRESSURE = 1.47e9
"""Of the paper's first contact: two thirds of Hertz's peak."""
PATHS = (0.0, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0)
"""Sliding distances of the patch at which it is saved, in m."""


def hour(cells: int, positions: int, seed: int, duration: float) -> Iterator[Row]:
    """Yield what is seen of the ball and disk at each time; smooth ones where the seed is 0."""
    times = [time for time in TIMES if time < duration] + [duration]
    wavy = f'type = "rough", sq = {SQ}, cut_off = {CUT_OFF}, roll_off = {ROLL_OFF}'
    rough = [
        f"bodies.ball.surface={{ {wavy}, seed = {seed}, on = {{ type = 'sphere', radius = "
        "'5 mm' } }",
        f"bodies.disk.surface={{ {wavy}, seed = {100 + seed} }}",
    ]
    case = load_case(
        files("tribo.templates") / "ball_on_disk.toml",
        overrides=[
            f"grid.size={WINDOW}",
            f"grid.cells={cells}",
            *(rough if seed else []),
            f"kinematics.positions={positions}",
            "contact.tolerance=1e-6",
            f"kinematics.duration={duration}",
            f"output.save_times={times}",
        ],
    )
    with Simulation(case).run() as result:
        for save, time in enumerate(result.times):
            yield {
                "cells": cells,
                "seed": seed,
                "time": float(time),
                **seen(result, save),
                "groove_um": 1e6 * centre(result.body("disk").wear_depth[save]),
            }


def patch(cells: int, seed: int, distance: float) -> Iterator[Row]:
    """Yield what is seen of a patch in the middle of the first contact, after each distance."""
    paths = [path for path in PATHS if path < distance] + [distance]
    speed = 0.1
    rough = {
        "type": "rough",
        "sq": SQ,
        "cut_off": PATCH_CUT_OFF,
        "roll_off": PATCH_ROLL_OFF,
        "period": PATCH,
    }
    steel = {"young": 207e9, "poisson": 0.3, "hardness": 4e9, "density": 7850}
    wear = {"type": "archard", "k": 3.11e-16}
    bodies = {
        name: {"surface": {**rough, "seed": of_body}, "material": steel, "wear": wear}
        for name, of_body in (("ball", seed), ("disk", 100 + seed))
    }
    case = tribo.Case.model_validate(
        {
            "grid": {"size": PATCH, "cells": cells},
            "contact": {"type": "periodic", "tolerance": 1e-6},
            "load": {"normal": MEAN_PRESSURE * PATCH**2},
            "bodies": bodies,
            "kinematics": {
                "type": "unidirectional",
                "speed": speed,
                "duration": distance / speed,
                "track_length": PATCH,
                "positions": 2 * round(PATCH / PATCH_CUT_OFF) + 1,
                "swept": "disk",
            },
            "output": {"save_times": [path / speed for path in paths]},
        }
    )
    with Simulation(case).run() as result:
        for save, path in enumerate(result.dataset.distance.values):
            yield {"cells": cells, "seed": seed, "path": float(path), **seen(result, save)}


def seen(result: Result, save: int) -> Row:
    """Return pressures, areas and roughness at a save."""
    now = result.dataset.isel(time=save)
    pressure = now.pressure.values
    row: Row = {
        "peak_GPa": 1e-9 * float(np.max(pressure)),
        "mean_GPa": 1e-9 * float(np.mean(pressure[pressure > 0])),
        "area_mm2": 1e6 * float(now.contact_area),
        "plastic_part": float(now.plastic_area) / float(now.contact_area),
        "solves": int(now.contact_solves),
    }
    for name in ("ball", "disk"):
        scar, unworn, _ = worn_roughness(result, result.body(name), save)
        row |= {f"{name}_Sa_nm": 1e9 * scar.Sa_m, f"{name}_unworn_nm": 1e9 * unworn.Sa_m}
    return row


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add grids, seeds and lengths."""
    parser.add_argument("--cells", type=int, nargs="+", default=[96, 144])
    parser.add_argument("--positions", type=int, default=71)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--duration", type=float, default=3600.0, help="in s")
    parser.add_argument("--patch", type=int, nargs="+", default=[128, 256])
    parser.add_argument("--distance", type=float, default=1.0, help="of the patch, in m")


def measure(options: argparse.Namespace) -> Tables:
    """Return the tables; the first seed is run on all grids, the others on the first."""
    warnings.simplefilter("ignore", TriboWarning)
    hours = list(hour(options.cells[0], options.positions, 0, options.duration))
    patches: list[Row] = []
    for grid, cells in enumerate(options.cells):
        for seed in options.seeds[: 1 if grid else None]:
            hours += list(hour(cells, options.positions, seed, options.duration))
    for grid, cells in enumerate(options.patch):
        for seed in options.seeds[: 1 if grid else None]:
            patches += list(patch(cells, seed, options.distance))
    return {"hour": hours, "patch": patches}


if __name__ == "__main__":
    main(__doc__, add_options, measure)
