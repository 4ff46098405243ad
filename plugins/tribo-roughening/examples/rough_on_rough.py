"""A patch slides over a rough plate, both periodic, the cycle resolved.

python rough_on_rough.py [CELLS [PARTICLES [POSITIONS]]]: the plate hard, then worn as well.
"""

import sys

import numpy as np
from settled_roughness import case
from tribo import Simulation


def rough_on_rough(sq, plate_wears, *, cells=32, particles=4, positions=9, layers=5):
    """Return a patch of roughness `sq` (m) that slides over a plate of 20 nm."""
    data = case(sq, cells=cells, particles=particles, layers=layers)
    patch, size = data["bodies"]["patch"], data["grid"]["size"]
    # A resolved cycle takes many steps as it is.
    del data["stepping"]["depth_tolerance"]
    surface = {**patch["surface"], "sq": 20e-9, "seed": 9}
    data["bodies"]["plate"] = {
        "surface": surface,
        "material": patch["material"],
        "wear": {**patch["wear"], "seed": 5} if plate_wears else None,
    }
    # Over one window, which repeats: as sliding on without end, at 1 m/s.
    data["kinematics"] = {
        "type": "reciprocating",
        "stroke": size,
        "frequency": 0.5 / size,
        "positions": positions,
        "duration": data["kinematics"]["duration"],
    }
    return data


def main(cells=32, particles=4, positions=9):
    """Print Ra of the patch along and across the sliding over the depth worn."""
    sizes = {"cells": cells, "particles": particles, "positions": positions}
    for words, sq, plate_wears in (
        ("hard plate, rough patch", 160e-9, False),
        ("hard plate, smooth patch", 20e-9, False),
        ("both wear", 20e-9, True),
    ):
        print(f"{words}\nlayers worn       Sa    along   across   in nm")
        with Simulation(rough_on_rough(sq, plate_wears, **sizes)).run() as result:
            patch = result.body("patch")
            for save in range(len(result.times)):
                z = patch.surface(save)
                means = z.mean(), z.mean(axis=0), z.mean(axis=1, keepdims=True)
                shown = (np.mean(np.abs(z - mean)) for mean in means)
                print(f"{save / 2:11.1f}", *(f"{1e9 * each:8.2f}" for each in shown))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
