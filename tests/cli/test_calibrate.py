"""`tribo calibrate`, as a user meets it."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

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
    assert ball["value"] == pytest.approx(7.08e-15, rel=1e-3)


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
