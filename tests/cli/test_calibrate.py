"""`tribo calibrate`, as a user meets it."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from command_line import tribo
from rich.console import Console

from tribo.cli.calibrate import _data, _estimates, _predictions
from tribo.study.calibration.outcome import Calibration

EXAMPLES = Path(__file__).parents[2] / "examples"
QUICK = ["--set", "grid.cells=24", "--set", "contact.type=winkler"]
WEIGHED = ["calibrate", "weighed_split.toml", "--measured", "weighed.toml", *QUICK]

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def done():
    ran = tribo(*WEIGHED, cwd=EXAMPLES)
    assert ran.returncode == 0, ran.stderr
    return ran


def test_it_prints_estimates_with_intervals_and_what_to_run(done):
    lines = done.stdout.splitlines()
    # Its tables break neither names nor numbers.
    (row,) = (line.split() for line in lines if line.startswith(" bodies.disk.wear.k"))
    assert " ".join(row) == "bodies.disk.wear.k 7.08e-16 1/Pa 4.25e-16 to 9.91e-16 ±40 % ±50 %"
    assert max(len(line) for line in lines if line.startswith(" ")) <= 80
    for words in ("95 % interval", "ball, crown", "balance's resolution dominates"):
        assert words in done.stdout
    assert lines[-1].startswith("Run it: tribo run weighed_split.toml --set grid.cells=24")
    assert lines[-1].endswith(
        "--set bodies.ball.wear.k=7.077e-15 --set bodies.disk.wear.k=7.077e-16"
    )


def test_it_tells_of_each_run_on_stderr(done):
    assert [line.split(":")[0] for line in done.stderr.splitlines()[:2]] == ["run 1", "run 2"]


def test_wide_tables_break_no_value_at_80_columns(capsys):
    """Long names are broken between words, intervals around "to"."""
    ball, value = "bodies.second_ball.wear.factor", {"value": 1.234e-15, "lower": 1.111e-16}
    estimate = {"path": ball, "unit": "1/Pa", **value, "upper": 1.357e-14}
    estimate |= {"resolution_share": 0.5, "resolution_limit": 1.34, "held": False}
    datum = {"body": "second_ball", "time_s": 3600.0, "position_m": -0.35e-3, "unit": "m"}
    datum |= {"measured": 7.99e-9, "sigma": 1.11e-9, "computed": 9.99e-9, "residual": -12.3}
    expected = {"body": "second_ball", "quantity": "scar_across", "unit": "m", "value": 1.23e-3}
    expected |= {"lower": 1.11e-4, "upper": 1.46e-2}
    found = Calibration(
        0.95,
        5,
        pd.DataFrame([estimate]),
        pd.DataFrame([{**datum, "quantity": f"profile_{way}"} for way in ("along", "across")]),
        pd.DataFrame([expected]),
        0.1,
        1,
        np.eye(1),
        np.ones(1),
        (),
    )
    console = Console(width=80)
    for table in (_estimates(found), _data(found), _predictions(found)):
        console.print(table)
    lines = [line.rstrip() for line in capsys.readouterr().out.splitlines()]
    assert max(map(len, lines)) <= 80
    for whole in (ball, "1.23e-15 1/Pa", "1.36e-14", "±134 %", "resolution", "uncertainty"):
        assert any(whole in line for line in lines)
    for whole in ("0.00799 µm", "0.00111 µm", "profile_across", "-12.3", "residual"):
        assert any(whole in line for line in lines)
    for whole in ("second_ball, scar_across", "1.23 mm", "0.111 to 14.6 mm"):
        assert any(whole in line for line in lines)


def test_json_is_finite_and_in_si_units():
    data = json.loads(tribo(*WEIGHED, "--json", cwd=EXAMPLES).stdout, parse_constant=pytest.fail)
    assert list(data) == [
        "level",
        "runs",
        "parameters",
        "data",
        "predictions",
        "chi_square",
        "degrees_of_freedom",
        "p_value",
        "correlation",
        "singular_values",
        "notes",
    ]
    ball, _ = data["parameters"]
    assert list(ball) == [
        "path",
        "unit",
        "value",
        "lower",
        "upper",
        "resolution_share",
        "resolution_limit",
        "held",
    ]
    assert (ball["path"], ball["unit"]) == ("bodies.ball.wear.k", "1/Pa")
    assert ball["value"] == pytest.approx(7.08e-15, rel=1e-3, abs=0)
    datum = "body quantity time_s position_m unit measured sigma computed residual"
    assert list(data["data"][0]) == datum.split()
    assert list(data["predictions"][0]) == ["body", "quantity", "unit", "value", "lower", "upper"]


def test_bad_input_is_one_message(tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text('[[measured]]\nbody = "ball"\nquantity = "mass"\nvalue = "2 mm"\n')
    ran = tribo("calibrate", "weighed_split.toml", "--measured", file, cwd=EXAMPLES)
    assert ran.returncode == 2
    assert ran.stderr.startswith("error: measured[0].value: '2 mm' is a length [m]")
    assert len(ran.stderr.splitlines()) == 1
