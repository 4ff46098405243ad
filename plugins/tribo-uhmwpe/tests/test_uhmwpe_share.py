"""The cross-shear share of points that are always in contact, and what it makes them lose."""

import runpy
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from tribo import LocalConditions, Material, load_case

from tribo_uhmwpe.cross_shear import CrossShear

LAW = CrossShear(k_along=1e-15, k_across=6.4e-15)
CASE = files("tribo_uhmwpe") / "cases" / "cross_shear_straight" / "case.toml"
QUICK = ["grid.cells=32", "contact={type='winkler', modulus=1e13}", "stepping.settle=0.5"]


def test_a_fresh_point_wears_as_along_a_straight_path():
    fresh = np.zeros((1, 2, 1))
    fields = {"heading_x": fresh + 0.6, "heading_y": fresh + 0.8}
    state = {field.name: fresh for field in LAW.state_fields}
    material = Material(young=1e9, poisson=0.4)
    rate = LAW.rate(LocalConditions(fresh + 1e6, 1.0, material, fields, state))
    np.testing.assert_allclose(rate.depth_rate, 1e-15 * 1e6, rtol=1e-12)


def test_that_the_share_jumps_as_sliding_begins_takes_no_more_calls(monkeypatch):
    calls, rate = [], CrossShear.rate

    def counted(law, local):
        calls.append(local)
        return rate(law, local)

    monkeypatch.setattr(CrossShear, "rate", counted)
    motion = "{type='planar', path='circle', extent=[4e-4, 4e-4], positions=8, speed=0.012"
    motion = f"kinematics={motion}, duration=0.1}}"
    load_case(CASE, overrides=[*QUICK, motion]).run().close()
    assert len(calls) < 100


@pytest.mark.parametrize(("stroke", "positions"), [(4e-3, "'average'"), (2e-4, 9)])
def test_there_is_no_cross_shear_to_and_fro(stroke, positions):
    motion = f"{{type='reciprocating', stroke={stroke}, frequency=10, positions={positions}"
    law = "bodies.flat.wear={type='uhmwpe.cross_shear', k_along=1e-15, k_across=6.4e-15}"
    given = [*QUICK, law, f"kinematics={motion}, duration=0.1}}"]
    with load_case(CASE, overrides=given).run() as result:
        for body in result.body_names:
            fields = ("slid_path", "slid_cosine", "slid_sine")
            path, *moments = (result.field(field, -1, body)[16, 16] for field in fields)
            assert path > 0
            assert 1 - np.hypot(*moments) / path == 0


@pytest.mark.slow
def test_the_readme_shows_what_its_example_prints(capsys):
    package = Path(__file__).parents[1]
    runpy.run_path(str(package / "examples" / "circle_and_straight.py"))
    assert capsys.readouterr().out in (package / "README.md").read_text(encoding="utf-8")
