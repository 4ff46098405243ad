"""How far a lab's formulas are off, against the rigid limit of a ball that wears on a track."""

import tomllib

import pytest
from ball_on_track import ball_on_track
from made_results import made

from tribo import Simulation
from tribo.config.overrides import apply_settings
from tribo.lab.formulas import circular_groove_area
from tribo.lab.inferred import inferred_volumes, track_section
from tribo.templates import template

CELLS = 96
WINDOW = 1.3e-3
CELL = WINDOW / CELLS
RIGID = {"load": 100.0, "radius": 5e-3, "track_length": 2e-3, "ball_wear_coefficient": 3.11e-16}
ONLY_BALL = {"bodies.disk.wear": {"type": "archard", "k": 0}}


def ran(**settings):
    paper = tomllib.loads(template("ball_on_disk"))
    return Simulation(
        apply_settings(paper, {"grid.cells": CELLS, "grid.size": WINDOW, **settings})
    ).run()


@pytest.fixture(scope="module")
def both():
    """The paper's test, in which ball and disk lose the same."""
    return ran()


def errors(result):
    return {(v.body, v.standard): v.relative_error for v in inferred_volumes(result)}


def test_how_far_the_formulas_are_off_when_both_bodies_wear(both):
    worn = ball_on_track([360.0], **RIGID, flat_wear_coefficient=3.11e-16)
    a, c = worn.half_width_along[0], worn.half_width_across[0]
    shallow = 1 / (4 * worn.ball_volume[0] * RIGID["radius"])
    cap = 3.14159265 * ((a + c) / 2) ** 4 * shallow - 1
    # In the groove, V = π a² c² (1/R − 1/R')/4 with R' = 8c³/12W.
    section = worn.flat_volume[0] / RIGID["track_length"]
    groove = 3.14159265 / 4 * a**2 * c**2 * (1 / RIGID["radius"] - 1.5 * section / c**3)
    width = circular_groove_area(2 * c, RIGID["radius"]) / section - 1
    # Each diameter is good to a cell at either end, and the volumes go as its fourth power.
    reading = 4 * CELL / a
    assert cap > 0.1
    found = errors(both)
    assert found["ball", "ASTM G99"] == pytest.approx(cap, abs=reading)
    assert found["ball", "ASTM D7755"] == pytest.approx(
        groove / worn.ball_volume[0] - 1, abs=reading
    )
    assert found["disk", "ASTM G99"] == pytest.approx(width, rel=reading)
    assert found["disk", "ASTM G99"] > 3


def test_the_flat_cap_is_exact_on_a_coarse_grid_too():
    """Its volume goes as the fourth power of the diameter; springs leave a flat scar."""
    springs = {"contact": {"type": "winkler"}, "output.save_times": []}
    found = errors(ran(**{"grid.cells": 40, **ONLY_BALL, **springs}))
    assert set(found) == {("ball", "ASTM G99")}
    assert found["ball", "ASTM G99"] == pytest.approx(0.0, abs=0.01)


def test_the_section_of_the_track_holds_its_volume(both):
    disk = both.body("disk")
    volume = both.saves()[-1]["bodies"]["disk"]["wear_volume_m3"]
    assert 2e-3 * track_section(both, disk) == pytest.approx(volume, rel=1e-12, abs=0)
    assert track_section(both, both.body("ball")) is None


@pytest.mark.parametrize(
    "changes",
    [
        {"times": (0.0,)},
        {"worn": (False, False)},
        {"curvature": None},
        {"curvature": (0.0, 200.0)},
        {"curvature": (200.0, 100.0)},
    ],
)
def test_nothing_is_inferred_where_no_round_ball_has_worn(changes):
    assert inferred_volumes(made(**changes)) == []
