"""Both bodies swept, each over its own circumference."""

import numpy as np
import pytest
from strangers import twin_disk

from tribo import Registry, Simulation

UPPER, LOWER = 0.15, 0.10
K = {"upper": 2e-15, "lower": 1e-15}
STEEL = {"young": "207 GPa", "poisson": 0.3}
CASE = {
    "grid": {"size": "1.2 mm", "cells": 48},
    "load": {"normal": "50 N"},
    "bodies": {
        "upper": {
            "surface": {"type": "paraboloid", "radius": "20 mm"},
            "material": STEEL,
            "wear": {"type": "archard", "k": K["upper"]},
        },
        "lower": {
            "surface": {"type": "cylinder", "radius": "15 mm", "axis": "y"},
            "material": STEEL,
            "wear": {"type": "archard", "k": K["lower"]},
        },
    },
    "kinematics": {
        "type": "stranger.twin_disk",
        "speed": "2 m/s",
        "slip": 0.05,
        "circumference": {"upper": UPPER, "lower": LOWER},
        "duration": "10 min",
    },
}


@pytest.fixture(scope="module")
def registry():
    return Registry.with_plugins(twin_disk)


@pytest.fixture(scope="module")
def result(registry):
    with Simulation(CASE, registry=registry).run() as result:
        yield result


def test_the_longer_way_round_is_worn_less_deep(result):
    # Each row of both disks has seen the same line load: the depths are as k over circumference.
    upper, lower = (result.body(name).wear_depth[-1] for name in K)
    assert lower.max() > 0
    np.testing.assert_allclose(upper * UPPER / K["upper"], lower * LOWER / K["lower"], rtol=1e-12)
    assert np.all(upper == upper[:1])
    assert result.body("upper").swept
    assert result.body("lower").swept


def test_yielding_disks_get_grooves_all_the_way_round(registry):
    soft = {**STEEL, "hardness": "0.8 GPa"}
    bodies = {name: {**body, "material": soft} for name, body in CASE["bodies"].items()}
    case = {**CASE, "bodies": bodies, "kinematics": {**CASE["kinematics"], "duration": 60}}
    with Simulation(case, registry=registry).run() as result:
        first, last = (result.body("upper").plastic_depth[i] for i in (0, -1))
    assert np.ptp(first, axis=0).max() > 0
    assert last.max() > 0
    assert np.ptp(last, axis=0).max() == 0
