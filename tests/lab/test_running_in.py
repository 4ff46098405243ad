"""Roughness of worn bodies in a result."""

import json
from importlib.resources import files

import numpy as np
import pytest
from click.testing import CliRunner
from made_results import made

import tribo
from tribo import Simulation, load_case
from tribo.cli.show import show
from tribo.lab.roughness import roughness
from tribo.lab.running_in import (
    contact_roughness,
    groove_length,
    outlined,
    rough_bodies,
    scar_cells,
    worn_roughness,
)

WAVES = 'type = "rough", sq = "50 nm", cut_off = "0.125 mm", roll_off = "0.25 mm"'
ROUGH = [
    "grid.size='1 mm'",
    "grid.cells=32",
    f"bodies.ball.surface={{ {WAVES}, seed = 1, on = {{ type = 'sphere', radius = '5 mm' }} }}",
    f"bodies.disk.surface={{ {WAVES}, seed = 2 }}",
    "kinematics.stroke='1 mm'",
    "kinematics.positions=25",
    "kinematics.duration='10 s'",
    "output.save_times=[0, 10]",
]


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """A rough ball on a rough disk, the cycle resolved."""
    path = tmp_path_factory.mktemp("rough") / "rough.h5"
    run(path, *ROUGH).close()
    return path


def run(path, *overrides):
    template = files("tribo.templates") / "ball_on_disk.toml"
    return Simulation(load_case(template, overrides=overrides)).run(path)


def shown(path, *options):
    return CliRunner().invoke(show, [str(path), *options], catch_exceptions=False).stdout


@pytest.mark.parametrize("contact", ["dcfft", "periodic"])
def test_a_resolved_groove_has_ends_in_a_window_that_repeats_too(tmp_path, contact):
    resolved = ["kinematics.stroke='0.2 mm'", "kinematics.positions=7", "kinematics.duration='9 s'"]
    grid = ["grid.size='1.2 mm'", "grid.cells=32", "output.save_times=[0, 9]"]
    with run(tmp_path / "run.h5", *resolved, *grid, f"contact.type='{contact}'") as result:
        contacts = [result.field("pressure", save).any(axis=1) for save in (0, -1)]
        length = groove_length(result, "disk")
    first, last = (1.2e-3 / 32 * np.count_nonzero(rows) for rows in contacts)
    assert first + 0.1e-3 < length < last + 0.25e-3


def test_a_scar_has_its_unworn_valleys_too():
    x, y = np.indices((40, 30)) - 15
    scar = (x / 12) ** 2 + (y / 8) ** 2 < 1
    filled = outlined(scar & (np.random.default_rng(1).random(scar.shape) < 0.5))
    assert np.all(filled <= scar)
    assert np.count_nonzero(filled) > 0.85 * np.count_nonzero(scar)
    assert not outlined(np.zeros((3, 3), dtype=bool)).any()


def test_running_in_polishes_the_scar_and_leaves_the_rest(path):
    with tribo.open(path) as result:
        assert rough_bodies(result) == ["ball", "disk"]
        for body in map(result.body, result.body_names):
            first, last = (worn_roughness(result, body, save) for save in (0, 1))
            # Before any wear the surface under the contact is the unworn one.
            assert first.scar == first.unworn
            assert last.scar.Sq_m < last.unworn.Sq_m
            assert last.scar.Sz_m < last.unworn.Sz_m
            # Nothing touches the rest, 50 nm rough in all.
            assert last.beside.Sq_m == pytest.approx(50e-9, rel=0.2, abs=0)
            worn = scar_cells(result, body, 1)
            height = np.where(worn, body.surface(1), np.nan)
            assert last.scar == roughness(height, 4)


def test_the_history_has_the_roughness_within_the_contact(path):
    with tribo.open(path) as result:
        history = result.table("history")
        for body in map(result.body, result.body_names):
            for step, save in ((0, 0), (-1, 1)):
                pressure = result.field("pressure", save)
                measured = contact_roughness(body.surface(save), pressure)._asdict()
                for label, value in measured.items():
                    kept = history[f"bodies.{body.name}.{label}"][step]
                    assert kept == pytest.approx(value, rel=1e-9, abs=0)
            unworn = contact_roughness(body.height, result.field("pressure", 1))
            assert history[f"bodies.{body.name}.Sq_m"][-1] < unworn.Sq_m
        assert not any("Sa" in label for label in result.table("saves"))
    assert not any("Sa" in label for label in made().table("history"))


def test_a_smooth_scar_is_not_rough():
    result = made()
    assert rough_bodies(result) == []
    for name in ("ball", "disk"):
        measured = worn_roughness(result, result.body(name), -1)
        # Of a ball worn flat, and a groove as round as it, the form is removed.
        assert measured.beside.Sq_m < 1e-9
        assert measured.scar.Sq_m < 5e-9


def test_json_has_the_roughness_and_the_track_of_each_body_at_each_save(path):
    saves = json.loads(shown(path, "--json"))["saves"]
    for save in saves:
        for body in save["bodies"].values():
            measured = body["roughness"]
            assert 0 < measured["Sa_m"] < measured["Sq_m"] < measured["Sz_m"]
            assert {"Ssk", "Sku", "Ra_along_m", "Rq_across_m"} <= set(measured)
            for place in ("beside", "unworn"):
                assert {*measured} == {*measured[place], "beside", "unworn"}
    ball, disk = (saves[-1]["bodies"][name] for name in ("ball", "disk"))
    assert "track_x_m" not in ball
    x, depth = disk["track_x_m"], disk["track_depth_m"]
    # The window and the stroke, both 1 mm.
    assert x[-1] - x[0] == pytest.approx(2e-3 - 1e-3 / 32, rel=1e-9, abs=0)
    assert max(depth) == pytest.approx(disk["max_wear_depth_m"], rel=0.5, abs=0)
    assert depth[0] == depth[-1] == 0
