"""`tribo sweep`, as a user meets it."""

import json
from contextlib import nullcontext

import pandas
import pytest
import sweeps
from command_line import tribo

from tribo.study.sweeping.summary import sweep_pictures, varied_paths

LOADS = ["--vary", "load.normal=50 N,60 N"]


@pytest.fixture
def inline(monkeypatch):
    """Run the cases of a sweep in this process."""
    workers = nullcontext(sweeps.Inline())
    monkeypatch.setattr("tribo.study.sweeping.sweep.processes", lambda jobs: workers)


@pytest.mark.slow
def test_it_ends_with_tables_and_a_folder_of_results(tmp_path):
    folder = sweeps.case(tmp_path).parent
    code, out, err = tribo("sweep", "my.toml", *LOADS, "--jobs", 1, cwd=folder)
    assert (code, err.splitlines()[-1]) == (0, "2 of 2 runs")
    table, told = out.split("2 of 2 runs are done.\n")
    assert "(N)" in table
    pictures = ("ball_depth.png", "disk_depth.png")
    wrote = ("runs.csv", *pictures)
    assert told == "".join(f"Wrote my-sweep/{name}\n" for name in wrote)
    runs = pandas.read_csv(folder / "my-sweep" / "runs.csv")
    files = {path.name for path in (folder / "my-sweep" / "results").iterdir()}
    assert files == set(runs["file"])
    left = {path.name for path in (folder / "my-sweep").iterdir()}
    assert left == {"runs.csv", "results", "sweep.lock", *pictures}
    again = tribo("sweep", "my.toml", *LOADS, "--json", cwd=folder)
    assert again.returncode == 0
    rows = json.loads(again.stdout)["runs"]
    assert [(row["load.normal_N"], row["status"]) for row in rows] == [(50, "done"), (60, "done")]


@pytest.mark.parametrize(
    "vary", ["grid.size=0.6 mm,1.5 mm", "bodies.ball.material.young=207 GPa,2070 GPa"]
)
def test_runs_with_warnings_are_counted(vary, tmp_path, inline):
    sweeps.case(tmp_path)
    out = tribo("sweep", "my.toml", "--vary", vary, cwd=tmp_path).stdout
    told = "\n2 of 2 runs are done, 1 with warnings: see the column message of runs.csv.\n"
    assert told in out
    runs = pandas.read_csv(tmp_path / "my-sweep" / "runs.csv")
    assert runs["message"].isna().tolist() == [True, False]


def test_runs_that_vary_along_both_axes_are_one_curve():
    sizes = {"grid.size.1_m": [1e-3, 2e-3], "grid.size.2_m": [1e-3, 2e-3]}
    runs = pandas.DataFrame({"run": [1, 2], "status": "done", **sizes, "time_s": [1.0, 2.0]})
    assert varied_paths(runs) == [*sizes]
    (draw,) = sweep_pictures(runs, [*sizes], ["time_s"]).values()
    assert len(draw().axes[0].lines) == 1


@pytest.mark.slow
def test_failed_runs_are_told_by_reason_and_exit_with_3(tmp_path, inline):
    sweeps.case(tmp_path)
    vary = ["--vary", "grid.size=0.6 mm,0.2 mm"]
    code, out, err = tribo("sweep", "my.toml", *vary, "-o", "out", "--jobs", 1, cwd=tmp_path)
    assert code == 3
    assert "\n1 of 2 runs are done.\n" in out
    told = "error: 1 of 2 runs failed; the same command repeats them:\n  run 2 (grid.size=0.2 mm): "
    assert told in err
    assert "Traceback" not in err
