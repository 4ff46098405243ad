"""The reports of a sweep and of a calibration."""

import json
import re
import tomllib

import pandas as pd
import pytest
import tribo
from command_line import tribo as command
from made_results import written
from pages import Checked
from tribo.config.overrides import apply_settings
from tribo.templates import template

import tribo_report

CHEAP = {
    "grid": {"size": "1 mm", "cells": 16},
    "contact": {"type": "winkler"},
    "kinematics.duration": 100,
    "output": {},
}


@pytest.fixture(scope="module")
def fit():
    """What `tribo calibrate --json` prints of the masses of two bodies, known to 2 %."""
    inverse = pytest.importorskip("tribo_inverse")
    lost = {"quantity": "mass", "value": 3.11e-16 * 100 * 10 * 7850, "uncertainty": "2 %"}
    bodies = ("ball", "disk")
    data = {"measured": [{"body": body, **lost} for body in bodies]}
    data["fit"] = [{"path": f"bodies.{body}.wear.k"} for body in bodies]
    case = apply_settings(tomllib.loads(template("ball_on_disk")), CHEAP)
    return inverse.calibrate(case, data).as_json()


def answers(path):
    page = path.read_text(encoding="utf-8")
    Checked(page)
    return re.findall('<p class="answer">(.*?)</p>', page, re.S)


def test_a_sweep_tells_the_least_and_the_most_wear(tmp_path):
    folder = tmp_path / "study-sweep"
    (folder / "results").mkdir(parents=True)
    rows = []
    for run, (load, motion) in enumerate([(50.0, "a"), (100.0, "a"), (50.0, "b")], start=1):
        written(folder / "results" / f"{run}.h5", times=(0.0, 100.0 * run))
        with tribo.open(folder / "results" / f"{run}.h5") as result:
            saves = {name: values[-1] for name, values in result.table("saves").items()}
        varied = {"load.normal_N": load, "kinematics.type": motion}
        rows.append({"run": run, "status": "done", **varied, **saves, "file": f"{run}.h5"})
    rows.append({"run": 4, "status": "failed", "message": "too steep"})
    pd.DataFrame(rows).to_csv(folder / "runs.csv", index=False)
    done = command("report", "study-sweep", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    count, ball, _ = answers(tmp_path / "study-sweep-report.html")
    assert count == "3 of 4 runs are done."
    volumes = [f"{1e9 * row['bodies.ball.wear_volume_m3']:.3g}" for row in (rows[0], rows[2])]
    assert f"The ball lost {volumes[0]} mm³" in ball
    assert f"to {volumes[1]} mm³" in ball
    assert "(run 3: normal load 50 N, kinematics type b)" in ball
    assert "run 4: too steep" in (tmp_path / "study-sweep-report.html").read_text()
    # Where no run has a message, the column is read as numbers.
    pd.DataFrame(rows[:3]).assign(message=None).to_csv(folder / "runs.csv", index=False)
    assert command("report", "study-sweep", cwd=tmp_path).returncode == 0


def test_a_sweep_without_a_run_that_is_done_has_no_report(tmp_path):
    (tmp_path / "runs.csv").write_text("run,status,time_s,file,message\n1,failed,,1.h5,too steep\n")
    with pytest.raises(tribo.CaseError, match=r"no run of .* is done"):
        tribo_report.write_report(tmp_path, tmp_path / "report.html")


def test_a_calibration_tells_its_estimates_and_first_what_contradicts_them(tmp_path, fit):
    ball, disk = fit["parameters"]
    told = fit | {"parameters": [ball, disk | {"upper": None}]}
    told |= {"chi_square": 402.0, "degrees_of_freedom": 1}
    (tmp_path / "fit.json").write_text(json.dumps(told))
    done = command("report", "fit.json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    wrong, first, second = answers(tmp_path / "fit-report.html")
    assert "p &lt; 1e-6" in wrong
    assert first == (
        "bodies.ball.wear.k is 3.11e-16 1/Pa, between 2.99e-16 and 3.23e-16 with a probability "
        "of 95 %."
    )
    assert second.endswith("the data do not bound it.")
    page = (tmp_path / "fit-report.html").read_text(encoding="utf-8")
    assert "sphere, radius 5 mm" in page
    # Nothing to draw: Plotly is left out.
    assert len(page) < 200_000


def test_another_json_file_is_refused(tmp_path):
    pytest.importorskip("tribo_inverse")
    (tmp_path / "other.json").write_text("{}")
    with pytest.raises(tribo.CaseError, match="is not what 'tribo calibrate --json' prints"):
        tribo_report.write_report(tmp_path / "other.json", tmp_path / "report.html")
    with pytest.raises(tribo.CaseError, match=r"^.*none\.json: there is no such file$"):
        tribo_report.write_report(tmp_path / "none.json", tmp_path / "report.html")
