"""A square pin on a disk, either in a layer that wears at a tenth of the rate below it."""

K, PRESSURE, COATING = 1e-15, 10e6, 2e-6
STEEL = {"young": "207 GPa", "poisson": 0.3}
SLOW, FAST = ({"type": "archard", "k": k} for k in (K, 10 * K))
# 20 m at the rate of the coating, on the body that stays in contact.
THROUGH = COATING / (K * PRESSURE)


def coated(**more):
    layer = {"thickness": COATING, "wear": SLOW, **more}
    return {"surface": "flat", "material": STEEL, "wear": FAST, "layers": [layer]}


def flat(pin=None, disk=None, distance="300 m", **more):
    """A square pin on a disk: the pressure is even, and stays so."""
    plain = {"surface": "flat", "material": STEEL}
    return {
        "grid": {"size": "2 mm", "cells": 8, "ends_at_window": True},
        "load": "40 N",
        "bodies": {"pin": pin or plain, "disk": disk or plain},
        "contact": {"type": "winkler", "modulus": 1e13, "plasticity": False},
        "kinematics": {
            "type": "unidirectional",
            "speed": "0.1 m/s",
            "track_length": "20 mm",
            "distance": distance,
        },
        **more,
    }
