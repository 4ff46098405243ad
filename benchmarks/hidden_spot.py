"""A hidden spot that wears less, found from the depth of the scar alone.

    python benchmarks/hidden_spot.py --json docs/_data/hidden_spot.json

The ball's wear coefficient is lower in one place. Of a run with it only the final depth is known,
with noise. The factor on the wear rate at each cell is sought that explains it: the misfit plus a
prior, by which neighbouring cells hardly differ, is minimised by L-BFGS with exact gradients.
"""

from __future__ import annotations

import argparse
import json
import warnings
from pathlib import Path
from time import process_time

import numpy as np
from scipy.optimize import minimize

from tribo import Case, Misfit, TriboWarning, ValueAndGradient, View
from tribo.core.arrays import Array
from tribo.simulation.march import begin, march
from tribo.simulation.positions import composed
from tribo.study.gradient.local import localised

NOISE = 20e-9
SPOT, AT, RADIUS = 0.4, (60e-6, -40e-6), 60e-6
CHANGE = 0.15
"""By how much the logarithm of the factor differs between neighbours, as the prior has it."""
DEEP = 0.3
"""Of the largest depth, beyond which the rest is judged."""


def case(cells: int) -> Case:
    """Return the paper's test for 200 s, in which only the ball wears."""
    steel = {"young": "207 GPa", "poisson": 0.3}
    wear = {"type": "archard", "k": "3.11e-16 1/Pa"}
    motion = {"stroke": "2 mm", "frequency": 25, "duration": 200, "positions": "average"}
    return Case.model_validate(
        {
            "grid": {"size": "0.8 mm", "cells": cells},
            "load": "100 N",
            "bodies": {
                "ball": {
                    "surface": {"type": "sphere", "radius": "5 mm"},
                    "material": steel,
                    "wear": wear,
                },
                "disk": {"surface": "flat", "material": steel},
            },
            "kinematics": {"type": "reciprocating", **motion},
        }
    )


def roughness(logs: Array) -> tuple[float, Array]:
    """Return the prior of the logarithms of the factors, and its gradient."""
    value, slope = 0.0, np.zeros_like(logs)
    for axis in (0, 1):
        change = np.diff(logs, axis=axis) / CHANGE
        value += 0.5 * float(np.sum(change * change))
        padding = [(0, 0), (0, 0)]
        padding[axis] = (1, 1)
        slope -= np.diff(np.pad(change, padding), axis=axis) / CHANGE
    return value, slope


def main(cells: int, iterations: int) -> dict[str, object]:
    """Find the spot; return what was found."""
    warnings.simplefilter("ignore", TriboWarning)
    test = case(cells)
    model = composed(test)
    x, y = model.grid.mesh
    spot = np.hypot(x - AT[0], y - AT[1]) < RADIUS
    true = np.where(spot, SPOT, 1.0)
    started = process_time()
    *_, last = march(made := localised(model, {"ball": true}), begin(made))
    alone = process_time() - started
    depth = View(made, last.state).wear("ball")
    noisy = depth + NOISE * np.random.default_rng(1).standard_normal(depth.shape)

    fit = ValueAndGradient(test, Misfit("ball", noisy, NOISE), (), ["ball"])

    def posterior(logs: Array) -> tuple[float, Array]:
        misfit, slope = fit(logs)
        value, of_prior = roughness(logs.reshape(depth.shape))
        return misfit + value, slope + of_prior.ravel()

    started = process_time()
    found = minimize(
        posterior, fit.start, jac=True, method="L-BFGS-B", options={"maxiter": iterations}
    )
    spent = process_time() - started
    factor = np.exp(found.x).reshape(depth.shape)
    inside = np.hypot(x - AT[0], y - AT[1]) < RADIUS - model.grid.spacing[0]
    outside = np.hypot(x - AT[0], y - AT[1]) > RADIUS + model.grid.spacing[0]
    rest = outside & (depth > DEEP * depth.max())
    lower = (factor < np.sqrt(SPOT)) & (depth > DEEP * depth.max())
    return {
        "cells": cells,
        "unknowns": depth.size,
        "runs": found.nfev,
        "time_in_runs": spent / alone,
        "in_spot": [float(np.mean(factor[inside]) / SPOT), float(np.std(factor[inside]) / SPOT)],
        "rest": [float(np.mean(factor[rest])), float(np.std(factor[rest]))],
        "spot_cells": [int(np.sum(spot)), int(np.sum(lower))],
        "both": int(np.sum(spot & lower)),
        "misfit_per_cell": 2 * fit(found.x)[0] / depth.size,
        "half_width_um": 0.5e6 * model.grid.size[0],
        "factor": np.round(factor, 3).tolist(),
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, default=64)
    parser.add_argument("--iterations", type=int, default=80)
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    outcome = main(given.cells, given.iterations)
    for name, value in outcome.items():
        if name != "factor":
            print(f"{name:16} {value}")
    if given.json:
        given.json.write_text(json.dumps(outcome) + "\n")
