"""The cross-shear share of points that are always in contact, and what it makes them lose."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from tribo import LocalConditions, Material, Simulation, Surface

from tribo_uhmwpe.cross_shear import CrossShear

SIDE, PRESSURE = 0.4e-3, 1e6
ALONG, ACROSS = 1e-15, 6.4e-15
LAW = CrossShear(k_along=ALONG, k_across=ACROSS)


class Punch(Surface):
    """A square end with sharp edges: on springs its pressure is even, and stays so."""

    def height(self, grid):
        x, y = np.broadcast_arrays(*grid.mesh)
        return np.where(np.maximum(abs(x), abs(y)) < 0.5 * SIDE, 0.0, -1.0)


def run(motion, plate=None):
    """A punch on a plate, with a save after a hundredth of a turn and after a whole one."""
    steel = {"young": "210 GPa", "poisson": 0.3}
    case = {
        "grid": {"size": 1e-3, "cells": 20},
        "load": {"normal": PRESSURE * SIDE**2},
        "bodies": {
            "pin": {"surface": Punch(), "material": steel, "wear": LAW},
            "plate": {"surface": "flat", "material": steel, "wear": plate},
        },
        "contact": {"type": "winkler", "modulus": 1e13},
        "stepping": {"type": "implicit", "settle": 0.5},
        "kinematics": {"duration": 0.1, **motion},
        "output": {"save_times": [0, 1e-3, 0.1]},
    }
    return Simulation(case).run()


def test_a_fresh_point_wears_as_along_a_straight_path():
    fresh = np.zeros((1, 2, 1))
    fields = {"heading_x": fresh + 0.6, "heading_y": fresh + 0.8}
    state = {field.name: fresh for field in LAW.state_fields}
    material = Material(young=1e9, poisson=0.4)
    rate = LAW.rate(LocalConditions(fresh + PRESSURE, 1.0, material, fields, state))
    np.testing.assert_allclose(rate.depth_rate, ALONG * PRESSURE, rtol=1e-12)


def test_that_the_share_jumps_as_sliding_begins_takes_no_more_calls(monkeypatch):
    calls, rate = [], CrossShear.rate

    def counted(law, local):
        calls.append(local)
        return rate(law, local)

    monkeypatch.setattr(CrossShear, "rate", counted)
    motion = {"type": "planar", "path": "circle", "extent": (4e-4, 4e-4), "positions": 8}
    run({**motion, "speed": 12e-3}).close()
    assert len(calls) < 100


@pytest.mark.slow
def test_the_readme_shows_what_its_example_prints(capsys):
    package = Path(__file__).parents[1]
    runpy.run_path(str(package / "examples" / "circle_and_straight.py"))
    assert capsys.readouterr().out in (package / "README.md").read_text(encoding="utf-8")
