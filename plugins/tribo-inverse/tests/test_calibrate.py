"""`tribo calibrate`, as a user meets it."""

import json
import tomllib
from pathlib import Path

import pytest
from click.testing import CliRunner
from command_line import tribo
from tribo.cli.main import tribo as main
from tribo.config.load import load_case
from tribo.core.errors import CaseError

QUICK = ["--set", "grid.cells=24", "--set", "contact.type=winkler"]
COARSE = ["--set", "stepping.depth_tolerance=1e-2", "--set", "stepping.pressure_tolerance=0.3"]
WEIGHED = ["calibrate", "weighed_split.toml", "--measured", "weighed.toml", *QUICK, *COARSE]

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def weighed(tmp_path_factory):
    """Return a folder with the case and the data of the templates."""
    folder = tmp_path_factory.mktemp("weighed")
    for name in ("weighed_split", "weighed"):
        assert tribo("new", name, f"{name}.toml", cwd=folder).returncode == 0
    return folder


@pytest.fixture(scope="module")
def asked(weighed):
    """Return how the command ends with more options, in one process."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(weighed)
        yield lambda *options: CliRunner().invoke(main, [*WEIGHED, *options])


@pytest.fixture(scope="module")
def done(asked):
    ended = asked()
    assert ended.exit_code == 0, ended.output
    return ended


def test_it_prints_estimates_with_intervals_and_what_to_run(done):
    lines = done.stdout.splitlines()
    # Its tables break neither names nor numbers.
    (row,) = (line.split() for line in lines if line.startswith(" bodies.disk.wear.k"))
    assert " ".join(row) == "bodies.disk.wear.k 7.08e-16 1/Pa 4.25e-16 to 9.91e-16 ±40 %"
    assert max(len(line) for line in lines if line.startswith(" ")) <= 80
    for words in ("95 % interval", "relative", "ball, crown"):
        assert words in done.stdout
    assert lines[-1].startswith("Run it: tribo run weighed_split.toml --set grid.cells=24")
    assert lines[-1].endswith(
        "--set bodies.ball.wear.k=7.077e-15 --set bodies.disk.wear.k=7.077e-16"
    )


def test_json_is_finite_and_in_si_units(asked):
    data = json.loads(asked("--json").stdout, parse_constant=pytest.fail)
    keys = "level runs parameters data predictions chi_square degrees_of_freedom p_value notes bic "
    keys += "findings "
    keys += "repeatability repeatability_estimated correlation singular_values fitted"
    assert sorted(data) == sorted(keys.split())
    ball, _ = data["parameters"]
    assert tomllib.loads(data["fitted"])["bodies"]["ball"]["wear"]["k"] == pytest.approx(
        ball["value"], rel=1e-6, abs=0
    )
    estimate = "path unit value lower upper held"
    assert list(ball) == estimate.split()
    assert (ball["path"], ball["unit"]) == ("bodies.ball.wear.k", "1/Pa")
    assert ball["value"] == pytest.approx(7.08e-15, rel=1e-3, abs=0)
    datum = "test body quantity time_s place unit"
    datum += " measured sigma computed residual"
    assert list(data["data"][0]) == datum.split()
    predicted = "test body quantity unit value lower upper"
    assert list(data["predictions"][0]) == predicted.split()


def test_the_fitted_case_is_written_to_run(asked, tmp_path):
    ran = asked("-o", str(tmp_path / "fitted.toml"))
    assert (tmp_path / "fitted-fit.png").stat().st_size > 5000
    assert ran.stdout.splitlines()[-1] == f"Run it: tribo run {tmp_path / 'fitted.toml'}"
    case = load_case(tmp_path / "fitted.toml")
    assert case.bodies["disk"].wear.k == pytest.approx(7.077e-16, rel=1e-3, abs=0)
    assert case.grid.cells == (24, 24)
    again = asked("-o", str(tmp_path / "fitted.toml"))
    assert isinstance(again.exception, CaseError)
    assert "fitted.toml exists; choose another name" in str(again.exception)
    assert "run 1" not in again.stderr


def test_bad_input_is_one_message(tmp_path, weighed):
    file = tmp_path / "wrong.toml"
    file.write_text('[[measured]]\nbody = "ball"\nquantity = "mass"\nvalue = "2 mm"\n')
    ran = tribo("calibrate", "weighed_split.toml", "--measured", file, cwd=weighed)
    assert ran.returncode == 2
    assert ran.stderr.startswith("error: measured.1.value: '2 mm' is a length [m]")
    assert len(ran.stderr.splitlines()) == 1


@pytest.mark.parametrize("more", [["--plan", "0.1"], ["twin.toml"]])
def test_local_coefficients_are_one_case_and_no_plan(tmp_path, monkeypatch, weighed, more):
    monkeypatch.chdir(tmp_path)
    entry = {"body": '"disk"', "depth": '"d.npy"', "uncertainty": "1e-9", "length": "1e-4"}
    table = "\n".join(f"{key} = {value}" for key, value in entry.items())
    Path("mapped.toml").write_text(f"[[map]]\n{table}\n")
    for name in ("case.toml", "twin.toml"):
        Path(name).write_text((weighed / "weighed_split.toml").read_text())
    ended = CliRunner().invoke(main, ["calibrate", "case.toml", "--measured", "mapped.toml", *more])
    assert str(ended.exception) == (
        "local coefficients, [[map]], are fitted in one case, without --plan"
    )
