"""`tribo verify`, as a user meets it."""

import json
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from tribo.cli.main import tribo
from tribo.core.errors import NumericalError
from tribo.templates import template
from tribo.verification import suite
from tribo.verification.suite import cases_in

CASES = Path(suite.__file__).with_name("cases")
SMALL = ["--set", "grid.cells=24", "--set", "grid.size=0.7 mm", "--set", "kinematics.duration=20"]
SMALL += ["--set", "output.save_times=[]"]


def invoke(*args):
    return CliRunner().invoke(tribo, ["verify", *map(str, args)], env={"COLUMNS": "120"})


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "my.toml"
    path.write_text(template("ball_on_disk"))
    return path


def test_json_has_the_environment_and_a_row_for_each_quantity():
    data = json.loads(invoke("westergaard_wave", "--json").stdout)
    assert {"python", "platform", "packages", "holds", "rows"} <= data.keys()
    assert data["holds"] is True
    row = data["rows"][0]
    assert (row["case"], row["quantity"], row["unit"]) == ("westergaard_wave", "max pressure", "Pa")
    assert (row["kind"], row["published"]) == ("closed form", False)
    assert row["got"] == pytest.approx(row["expected"], rel=1e-4)
    assert row["order"] == pytest.approx(row["theory"], abs=0.2)
    assert "Westergaard (1939)" in row["source"]


def test_a_row_that_fails_is_told_in_a_line_and_the_exit_code_is_3(tmp_path):
    folder = shutil.copytree(cases_in(CASES / "archard_k")[0].folder, tmp_path / "mine")
    expected = folder / "expected.toml"
    expected.write_text(expected.read_text().replace("6.22e-07", "6.3e-07"))
    done = invoke(tmp_path, "--json")
    assert isinstance(done.exception, NumericalError)
    assert done.exception.exit_code == 3
    (line,) = str(done.exception).splitlines()
    for part in ("mine", "wear depth of pin", "6.3e-07 m", "6.22e-07", "Archard (1953)"):
        assert part in line
    # The rows are printed all the same.
    assert json.loads(done.stdout)["rows"][0]["verdict"] == "fails"


def test_quick_takes_the_cases_that_say_so():
    rows = json.loads(invoke("archard_k", "--quick", "--json").stdout)["rows"]
    assert [row["case"] for row in rows] == ["archard_k"]
    assert json.loads(invoke("hertz_ball", "--quick", "--json").stdout)["rows"] == []


def test_coverage_fails_where_a_component_is_in_no_case():
    done = invoke(CASES / "archard_k", "--coverage", "--json")
    assert isinstance(done.exception, NumericalError)
    missing = json.loads(done.stdout)["uncovered"]
    assert "dcfft" in missing
    assert not {"archard", "periodic", "flat", "unidirectional"} & set(missing)


def test_a_case_gets_an_uncertainty_for_each_result(case):
    done = invoke(case, *SMALL, "--json")
    assert done.exit_code == 0, done.output
    data = json.loads(done.stdout)
    assert [level["cells"] for level in data["grids"]] == [[10, 10], [16, 16], [24, 24]]
    names = [estimate["name"] for estimate in data["estimates"]]
    assert {"peak pressure", "contact width across", "ball: largest depth", "disk: volume"} <= {
        *names
    }
    for estimate in data["estimates"]:
        assert 0 <= estimate["uncertainty"] < estimate["value"]
