"""A stranger's law gets everything else for nothing."""

import numpy as np
import pytest
from strangers import laws
from strangers.protected import Protected
from strangers.running_in import RunningIn
from strangers.transition import Transition

from tribo import CaseError, Registry, Simulation

CONFIGS = {
    Protected: {"k": "1e-15 1/Pa"},
    RunningIn: {"k_first": "4e-15 1/Pa", "k_last": "1e-15 1/Pa", "length": "0.7 m"},
    Transition: {"k": "1e-15 1/Pa", "p_severe": "400 MPa"},
}
STEEL = {"young": "207 GPa", "poisson": 0.3}
SLID = 2 * 4e-3 * 12.5 * 20
LAWS = pytest.mark.parametrize("law", CONFIGS, ids=lambda law: law.type)


@pytest.fixture(scope="module")
def registry():
    return Registry.with_plugins(laws)


def effect(power="50 MW/m^2"):
    return [{"type": "stranger.oxide_film", "power": power}]


def case(law, **changes):
    wear = {"type": law.type, **CONFIGS[law]}
    sphere = {"type": "sphere", "radius": "5 mm"}
    return {
        "grid": {"size": "0.5 mm", "cells": 24},
        "load": {"normal": "20 N"},
        "bodies": {
            "ball": {"surface": sphere, "material": STEEL, "wear": wear},
            "disk": {"surface": {"type": "flat"}, "material": STEEL, "wear": wear},
        },
        "kinematics": {
            "type": "reciprocating",
            "stroke": "4 mm",
            "frequency": "12.5 Hz",
            "positions": "average",
            "duration": "20 s",
        },
        "stepping": {"depth_tolerance": 0.05, "pressure_tolerance": 0.5, "settle": 0.5},
        "friction": {"coefficient": 0.4},
        "effects": effect() if law.requires else [],
        **changes,
    }


@pytest.fixture(scope="module")
def results(registry):
    return {law: Simulation(case(law), registry=registry).run() for law in CONFIGS}


def volume(result, body="ball"):
    return result.saves()[-1]["bodies"][body]["wear_volume_m3"]


@pytest.mark.slow
@LAWS
def test_it_runs_implicit_with_stroke_averaging_and_both_bodies_lose_the_same(law, results):
    ball, disk = (results[law].body(name).wear_depth[-1] for name in ("ball", "disk"))
    assert np.all(disk == disk[:1])
    assert np.any(ball != ball[:1])
    ratio = volume(results[law], "disk") / volume(results[law])
    if law is RunningIn:
        # The disk's points slide less under pressure: they are still running in.
        assert ratio > 1.5
    else:
        assert ratio == pytest.approx(1.0, rel=1e-9)


@pytest.mark.slow
def test_a_law_that_is_not_linear_wears_more_where_pressure_is_high(results):
    # ∫ p (1 + (p/p_severe)²) is more than the load, by less than the first peak allows.
    most = 1 + (results[Transition].saves()[0]["max_pressure_Pa"] / 400e6) ** 2
    assert 1.1 < volume(results[Transition]) / (1e-15 * 20 * SLID) < most


@pytest.mark.slow
def test_oxide_halves_the_wear_where_its_power_is_reached(registry):
    # Without bounds on the film, 1 − c tends to 1 for a power that is never reached.
    worn = [
        volume(Simulation(case(Protected, effects=effect(power)), registry=registry).run())
        for power in ("1 MW/m^2", "1e15 W/m^2")
    ]
    assert worn[1] == pytest.approx(1e-15 * 20 * SLID, rel=1e-6, abs=0)
    assert worn[0] < 0.5 * worn[1]


def test_a_missing_effect_is_named_with_the_law_and_its_place(registry):
    with pytest.raises(CaseError) as caught:
        Simulation(case(Protected, effects=[]), registry=registry)
    message = str(caught.value)
    assert message.startswith("bodies.ball.wear: wear law 'stranger.protected' needs ")
    assert "stranger_oxide" in message
    assert "effects = [{ type = 'stranger.oxide_film' }]" in message


def test_what_an_effect_requires_of_the_case_is_named_too(registry):
    with pytest.raises(CaseError, match=r"'stranger\.oxide_film' needs a coefficient of friction"):
        Simulation(case(Protected, friction=None), registry=registry)
