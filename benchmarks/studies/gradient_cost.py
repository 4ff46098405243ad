"""What a gradient costs: the time of the run with all derivatives over that of the run alone.

    python -m benchmarks.studies.gradient_cost [cells] [part of a case's name]
    python -m benchmarks.studies.gradient_cost [cells] memory

Each case is run in turn with and without, three times, and the best of each is taken. Derivatives
are those in the wear rate and the height at each cell; and these and those in all numbers of the
case. The second prints the peak memory of runs of more and more steps. The cases with effects need
the packages tribo-film and tribo-thirdbody.
"""

from __future__ import annotations

import multiprocessing
import resource
import sys
import warnings
from time import process_time

from tribo_inverse import Deepest, gradient

from tribo import Case, TriboWarning

TIMES = 3


def case(cells: int, **changes: object) -> Case:
    """Return the paper's test for 200 s, with changes."""
    steel = {"young": "207 GPa", "poisson": 0.3}
    wear = {"type": "archard", "k": "3.11e-16 1/Pa"}
    parts = {
        "grid": {"size": "0.8 mm", "cells": cells},
        "load": "100 N",
        "bodies": {
            "ball": {
                "surface": {"type": "sphere", "radius": "5 mm"},
                "material": steel,
                "wear": wear,
            },
            "disk": {"surface": "flat", "material": steel, "wear": wear},
        },
        "kinematics": {
            "type": "reciprocating",
            "stroke": "2 mm",
            "frequency": 25,
            "duration": 200,
            "positions": "average",
        },
        **changes,
    }
    return Case.model_validate(parts)


def cases(cells: int) -> dict[str, Case]:
    """Return the cases by name."""
    base = case(cells)
    bodies = {
        name: body.model_copy(
            update={"material": body.material.model_copy(update={"hardness": hardness})}
        )
        for (name, body), hardness in zip(base.bodies.items(), (2.1e9, 2e9), strict=True)
    }
    motion = {"type": "reciprocating", "stroke": "2 mm", "frequency": 25, "duration": 200}
    power = {"type": "power", "k": 3.11e-16, "p_exponent": 1.5, "reference_pressure": "1 GPa"}
    archard = {"type": "archard", "k": "3.11e-16 1/Pa"}
    fresh = {"type": "running_in", "factor": 4, "over": "1 GPa m", "law": archard}
    running_in = {n: {**dict(b), "wear": fresh} for n, b in base.bodies.items()}
    polished = {
        "type": "smoothing",
        "factor": 4,
        "roughness": "0.4 um",
        "settled": "0.1 um",
        "depth": "0.5 um",
        "law": archard,
    }
    smoothing = {n: {**dict(b), "wear": polished} for n, b in base.bodies.items()}
    nonlinear = {n: {**dict(b), "wear": power} for n, b in base.bodies.items()}
    film = {
        "type": "film.mixed",
        "viscosity": "0.01 Pa s",
        "pressure_viscosity": "20 1/GPa",
        "radius": "5 mm",
        "roughness": "0.2 um",
    }
    debris = {"type": "thirdbody.debris", "ejection_length": "0.5 m", "cover": "1 um"}
    return {
        "half-space, average": base,
        "springs, average": case(cells, contact={"type": "winkler"}),
        "half-space, yielding": case(cells, bodies=bodies),
        "half-space, not linear in pressure": case(cells, bodies=nonlinear),
        "half-space, running-in": case(cells, bodies=running_in),
        "half-space, smoothing": case(cells, bodies=smoothing),
        "half-space, 33 positions": case(cells, kinematics={**motion, "positions": 33}),
        "half-space, film": case(cells, effects=[film]),
        "half-space, debris": case(cells, effects=[debris]),
    }


def main(cells: int, part: str) -> None:
    """Print steps, times and ratio of each case with this part in its name."""
    warnings.simplefilter("ignore", TriboWarning)
    for name, each in cases(cells).items():
        if part not in name:
            continue
        alone, maps, both, steps = [], [], [], 0
        for _ in range(TIMES):
            started = process_time()
            result = each.run()
            alone.append(process_time() - started)
            steps = len(result.history_time) - 1
            started = process_time()
            gradient(each, Deepest("disk"), [])
            maps.append(process_time() - started)
            started = process_time()
            found = gradient(each, Deepest("disk"))
            both.append(process_time() - started)
        cells_of_maps = sum(m.size for m in (*found.wear_rate.values(), *found.height.values()))
        print(
            f"{name:36} {cells}² {steps:4} steps: {min(maps) / min(alone):.2f} with maps of "
            f"{cells_of_maps} cells, {min(both) / min(alone):.2f} with {len(found.parameters)} "
            "numbers too",
            flush=True,
        )


def memory(cells: int) -> None:
    """Print the peak memory of a process by the steps of its run."""
    context = multiprocessing.get_context("spawn")
    for saves in (100, 200, 400, 800):
        with context.Pool(1) as pool:
            peak, steps = pool.apply(_peak, (cells, saves))
        print(f"{cells}² {steps:4} steps: peak {peak:.0f} MiB", flush=True)


def _peak(cells: int, saves: int) -> tuple[float, int]:
    warnings.simplefilter("ignore", TriboWarning)
    times = [200 * (i + 1) / saves for i in range(saves)]
    springs = case(cells, contact={"type": "winkler"}, output={"save_times": times})
    gradient(springs, Deepest("disk"), ["load.normal"])
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, saves


if __name__ == "__main__":
    if "memory" in sys.argv:
        memory(int(sys.argv[1]))
        sys.exit()
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 64, "".join(sys.argv[2:3]))
