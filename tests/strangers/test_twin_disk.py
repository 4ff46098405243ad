"""Both bodies swept, each over its own circumference."""

import numpy as np
import pytest
from strangers import twin_disk

from tribo import CaseError, Registry, Simulation

STEEL = {"young": "207 GPa", "poisson": 0.3, "hardness": "0.8 GPa"}
WEAR = {"type": "archard", "k": 1e-15}
CASE = {
    "grid": {"size": "1.2 mm", "cells": 48},
    "load": {"normal": "50 N"},
    "bodies": {
        "upper": {"surface": {"type": "paraboloid", "radius": "20 mm"}},
        "lower": {"surface": {"type": "cylinder", "radius": "15 mm", "axis": "y"}},
    },
    "kinematics": {
        "type": "stranger.twin_disk",
        "speed": "2 m/s",
        "slip": 0.05,
        "circumference": {"upper": 0.15, "lower": 0.10},
        "duration": 60,
    },
}
for body in CASE["bodies"].values():
    body |= {"material": STEEL, "wear": WEAR}


@pytest.fixture(scope="module")
def registry():
    return Registry.with_plugins(twin_disk)


def test_a_disk_that_the_case_does_not_have_is_named(registry):
    kinematics = {**CASE["kinematics"], "circumference": {"upper": 0.15, "disk": 0.10}}
    with pytest.raises(CaseError, match=r"^kinematics\.circumference: is given for upper, disk"):
        Simulation({**CASE, "kinematics": kinematics}, registry=registry)


def test_yielding_disks_get_grooves_all_the_way_round(registry):
    with Simulation(CASE, registry=registry).run() as result:
        first, last = (result.body("upper").plastic_depth[i] for i in (0, -1))
    assert np.ptp(first, axis=0).max() > 0
    assert last.max() > 0
    assert np.ptp(last, axis=0).max() == 0
