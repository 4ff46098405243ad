"""`tribo calibrate`, as a user meets it."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from tribo.cli.calibrate import _data, _estimates, _predictions
from tribo.study.calibration.outcome import Calibration, Datum, Estimate, Expected

EXAMPLES = Path(__file__).parents[2] / "examples"
QUICK = ["--set", "grid.cells=24", "--set", "contact.type=winkler"]


def tribo(*args):
    return subprocess.run(
        [sys.executable, "-m", "tribo", *map(str, args)],
        cwd=EXAMPLES,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


@pytest.fixture(scope="module")
def done():
    ran = tribo("calibrate", "weighed_split.toml", "--measured", "weighed.toml", *QUICK)
    assert ran.returncode == 0, ran.stderr
    return ran


def test_it_prints_estimates_with_intervals_and_what_to_run(done):
    for words in (
        "7.08e-15 1/Pa",
        "7.08e-16 1/Pa",
        "95 % interval",
        "±50 %",
        "ball, crown",
        "balance's resolution dominates",
    ):
        assert words in done.stdout
    last = done.stdout.splitlines()[-1]
    assert last.startswith("Run it: tribo run weighed_split.toml --set grid.cells=24")
    assert last.endswith("--set bodies.ball.wear.k=7.077e-15 --set bodies.disk.wear.k=7.077e-16")


def test_its_tables_break_neither_names_nor_numbers(done):
    lines = done.stdout.splitlines()
    (row,) = (line.split() for line in lines if line.startswith(" bodies.disk.wear.k"))
    assert " ".join(row) == "bodies.disk.wear.k 7.08e-16 1/Pa 4.25e-16 to 9.91e-16 ±40 % ±50 %"
    assert max(len(line) for line in lines if line.startswith(" ")) <= 80


def test_wide_tables_break_no_value_at_80_columns(capsys):
    """Long names are broken between words, intervals around "to"."""
    ball = "bodies.second_ball.wear.factor"
    estimate = Estimate(ball, "1/Pa", 1.234e-15, 1.111e-16, 1.357e-14, 0.5, 1.34, False)
    data = [
        Datum("second_ball", quantity, 3600.0, -0.35e-3, "m", 7.99e-9, 1.11e-9, 9.99e-9, -12.3)
        for quantity in ("profile_along", "profile_across")
    ]
    expected = Expected("second_ball", "scar_across", "m", 1.23e-3, 1.11e-4, 1.46e-2)
    found = Calibration(
        0.95, 5, (estimate,), tuple(data), (expected,), 0.1, 1, np.eye(1), np.ones(1), ()
    )
    console = Console(width=80)
    for table in (_estimates(found), _data(found), _predictions(found)):
        console.print(table)
    lines = [line.rstrip() for line in capsys.readouterr().out.splitlines()]
    assert max(map(len, lines)) <= 80
    text = "\n".join(lines)
    for whole in (ball, "1.23e-15 1/Pa", "1.36e-14", "±134 %", "resolution"):
        assert whole in text
    for whole in ("uncertainty", "0.00799 µm", "0.00111 µm", "profile_across", "-12.3", "residual"):
        assert whole in text
    for whole in ("second_ball, scar_across", "1.23 mm", "0.111 to 14.6 mm"):
        assert whole in text


def test_it_tells_of_each_run_on_stderr(done):
    lines = done.stderr.splitlines()
    assert lines[0].startswith("run 1: misfit χ² ")
    assert all(line.startswith("run ") for line in lines)


def test_json_is_finite_and_in_si_units():
    ran = tribo(
        "calibrate", "weighed_split.toml", "--measured", "weighed.toml", *QUICK, "--json"
    )  # fmt: skip
    data = json.loads(ran.stdout)
    assert {
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
    } == data.keys()
    ball, _ = data["parameters"]
    assert ball["path"] == "bodies.ball.wear.k"
    assert ball["unit"] == "1/Pa"
    assert ball["value"] == pytest.approx(7.08e-15, rel=1e-3, abs=0)


def test_bad_input_is_one_message(tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text('[[measured]]\nbody = "ball"\nquantity = "mass"\nvalue = "2 mm"\n')
    ran = tribo("calibrate", "weighed_split.toml", "--measured", file)
    assert ran.returncode == 2
    assert ran.stderr.startswith("error: measured[0].value: '2 mm' is a length [m]")
    assert len(ran.stderr.splitlines()) == 1
    ran = tribo("calibrate", "weighed_split.toml", "--measured", tmp_path / "none.toml")
    assert ran.returncode == 2
    assert "there is no such file" in ran.stderr
