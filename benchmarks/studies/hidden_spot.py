"""A hidden spot that wears less, found from the depth of the scar alone.

    python -m benchmarks.studies.hidden_spot --json docs/_data/hidden_spot.json

The ball's wear coefficient is lower in one place. Of a run with it only the final depth is known,
with noise. The factor on the coefficient at each cell is sought that explains it, with a prior by
which it varies smoothly. With --labs, over many tests on a small grid whose factors are drawn from
the prior, how often its intervals cover the truth:

    python -m benchmarks.studies.hidden_spot --labs 200 --json docs/_data/map_coverage.json

and with maps that lie off by some 0.1 of a cell, which the fit is not told:

    python -m benchmarks.studies.hidden_spot --labs 100 --off 0.1
        --json docs/_data/moved_map_coverage.json
"""

from __future__ import annotations

import argparse
import json
import warnings
from collections.abc import Iterator
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
from scipy.fft import idctn
from scipy.ndimage import shift as moved
from tribo_inverse import View
from tribo_inverse.calibration.cells import cell_means
from tribo_inverse.calibration.maps import fit_map
from tribo_inverse.calibration.prior import Prior
from tribo_inverse.calibration.scar_shift import PRIOR_SHIFT
from tribo_inverse.recording.local import localised

from tribo import Case, TriboWarning
from tribo.core.arrays import Array
from tribo.model.model import Model
from tribo.simulation.march import begin, march
from tribo.simulation.positions import composed

NOISE = 20e-9
SPOT, AT, RADIUS = 0.4, (60e-6, -40e-6), 60e-6
PRIOR = Prior(spread=0.4, length=60e-6)
DEEP = 0.3
"""Of the largest depth, beyond which the rest is judged."""
LEVEL = 0.95
SHOWN = 64
"""Blocks of cells, along an edge, whose mean factor is kept."""
MOTION = {"type": "reciprocating", "stroke": "2 mm", "frequency": 25, "duration": 200}
MOTION |= {"positions": "average"}


def case(cells: int, **settings: Any) -> Case:
    """Return the paper's test for 200 s, in which only the ball wears."""
    steel = {"young": "207 GPa", "poisson": 0.3}
    wear = {"type": "archard", "k": "3.11e-16 1/Pa"}
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
            "kinematics": MOTION,
            **settings,
        }
    )


def worn(model: Model, factor: Array) -> Array:
    """Return the depth of the ball at the end, with a factor on its coefficient at each cell."""
    *_, last = march(made := localised(model, {"ball": factor}), begin(made))
    return View(made, last.state).wear("ball")


def spot(cells: int, contact: str) -> dict[str, object]:
    """Find the spot in the depth that a contact model gives; return what was found."""
    test = case(cells)
    model = composed(case(cells, contact={"type": contact}))
    x, y = model.grid.mesh
    apart, cell = np.hypot(x - AT[0], y - AT[1]), model.grid.spacing[0]
    true = np.where(apart < RADIUS, SPOT, 1.0)
    worn(model, true)
    began = process_time()
    depth = worn(model, true)
    alone = process_time() - began
    noisy = cell_means(depth) + NOISE * np.random.default_rng(1).standard_normal(depth.shape)
    started = process_time()
    found = fit_map(test, "ball", noisy, NOISE, PRIOR, products=150)
    spent = process_time() - started
    # The machine may be slower by now.
    started = process_time()
    worn(model, true)
    alone = 0.5 * (alone + process_time() - started)
    factor, deep = found.factor, depth > DEEP * depth.max()
    inside, rest = apart < RADIUS - cell, (apart > RADIUS + cell) & deep
    lower = (factor < np.sqrt(SPOT)) & deep
    low, high = found.interval(LEVEL)
    shown = factor.reshape(SHOWN, cells // SHOWN, SHOWN, cells // SHOWN)
    return {
        "cells": cells,
        "unknowns": depth.size,
        "runs": found.gradients + found.products,
        "gradients": found.gradients,
        "time_in_runs": spent / alone,
        "in_spot": [float(np.mean(factor[inside]) / SPOT), float(np.std(factor[inside]) / SPOT)],
        "rest": [float(np.mean(factor[rest])), float(np.std(factor[rest]))],
        "spot_cells": [int(np.sum(true < 1)), int(np.sum(lower))],
        "both": int(np.sum((true < 1) & lower)),
        "covered": float(np.mean(((low < true) & (true < high))[deep])),
        "misfit_per_cell": found.chi_square / depth.size,
        "p_value": found.p_value,
        "half_width_um": 0.5e6 * model.grid.size[0],
        "factor": np.round(shown.mean(axis=(1, 3)), 3).tolist(),
    }


def coverage(labs: int, cells: int, off: float) -> Iterator[dict[str, object]]:
    """Yield after each 10 tests how often intervals cover factors drawn from the prior.

    Where maps lie is unknown if they lie off by chance, by so many cells.
    """
    test = case(
        cells,
        grid={"size": "0.7 mm", "cells": cells},
        contact={"type": "winkler"},
        stepping={"type": "implicit", "depth_tolerance": 0.1, "pressure_tolerance": 1.0},
        kinematics=MOTION | {"duration": 40},
    )
    model, prior = composed(test), Prior(PRIOR.spread, 2 * PRIOR.length)
    waves = prior.amplitudes((cells, cells), model.grid.spacing)
    scale = prior.scale(waves)
    random, shares, misfits, began = np.random.default_rng(7), [], [], process_time()
    for lab in range(labs):
        logs = scale * idctn(waves * random.standard_normal(waves.shape), norm="ortho")
        depth = worn(model, np.exp(logs))
        means, placed = cell_means(depth), (0.0, 0.0)
        if off:
            means = moved(means, off * random.standard_normal(2), order=3, mode="nearest")
            placed = (PRIOR_SHIFT * model.grid.size[0], PRIOR_SHIFT * model.grid.size[1])
        noisy = means + NOISE * random.standard_normal(depth.shape)
        found = fit_map(test, "ball", noisy, NOISE, prior, placed=placed, products=400)
        low, high = found.interval(LEVEL)
        covered = (low < np.exp(logs)) & (np.exp(logs) < high)
        shares.append([np.mean(covered[depth > DEEP * depth.max()]), np.mean(covered)])
        misfits.append(found.p_value)
        if lab % 10 == 9:
            deep, everywhere = (float(share) for share in np.mean(shares, axis=0))
            print(f"{lab + 1}: {deep}, {everywhere}, {process_time() - began:.0f} s", flush=True)
            yield {
                "labs": lab + 1,
                "cells": cells,
                "level": LEVEL,
                "deep": deep,
                "everywhere": everywhere,
                "error": float(np.std([s[0] for s in shares]) / len(shares) ** 0.5),
                "refused": float(np.mean(np.array(misfits) < 0.01)),
            }


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int)
    parser.add_argument("--labs", type=int)
    parser.add_argument("--off", type=float, default=0.0)
    parser.add_argument("--springs", action="store_true")
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    warnings.simplefilter("ignore", TriboWarning)
    contact = "winkler" if given.springs else "dcfft"
    found = coverage(given.labs, given.cells or 18, given.off) if given.labs else None
    for outcome in found or [spot(given.cells or 256, contact)]:
        for name, value in outcome.items():
            if name != "factor":
                print(f"{name:16} {value}")
        if given.json:
            given.json.write_text(json.dumps(outcome) + "\n")
