"""Film thickness, its share of the load and its friction, alone and in runs."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from tribo import Simulation

from tribo_film.mixed import Mixed
from tribo_film.plugin import tribo_lab_rows

STEEL = {"young": "207 GPa", "poisson": 0.3}
OIL = {"viscosity": 0.1, "pressure_viscosity": 2e-8, "radius": 5e-3}
K = 1e-16
HERE = Path(__file__).parent


def case(speed=0.1, **film):
    wear = {"type": "archard", "k": K}
    ball = {"surface": {"type": "sphere", "radius": "5 mm"}, "material": STEEL, "wear": wear}
    effects = [Mixed(**{**OIL, "roughness": 1e-7, **film}).model_dump()] if film is not None else []
    return {
        "grid": {"size": "0.7 mm", "cells": 24},
        "load": {"normal": 100},
        "bodies": {"ball": ball, "disk": {"surface": "flat", "material": STEEL}},
        "contact": "winkler",
        "kinematics": {
            "type": "unidirectional",
            "speed": speed,
            "track_length": "100 mm",
            "distance": 2,
        },
        "effects": effects,
    }


def lost(given):
    with Simulation(given).run() as result:
        last = result.saves()[-1]
        return last["bodies"]["ball"]["wear_volume_m3"], last["friction_force_N"]


def test_without_viscosity_it_is_the_dry_case_to_the_bit():
    dry = case()
    dry["effects"], dry["friction"] = [], {"coefficient": 0.12}
    volume, force = lost(dry)
    assert lost(case(viscosity=0.0)) == (volume, pytest.approx(force, rel=1e-12))


def test_over_a_thick_film_nothing_wears():
    with Simulation(case(roughness=1e-30)).run() as result:
        assert result.body("ball").effects["load_share"][-1].max() == 1
        assert result.saves()[-1]["bodies"]["ball"]["wear_volume_m3"] == 0


@pytest.mark.parametrize(("k", "beyond"), [(1e-16, False), (1e-14, True)])
def test_the_lab_is_told_where_wear_is_too_deep_for_the_film(k, beyond):
    given = case()
    given["bodies"]["ball"]["wear"]["k"] = k
    with Simulation(given).run() as result:
        (row,) = tribo_lab_rows(result)
        depth = result.body("ball").wear_depth[-1].max()
        assert row.value == pytest.approx(depth / result.saves()[0]["approach_m"])
        found = [each for each in result.report().findings if each.kind == "validity"]
    assert [(each.value, each.limit) for each in found] == [(row.value, 1.0)] * beyond
    assert beyond == (row.value > 1)


def test_the_lab_is_told_nothing_of_a_film_that_is_not_there():
    with Simulation({**case(), "effects": []}).run() as result:
        assert tribo_lab_rows(result) == []


def test_the_stribeck_curve_of_the_readme():
    curve = runpy.run_path(str(HERE.parent / "examples" / "stribeck.py"))["curve"]()
    friction = np.array([row[2] for row in curve])
    assert np.all(np.diff(friction) < 0)
    assert friction[0] == pytest.approx(0.12, rel=0.02)
    assert friction[-1] == pytest.approx(0.03, rel=0.1)
    shown = (HERE.parent / "README.md").read_text()
    for speed, ratio, coefficient, part in curve:
        assert f"{speed:10.3g}{ratio:10.3g}{coefficient:12.3f}{part:12.3g}" in shown
