"""A sweep does every run once, records what fails, and its tables agree with its results."""

import shutil
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pandas
import pytest
import sweeps

from tribo import sweep
from tribo.core.errors import CaseError, TriboWarning
from tribo.result.checkpoint import hold
from tribo.study.sweeping.sweep import plan


def statuses(swept):
    return list(swept.table["status"])


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    return sweep(
        sweeps.case(tmp_path_factory.mktemp("sweep")), sweeps.LOADS, executor=sweeps.Inline()
    )


@pytest.fixture
def again(swept, tmp_path):
    """Return the case of a copy of that sweep."""
    return shutil.copytree(swept.folder.parent, tmp_path / "copy") / "my.toml"


def test_the_tables_load_in_pandas_with_units_in_the_column_names(swept):
    runs = pandas.read_csv(swept.folder / "runs.csv")
    assert list(runs["run"]) == [1, 2]
    assert list(runs["load.normal_N"]) == [50, 60]
    assert list(runs["time_s"]) == [10] * 2
    # Archard: the volume is k F s.
    worn = 3.11e-16 * runs["load.normal_N"] * runs["distance_m"]
    assert runs["bodies.ball.wear_volume_m3"].to_numpy() == pytest.approx(
        worn.to_numpy(), rel=1e-6, abs=0
    )
    assert {"bodies.ball.scar_across_m", "bodies.ball.mass_kg", "wall_time_s"} <= set(runs)


@pytest.mark.slow
def test_tables_and_lists_that_vary_have_a_column_each_and_warnings_are_in_the_table(tmp_path):
    points = [
        {"contact": "winkler", "grid.size": "0.6 mm", "grid.cells": 12},
        {"contact": "dcfft", "grid.size": ["0.8 mm", "0.9 mm"]},
    ]
    path = sweeps.case(tmp_path)
    with pytest.warns(TriboWarning, match="resolution"):
        rows = sweep(path, points, executor=sweeps.Inline()).as_json()["runs"]
    assert [row["contact.type"] for row in rows] == ["winkler", "dcfft"]
    assert [row["grid.size.2_m"] for row in rows] == [6e-4, 9e-4]
    assert [row["status"] for row in rows] == ["done", "done"]
    assert rows[0]["message"].startswith("resolution: the contact is only")


@pytest.mark.slow
def test_what_is_done_is_not_done_again_and_a_sweep_may_grow(again):
    before = {path: path.stat().st_mtime_ns for path in again.parent.rglob("*.h5")}
    executor = sweeps.Inline()
    grown = sweep(again, {"load.normal": [55, 50, 60]}, executor=executor)
    assert statuses(grown) == ["done"] * 3
    assert executor.calls == [str(grown.runs[0].path)]
    assert {path: path.stat().st_mtime_ns for path in before} == before


FAILING = [
    {"load.normal": "50 N"},
    {"grid.size": "0.2 mm"},
    {"grid.size": "0.21 mm", "stop.distance": "1 m"},
]


@pytest.mark.slow
def test_a_failing_run_is_recorded_and_repeated(tmp_path):
    path = sweeps.case(tmp_path)
    swept = sweep(path, FAILING, executor=sweeps.Inline())
    assert statuses(swept) == ["done", "failed", "failed"]
    (message, *_) = swept.failures()
    assert "grid.size" in message
    table = pandas.read_csv(swept.folder / "runs.csv")
    assert table["message"][1] == message
    assert np.isnan(table["max_pressure_Pa"][1])
    executor = sweeps.Inline()
    pandas.testing.assert_frame_equal(sweep(path, FAILING, executor=executor).table, swept.table)
    assert executor.calls == [str(run.path) for run in swept.runs[1:]]


def test_a_run_whose_worker_dies_fails_and_is_repeated(again):
    # Of another case, so that it has no result yet.
    loads = {"load.normal": [50, 61]}
    executor = sweeps.Inline(sweeps.dies_at(61.0))
    found = sweep(again, loads, executor=executor)
    assert statuses(found) == ["done", "failed"]
    assert "its worker process died" in found.table["message"][1]
    assert executor.calls == [str(found.runs[1].path)]
    assert statuses(sweep(again, loads, executor=sweeps.Inline())) == ["done"] * 2


def test_a_worker_with_a_folder_of_its_own_is_told_of(tmp_path):
    swept = sweep(sweeps.case(tmp_path), sweeps.LOADS, executor=sweeps.Inline(lambda case: ""))
    assert statuses(swept) == ["failed"] * 2
    assert "all workers must share" in swept.table["message"][0]


ENERGY = {
    "bodies.ball.wear": {"type": "energy.dissipation", "alpha": "1e-6 mm^3/J"},
    "effects": ["energy.friction_traction"],
    "friction.coefficient": 0.3,
}


@pytest.mark.slow
def test_a_worker_that_lacks_a_plugin_says_so(tmp_path):
    pytest.importorskip("tribo_energy")
    path = sweeps.case(tmp_path)
    with ProcessPoolExecutor(
        1, mp_context=get_context("spawn"), initializer=sweeps.turn_off_energy
    ) as executor:
        swept = sweep(path, [ENERGY], executor=executor)
    assert statuses(swept) == ["failed"]
    message = swept.table["message"][0]
    assert "cannot compose this case: bodies.ball.wear.type: " in message
    assert "tribo-energy" in message
    assert statuses(sweep(path, [ENERGY], executor=sweeps.Inline())) == ["done"]


@pytest.mark.slow
def test_a_damaged_result_is_done_again(again):
    damaged = plan(again, sweeps.LOADS, again.with_name("my-sweep"))[0][1].path
    content = bytearray(damaged.read_bytes())
    content[len(content) // 2] ^= 1
    damaged.write_bytes(content)
    executor = sweeps.Inline()
    with pytest.warns(TriboWarning, match=f"{damaged.name} is started again: "):
        assert statuses(sweep(again, sweeps.LOADS, executor=executor)) == ["done"] * 2
    assert executor.calls == [str(damaged)]


@pytest.mark.slow
def test_results_of_other_components_are_made_anew(again, monkeypatch):
    monkeypatch.setattr("tribo.result.provenance._code", lambda package: "edited")
    executor = sweeps.Inline()
    with pytest.warns(TriboWarning, match="is started again: .* is done, with other components: "):
        assert statuses(sweep(again, sweeps.LOADS, executor=executor)) == ["done"] * 2
    assert len(executor.calls) == 2


def test_two_sweeps_do_not_share_a_folder(tmp_path):
    path = sweeps.case(tmp_path)
    (tmp_path / "out").mkdir()
    with (
        hold(tmp_path / "out" / "sweep.lock"),
        pytest.raises(CaseError, match=r"another sweep is writing to .*out"),
    ):
        sweep(path, sweeps.LOADS, tmp_path / "out", executor=sweeps.Inline())


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        ([], "nothing varies"),
        ([("load.normal", 50)], "nothing varies"),
        ({"load.normal": 50}, r"load.normal: 50 is no list of values; give \[50\]"),
        ({"load.normal": "50 N"}, r"load.normal: '50 N' is no list"),
    ],
)
def test_a_sweep_of_no_list_is_refused_before_anything_runs(tmp_path, vary, message):
    with pytest.raises(CaseError, match=message):
        sweep(sweeps.case(tmp_path), vary, tmp_path / "out", executor=sweeps.Inline())
    assert not (tmp_path / "out").exists()
