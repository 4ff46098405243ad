"""Coefficients from exact depth maps on coarse grids: what the grid puts them off.

    python -m benchmarks.studies.map_grids [cells ...]

Each case wears both bodies on a fine grid with short steps, and both maps are fitted on the cells
named; printed are errors of the coefficients in per cent, marked where an interval does not cover.
"""

from __future__ import annotations

import sys
import tomllib
import warnings
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from tribo_inverse import calibrate
from tribo_inverse.calibration.quantities import surface_depth

from tribo import Simulation, TriboWarning
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.templates import template

NOISE = 2e-9
"""Stated standard deviation of a pixel, m; the maps have none."""
FINE = {"stepping": {"type": "implicit", "depth_tolerance": 1e-4, "pressure_tolerance": 0.05}}
SPRINGS = {"contact": {"type": "winkler"}}
CASES = {
    "15 N, half-space, pin and track": (
        "pin_on_disk",
        192,
        {"load.normal": 15.0, "kinematics.distance": 700.0, "grid.size": 1.4e-3}
        | {"bodies.disk.wear.k": 1e-14},
    ),
    "40 N, half-space, ball and groove": (
        "ball_on_disk",
        192,
        {"load.normal": 40.0, "kinematics.duration": 1500.0, "grid.size": 1.3e-3}
        | {"bodies.ball.surface.radius": 4e-3}
        | {"bodies.ball.wear.k": 1.4e-15, "bodies.disk.wear.k": 6e-16},
    ),
    "30 N, springs, ball and groove": (
        "ball_on_disk",
        192,
        SPRINGS
        | {"load.normal": 30.0, "kinematics.duration": 900.0, "grid.size": 1.2e-3}
        | {"bodies.ball.surface.radius": 6e-3}
        | {"bodies.ball.wear.k": 9e-16, "bodies.disk.wear.k": 9e-16},
    ),
    "60 N, springs, stroke resolved, ball and groove": (
        "ball_on_disk",
        96,
        SPRINGS
        | {"load.normal": 60.0, "kinematics.duration": 300.0, "grid.size": 1.2e-3}
        | {"kinematics.positions": 41}
        | {"bodies.ball.wear.k": 1e-15, "bodies.disk.wear.k": 2e-15},
    ),
}


def measured(case: Mapping[str, object], cells: int, folder: Path) -> list[dict[str, object]]:
    """Wear both bodies of a case on a fine grid; return their maps as measured values."""
    entries = []
    fine = validate_case(apply_settings(case, {"grid.cells": cells} | FINE))
    with Simulation(fine).run() as result:
        for name in fine.bodies:
            file = folder / f"{name}.npy"
            np.save(file, surface_depth(result, name, -1))
            entry = {"body": name, "quantity": "depth_map", "depth": str(file)}
            entries.append(entry | {"pitch": fine.grid.size[0] / cells, "uncertainty": NOISE})
    return entries


def main(counts: list[int]) -> None:
    """Print the errors of each case on each grid."""
    warnings.simplefilter("ignore", TriboWarning)
    for title, (name, cells, changes) in CASES.items():
        case = apply_settings(tomllib.loads(template(name)), {"output": {}} | changes)
        truth = validate_case(case).bodies
        fit = [{"path": f"bodies.{body}.wear.k"} for body in truth]
        print(title)
        with TemporaryDirectory() as folder:
            entries = measured(case, cells, Path(folder))
            for count in counts:
                coarse = apply_settings(case, {"grid.cells": count})
                found = calibrate(coarse, {"measured": entries, "fit": fit}).parameters
                said = []
                for row, body in zip(found.itertuples(), truth.values(), strict=True):
                    error = 100 * (row.value / body.wear.k - 1)
                    mark = "" if row.lower < body.wear.k < row.upper else " (!)"
                    said.append(f"{error:+.2f}{mark}")
                print(f"  {count:3} cells: {', '.join(said)} %", flush=True)


if __name__ == "__main__":
    main([int(count) for count in sys.argv[1:]] or [12, 16, 24, 32])
