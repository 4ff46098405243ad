"""What a report and pictures say of a result that frets."""

import numpy as np
import pytest
from fretting_problems import LOAD, MU, STEEL, K, ball, case
from tribo import Simulation

from tribo_fretting.closed_forms import force_ratio, stick_radius
from tribo_fretting.cycles import SavedCycle, motion_of
from tribo_fretting.plugin import tribo_figures, tribo_lab_rows


@pytest.fixture(scope="module")
def result():
    motion = {"stiffness": "100 N/um", "cycles": 100}
    with Simulation(case(40, "2.6 um", motion=motion)).run() as frets:
        yield frets


def test_rows_give_the_last_cycle(result):
    rows = {row.label: row.value for row in tribo_lab_rows(result)}
    steel = ball(8)
    force = rows["tangential force"]
    moved = 2.6e-6 - force / 1e8
    ratio = force_ratio(moved, MU * LOAD, steel.contact_radius, steel.compliance)
    assert force == pytest.approx(ratio * MU * LOAD, rel=1e-3, abs=0)
    stuck = 1e6 * stick_radius(ratio, steel.contact_radius)
    assert rows["half-width of the stick zone along x"] == pytest.approx(stuck, abs=12.5)
    assert rows["half-width of the stick zone along y"] == pytest.approx(stuck, abs=12.5)
    energy = float(result.dataset["friction_energy"][-1])
    assert rows["energy of a cycle"] == pytest.approx(1e4 * energy, rel=0.01, abs=0)
    assert rows["worn volume per energy"] == pytest.approx(1e9 * K / MU, rel=1e-9, abs=0)
    assert "coupling of traction and pressure" not in rows


def test_the_area_of_a_loop_is_its_energy(result):
    cycle = SavedCycle(result, motion_of(result), 0)
    moved, force = cycle.loop()
    saved = {name: column[0] for name, column in result.table("saves").items()}
    area = 0.5 * np.sum((np.roll(moved, -1) + moved) * (np.roll(force, -1) - force))
    assert abs(area) == pytest.approx(saved["cycle_energy_J"], rel=0.02, abs=0)
    ends = [2.6e-6, saved["tangential_force_N"]]
    assert [moved.max(), force.max()] == pytest.approx(ends, rel=1e-6, abs=0)


def test_pictures_show_loops_and_slip(result):
    pictures = {name: draw() for name, draw in tribo_figures(result).items()}
    lines = pictures["fretting_loops"].axes[0].lines
    assert [line.get_label() for line in lines] == ["0 cycles", "100 cycles"]
    cycle = SavedCycle(result, motion_of(result), -1)
    shown = pictures["slip_map"].axes[0].images[0].get_array()
    assert np.nanmax(shown) == pytest.approx(1e6 * cycle.slip.max(), rel=1e-9, abs=0)
    assert np.count_nonzero(shown == 0) == np.count_nonzero(cycle.stuck)


def test_unlike_bodies_are_reported_with_their_coupling():
    wrong = case(k=0.0, motion={"cycles": 1})
    wrong["bodies"]["flat"]["material"] = {"young": "116 GPa", "poisson": 0.32}
    wrong["kinematics"]["amplitude"] = "4 um"
    with Simulation(wrong).run() as unlike:
        (row,) = (r for r in tribo_lab_rows(unlike) if r.label.startswith("coupling"))
    assert row.value == pytest.approx(0.0392, rel=0.01, abs=0)
    assert row.finding is not None


def test_other_motions_have_no_rows_of_fretting():
    other = case(k=0.0)
    other["kinematics"] = {"type": "reciprocating", "stroke": "2 mm", "frequency": 1, "cycles": 1}
    other["bodies"]["ball"]["material"] = STEEL
    with Simulation(other).run() as slides:
        assert tribo_lab_rows(slides) == []
        assert tribo_figures(slides) == {}
