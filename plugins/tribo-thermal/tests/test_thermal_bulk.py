"""The bulk temperature as a state, against the balance of heat."""

import math

import numpy as np
import pytest
from tribo import CaseError, Simulation

from tribo_thermal.flash import Flash

PATH = {"length": "20 mm", "area": "78.5 mm^2", "capacity": "5 J/K"}
RESISTANCE = 0.02 / (78.5e-6 * 46)
TIME = 5 * RESISTANCE
POWER = 0.3 * 100 * 0.1
STEEL = {
    "young": "207 GPa",
    "poisson": 0.3,
    "density": "7850 kg/m^3",
    "conductivity": "46 W/(m K)",
    "heat_capacity": "460 J/(kg K)",
}


def case(speed, **effect):
    wear = {"type": "archard", "k": "1e-16 1/Pa"}
    ball = {"surface": {"type": "sphere", "radius": "5 mm"}, "material": STEEL, "wear": wear}
    flash = {"type": "thermal.flash", "ambient": 300, "heat_paths": {"ball": PATH}, **effect}
    motion = {"type": "unidirectional", "speed": speed, "track_length": "100 mm", "duration": 40}
    return {
        "grid": {"size": "0.8 mm", "cells": 24},
        "load": {"normal": 100},
        "friction": {"coefficient": 0.3},
        "bodies": {"ball": ball, "disk": {"surface": "flat", "material": STEEL}},
        "contact": "winkler",
        "kinematics": motion,
        "effects": [flash],
    }


@pytest.mark.parametrize("stepping", [{"type": "implicit"}, {"type": "explicit", "time_step": 2}])
def test_the_bulk_follows_a_load_that_rises_within_a_step(stepping):
    ramp = [{"at": 0, "normal": 100}, {"at": 40, "normal": 200}]
    given = {**case(0.1, heat_fraction={"ball": 1, "disk": 0}), "stepping": stepping}
    with Simulation({**given, "load": {"normal": ramp}}).run() as result:
        bulk = float(result.bulk_rise_ball[-1])
    # C dB/dt = P + P't − B/R, from B = 0.
    power, slope = POWER, POWER / 40
    lagging = power - slope * TIME
    exact = RESISTANCE * (lagging + slope * 40 - lagging * math.exp(-40 / TIME))
    assert bulk == pytest.approx(exact, rel=1e-5)


def test_shared_heat_makes_both_surfaces_equally_hot_while_one_bulk_warms():
    with Simulation(case(0.1)).run() as result:
        ball, disk = (result.body(name).effects["temperature"] for name in ("ball", "disk"))
        bulk = result.bulk_rise_ball.to_numpy()
    np.testing.assert_allclose(ball, disk, rtol=1e-12)
    assert 0 < bulk[-1] < POWER * RESISTANCE


def test_what_warms_in_time_needs_a_path():
    with pytest.raises(CaseError, match="a capacity needs a length"):
        Flash(ambient=300, heat_paths={"ball": {**PATH, "length": 0}})
