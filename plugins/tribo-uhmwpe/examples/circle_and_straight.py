"""A flat pin of polyethylene on a plate: round a circle, and to and fro on a path as long."""

import math

from tribo import Simulation

DIAMETER, LOAD, TURNS = 5e-3, 70.0, 1e6
STRAIGHT = [(0, 0), (0.5 * math.pi * DIAMETER, 0)]
MOTIONS = {
    "circle": {"path": "circle", "extent": (DIAMETER, DIAMETER)},
    "straight": {"path": STRAIGHT},
}

print("            path   volume    depth  wear factor")
print("              km      mm³       µm    mm³/(N m)")
for name, path in MOTIONS.items():
    case = {
        "grid": {"size": "16 mm", "cells": 32},
        "load": {"normal": LOAD},
        "bodies": {
            "pin": {
                "surface": {"type": "pin", "radius": "5 mm", "edge": "2 mm"},
                "material": {"young": "1 GPa", "poisson": 0.4},
                "wear": {
                    "type": "uhmwpe.cross_shear",
                    "k_along": "0.98e-6 mm^3/(N m)",
                    "k_across": "6.3e-6 mm^3/(N m)",
                },
            },
            "plate": {"surface": "flat", "material": {"young": "210 GPa", "poisson": 0.3}},
        },
        # The pin is 10 mm long: springs of 1 GPa/10 mm.
        "contact": {"type": "winkler", "modulus": 1e11},
        "kinematics": {
            "type": "planar",
            "speed": DIAMETER * math.pi,
            "revolutions": TURNS,
            "positions": 8,
            **path,
        },
    }
    with Simulation(case).run() as result:
        distance, pin = result.saves()[-1]["distance_m"], result.saves()[-1]["bodies"]["pin"]
    volume, depth = 1e9 * pin["wear_volume_m3"], 1e6 * pin["max_wear_depth_m"]
    factor = volume / (LOAD * distance)
    print(f"{name:9}{1e-3 * distance:7.1f}{volume:9.2f}{depth:9.1f}{factor:13.2e}")
