"""`tribo sweep`, as a user meets it."""

import json
from contextlib import nullcontext
from pathlib import Path

import pandas
import pytest
import sweeps
from command_line import tribo

from tribo import templates
from tribo.study.sweeping.sweep import plan


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    folder = tmp_path_factory.mktemp("swept")
    sweeps.study(folder)
    return folder, tribo("sweep", "study.toml", "--jobs", 1, cwd=folder)


@pytest.mark.slow
def test_it_ends_with_tables_and_a_folder_of_results(swept):
    folder, (code, out, err) = swept
    assert (code, err.splitlines()[-1]) == (0, "2 of 2 runs")
    table, told = out.split("2 of 2 runs are done.\n")
    assert "normal load (N)" in table
    pictures = ("ball_depth.png", "disk_depth.png")
    wrote = ("runs.csv and study-sweep/saves.csv", *pictures)
    assert told == "".join(f"Wrote study-sweep/{name}\n" for name in wrote)
    runs = pandas.read_csv(folder / "study-sweep" / "runs.csv")
    files = {path.name for path in (folder / "study-sweep" / "results").iterdir()}
    assert files == set(runs["file"])
    left = {path.name for path in (folder / "study-sweep").iterdir()}
    assert left == {"runs.csv", "saves.csv", "results", "sweep.lock", *pictures}


@pytest.mark.slow
def test_json_has_the_rows_of_the_table(swept):
    done = tribo("sweep", "study.toml", "--json", cwd=swept[0])
    assert done.returncode == 0
    data = json.loads(done.stdout)
    assert [run["load.normal_N"] for run in data["runs"]] == [50, 60]
    assert {run["status"] for run in data["runs"]} == {"done"}


@pytest.mark.slow
def test_failed_runs_are_told_by_reason_and_exit_with_3(tmp_path, monkeypatch):
    inline = nullcontext(sweeps.Inline())
    monkeypatch.setattr("tribo.study.sweeping.sweep.processes", lambda jobs: inline)
    sweeps.study(tmp_path, sweeps.QUICK + '[grid]\ngrid.size = ["0.6 mm", "0.2 mm"]')
    code, out, err = tribo("sweep", "study.toml", "-o", "out", "--jobs", 1, cwd=tmp_path)
    assert code == 3
    assert "\n1 of 2 runs are done.\n" in out
    told = "error: 1 of 2 runs failed; --retry runs them again:\n  run 2 (grid.size=0.2 mm): "
    assert told in err
    assert "Traceback" not in err


def test_bad_input_is_one_message(tmp_path):
    sweeps.study(tmp_path)
    code, out, err = tribo("sweep", "study.toml", "--jobs", 0, cwd=tmp_path)
    assert (code, out) == (2, "")
    assert "0 is not in the range x>=1" in err
    assert {path.name for path in tmp_path.iterdir()} == {"case.toml", "study.toml"}


def test_the_template_is_valid():
    runs, paths = plan(Path(templates.__file__).with_name("sweep.toml"), Path("unused"))
    assert len(runs) == 8
    assert paths == ["contact.type", "load.normal", "bodies.ball.wear.k"]
