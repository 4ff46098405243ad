"""Where a film ends, its rows for the lab, and the curve of the README."""

import runpy
from importlib.resources import files
from math import isnan
from pathlib import Path

import numpy as np
import pytest
from tribo import load_case

from tribo_film.mixed import Mixed
from tribo_film.plugin import tribo_quantities

CASE = files("tribo_film") / "cases" / "film_mixed" / "case.toml"
QUICK = ["contact.type=winkler", "grid.size=0.7 mm", "grid.cells=24", "kinematics.distance=2"]
HERE = Path(__file__).parent


@pytest.mark.parametrize("sharing", ["asperities", "olver_spikes"])
def test_without_a_film_it_is_dry_to_the_bit_and_a_thick_one_carries_all(sharing):
    oil = {"viscosity": 0.1, "pressure_viscosity": 2e-8, "radius": 5e-3, "roughness": 1e-7}
    film = Mixed(**oil, sharing=sharing)
    assert (film.share(0.0), film.friction(0.0)) == (0.0, 0.12)
    assert (film.share(1e22), film.friction(1e22)) == (1.0, pytest.approx(0.03))


@pytest.mark.filterwarnings("ignore:validity")
@pytest.mark.parametrize(("k", "beyond"), [(1e-16, False), (1e-14, True)])
def test_the_lab_is_told_where_wear_is_too_deep_for_the_film(k, beyond):
    with load_case(CASE, overrides=[*QUICK, f"bodies.ball.wear.k={k}"]).run() as result:
        (row,) = result.report().rows
        depth = result.body("ball").wear_depth[-1].max()
        assert row.value == pytest.approx(depth / result.saves()[0]["approach_m"])
        found = [each for each in result.findings if each.kind == "validity"]
    assert [each.limit < each.value <= row.value for each in found] == [True] * beyond
    assert beyond == (row.value > 1)


def test_the_lab_is_told_nothing_of_a_film_that_is_not_there():
    with load_case(CASE, overrides=[*QUICK, "effects=[]"]).run() as result:
        assert [isnan(each.read(result)) for each in tribo_quantities()] == [True]


def test_the_stribeck_curve_of_the_readme():
    curve = runpy.run_path(str(HERE.parent / "examples" / "stribeck.py"))["curve"]()
    friction = np.array([row[2] for row in curve])
    assert np.all(np.diff(friction) < 0)
    assert friction[0] == pytest.approx(0.12, rel=0.02)
    assert friction[-1] == pytest.approx(0.03, rel=0.1)
    shown = (HERE.parent / "README.md").read_text()
    for speed, ratio, coefficient, part in curve:
        assert f"{speed:10.3g}{ratio:10.3g}{coefficient:12.3f}{part:12.3g}" in shown
