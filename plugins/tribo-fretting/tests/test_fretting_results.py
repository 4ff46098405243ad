"""What a report and pictures say of a result that frets."""

import numpy as np
import pandas as pd
import pytest
from fretting_problems import LOAD, MU, K, ball, case
from tribo import Simulation

from tribo_fretting.closed_forms import force_ratio, stick_radius
from tribo_fretting.columns import COLUMNS
from tribo_fretting.figures import loop, running_conditions
from tribo_fretting.plugin import tribo_figures


@pytest.fixture(scope="module")
def result():
    motion = {"stiffness": "100 N/um", "cycles": 100}
    with Simulation(case(40, "2.6 um", motion=motion)).run() as frets:
        yield frets


def test_columns_give_each_cycle(result):
    first, last = result.saves()[0], result.saves()[-1]
    steel = ball(8)
    force = last["tangential_force_N"]
    moved = 2.6e-6 - force / 1e8
    ratio = force_ratio(moved, MU * LOAD, steel.contact_radius, steel.compliance)
    assert force == pytest.approx(ratio * MU * LOAD, rel=1e-3, abs=0)
    stuck = stick_radius(ratio, steel.contact_radius)
    for axis in "xy":
        assert last[f"stick_half_width_{axis}_m"] == pytest.approx(stuck, abs=12.5e-6)
    assert last["stick_part"] == pytest.approx((stuck / steel.contact_radius) ** 2, rel=0.1, abs=0)
    energy = float(result.dataset["friction_energy"][-1])
    assert last["cycle_energy_J"] == pytest.approx(0.01 * energy, rel=0.01, abs=0)
    assert last["volume_per_work_m3_J"] == pytest.approx(K / MU, rel=1e-9, abs=0)
    assert "volume_per_work_m3_J" not in first


def test_energy_and_stick_zone_count_both_directions():
    motion = {"direction": "free", "cycles": 1}
    bodies = case()["bodies"]
    oval = {"type": "paraboloid", "radius_x": "5 mm", "radius_y": "20 mm"}
    bodies["ball"] = bodies["ball"] | {"surface": oval, "wear": {"type": "archard", "k": 0}}
    with Simulation(case(40, "2 um", size="0.7 mm", motion=motion, bodies=bodies)).run() as frets:
        last, work = frets.saves()[-1], float(frets.dataset["friction_energy"][-1])
    assert last["cycle_energy_J"] == pytest.approx(work, rel=1e-9, abs=0)
    assert last["stick_half_width_y_m"] > 1.5 * last["stick_half_width_x_m"] > 0


def test_rows_give_the_last_cycle(result):
    rows = {row.key: row.value for row in result.report().rows}
    last = result.saves()[-1]
    assert {f"quantities.{column.label}" for column in COLUMNS} == rows.keys()
    assert all(rows[f"quantities.{column.label}"] == last[column.label] for column in COLUMNS)


def test_running_conditions_are_drawn_over_load_and_amplitude():
    columns = ["load.normal_N", "kinematics.amplitude_m", "stick_part"]
    runs = pd.DataFrame([[25.0, 3e-6, 0.0], [100.0, 1e-6, 0.6]], columns=columns)
    dots = running_conditions(runs).axes[0].collections[0]
    assert np.asarray(dots.get_offsets()) == pytest.approx(np.array([[25, 3], [100, 1]]))
    assert dots.get_array().tolist() == [0, 0.6]


def test_the_area_of_a_loop_is_its_energy(result):
    moved, force = loop(result, 0)
    saved = {name: column[0] for name, column in result.table("saves").items()}
    area = 0.5 * np.sum((np.roll(moved, -1) + moved) * (np.roll(force, -1) - force))
    assert abs(area) == pytest.approx(saved["cycle_energy_J"], rel=0.02, abs=0)
    ends = [2.6e-6, saved["tangential_force_N"]]
    assert [moved.max(), force.max()] == pytest.approx(ends, rel=1e-6, abs=0)


def test_pictures_show_loops_and_slip(result):
    pictures = {name: draw() for name, draw in tribo_figures(result).items()}
    lines = pictures["fretting_loops"].axes[0].lines
    assert [line.get_label() for line in lines] == ["0 cycles", "100 cycles"]
    slip = result.field("slip", -1, "ball")
    stuck = (result.field("pressure", -1) > 0) & (slip == 0)
    shown = pictures["slip_map"].axes[0].images[0].get_array()
    assert np.nanmax(shown) == pytest.approx(1e6 * slip.max(), rel=1e-9, abs=0)
    assert np.count_nonzero(shown == 0) == np.count_nonzero(stuck)
