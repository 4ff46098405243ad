"""A load that changes over time: volumes, contacts and bits."""

import numpy as np
import pytest
from paper_models import (
    K,
    archard,
    case,
    foundation,
    half_space,
    motion,
    pair,
    small,
    states,
)

from tribo import CaseError, Grid, Load, Simulation, Stage, load_case
from tribo.core.loads import Loads

GRID = Grid((0.7e-3, 0.7e-3), (32, 32))
SPEED = 0.1
"""Of `motion`, in m/s."""
BLOCKS = (Stage(until="6 s", normal="20 N"), Stage(until="1 h", normal="100 N"))
RAMP = (Stage(at=0, normal=20), Stage(at=8, normal=100), Stage(at=60, normal=10))
"""40 N by 2 s, 100 N by 8 s, 61.9 N by 30 s."""


def loaded(load, duration=20, **changes):
    parts = {"grid": GRID, "contact": foundation(), "kinematics": motion(duration=duration)}
    return small(load=load, **{**parts, **changes})


def volumes(model, state):
    return [model.cycle.maps[name].volume(body.wear) for name, body in state.bodies.items()]


@pytest.mark.slow
def test_a_save_at_a_jump_shows_the_load_before_it_and_the_run_goes_on_under_the_next():
    with Simulation(loaded(BLOCKS, save_times=(3, 6, 7))).run() as result:
        np.testing.assert_array_equal(result.times, [0, 3, 6, 7, 20])
        np.testing.assert_array_equal(result.load, [20, 20, 20, 100, 100])
        carried = [np.sum(result.field("pressure", save)) * GRID.cell_area for save in range(5)]
        np.testing.assert_allclose(carried, [20, 20, 20, 100, 100], rtol=1e-8)
        rate = result.report().bodies["disk"].specific_wear_rate_mm3_per_Nm
    assert rate == pytest.approx(1e9 * K, rel=1e-9, abs=0)


@pytest.mark.slow
def test_a_jump_to_a_higher_load_yields_anew_up_to_the_hardness():
    bodies = pair(archard(), archard(), hardness=(None, 1.2e9))
    found = states(loaded(BLOCKS, bodies=bodies, contact=half_space(), save_times=(6,)))
    deepest = {state.time: state.bodies["disk"].plastic.max() for state in found}
    assert deepest[20.0] > 2 * deepest[6.0] > 0
    assert all(state.contact.pressure.max() <= 1.2e9 * (1 + 1e-9) for state in found)


def test_at_a_jump_the_loads_before_it_and_after_it_differ():
    loads = Loads(Load(normal=BLOCKS).points, factor=0.5)
    assert (loads.before(6.0), loads.after(6.0)) == (10.0, 50.0)


def test_an_estimate_takes_few_stages_that_carry_as_much():
    times = np.linspace(0, 20, 1001)
    load = Load(normal=[{"at": t, "normal": 60 + 40 * np.sin(3 * t)} for t in times])
    few = load.thinned()
    assert len(few.normal) == 50
    assert few.normal[0].until == pytest.approx(times[20], rel=1e-12, abs=0)
    carried = np.diff([0, *(stage.until for stage in few.normal)]) * [s.normal for s in few.normal]
    exact = np.trapezoid([stage.normal for stage in load.normal], times)
    assert np.sum(carried) == pytest.approx(exact, rel=1e-12, abs=0)
    assert Load(normal=BLOCKS).thinned() == Load(normal=BLOCKS)


def test_stages_come_from_a_file_or_a_table_and_survive_the_way_through_plain_data(tmp_path):
    (tmp_path / "load.csv").write_text("time_s,load_N\n0,20\n8,100\n60,10\n")
    from_file = Load(normal=tmp_path / "load.csv")
    assert from_file == Load(normal=RAMP) == case(load=RAMP).load
    assert Load.model_validate(from_file.model_dump(mode="json")) == from_file
    (tmp_path / "case.toml").write_text(
        "[grid]\nsize = '0.7 mm'\ncells = 16\n"
        "[load]\nnormal = [{ until = '6 s', normal = '20 N' }, { until = '1 h', normal = 100 }]\n"
        "[kinematics]\ntype = 'reciprocating'\nstroke = '2 mm'\nfrequency = 25\nduration = 20\n"
        "[bodies.ball]\nsurface = { type = 'sphere', radius = '5 mm' }\n"
        "material = { young = '207 GPa', poisson = 0.3 }\n"
        "[bodies.disk]\nsurface = 'flat'\nmaterial = { young = '207 GPa', poisson = 0.3 }\n"
    )
    assert load_case(tmp_path / "case.toml").load == Load(normal=BLOCKS)
    changed = load_case(tmp_path / "case.toml", overrides=["load.normal.2.normal=50 N"])
    assert changed.load.normal[1].normal == 50


@pytest.mark.parametrize(
    ("normal", "words"),
    [
        ([], "the list is empty; give a number, or the stages of the load up to the end"),
        ([{"at": 3, "normal": 5}, {"at": 4, "normal": 5}], "begins at 3 s"),
        ([{"until": 3, "normal": 5}, {"at": 3, "normal": 9}], "3 s is followed by 3 s"),
        ([{"until": 3, "normal": 0}], "0 N: must be greater than 0; .*pause.*speed = 0"),
        ([{"until": 3, "at": 3, "normal": 5}], "either until, .* or at"),
        ({"until": 3, "normal": 5}, "write a list"),
        ("load.txt", "is not a quantity"),
    ],
)
def test_a_load_over_time_that_makes_no_sense_is_refused(normal, words):
    with pytest.raises(CaseError, match=words):
        Simulation({"load": {"normal": normal}})


def test_a_file_with_a_load_of_zero_is_refused(tmp_path):
    (tmp_path / "load.csv").write_text("0,20\n8,0\n")
    with pytest.raises(ValueError, match="a load of 0 N at 8 s"):
        Load(normal=tmp_path / "load.csv")


def test_a_load_that_ends_before_the_run_is_refused():
    words = r"load\.normal: the load ends at 6 s, before the run does at 20 s"
    with pytest.raises(CaseError, match=words):
        loaded(BLOCKS[:1])
