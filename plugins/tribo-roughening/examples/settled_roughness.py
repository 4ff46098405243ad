"""A rough and a smooth patch wear against a plate until both are as rough, whatever they were.

python settled_roughness.py [CELLS [PARTICLES]]: cells and particles along a side of the patch.
"""

import sys

import numpy as np
from tribo import Simulation

DIAMETER, THICKNESS = 16e-6, 0.4e-6
K, PRESSURE = 1e-15, 0.5e9
ARCHARD = {"type": "archard", "k": K}
STEEL = {"young": "207 GPa", "poisson": 0.3}


def case(sq, wear=None, *, cells=32, particles=4, layers=6):
    """Return a patch of roughness `sq` (m), worn by so many layers of particles."""
    size = particles * DIAMETER
    waves = {"cut_off": DIAMETER, "roll_off": 2 * DIAMETER, "period": size}
    detachment = {
        "type": "roughening.detachment",
        "k": K,
        "diameter": DIAMETER,
        "thickness": THICKNESS,
        "period": size,
    }
    duration = layers * THICKNESS / (K * PRESSURE)
    halves = range(2 * layers + 1)
    return {
        "grid": {"size": size, "cells": cells},
        "load": {"normal": PRESSURE * size**2},
        "bodies": {
            "patch": {
                "surface": {"type": "rough", "sq": sq, **waves},
                "material": STEEL,
                "wear": wear or detachment,
            },
            "plate": {"surface": "flat", "material": STEEL},
        },
        "contact": {"type": "periodic"},
        "stepping": {"type": "implicit", "depth_tolerance": 5e-5, "nonlinear_tolerance": 1e-5},
        "kinematics": {
            "type": "unidirectional",
            "speed": "1 m/s",
            "track_length": "1 m",
            "duration": duration,
        },
        "output": {"save_times": [0.5 * duration * save / layers for save in halves]},
    }


def roughnesses(data):
    """Return Sa at each save, in m."""
    with Simulation(data).run() as result:
        patch = result.body("patch")
        surfaces = [patch.surface(save) for save in range(len(result.times))]
        return [np.mean(np.abs(z - z.mean())) for z in surfaces]


def main(cells=32, particles=4):
    """Print Sa over the depth worn."""
    sizes = {"cells": cells, "particles": particles}
    runs = {
        "rough": case(160e-9, **sizes),
        "smooth": case(20e-9, **sizes),
        "archard": case(160e-9, ARCHARD, **sizes),
    }
    columns = {name: roughnesses(data) for name, data in runs.items()}
    print("layers worn   " + "   ".join(f"{name:>7}" for name in columns), "  Sa in nm")
    for save, row in enumerate(zip(*columns.values(), strict=True)):
        print(f"{save / 2:11.1f}   " + "   ".join(f"{1e9 * sa:7.2f}" for sa in row))
    settled = {name: sum(sa[6:]) / len(sa[6:]) for name, sa in columns.items()}
    print("mean from 3   " + "   ".join(f"{1e9 * sa:7.2f}" for sa in settled.values()))
    return settled


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
