"""`tribo verify`, as a user meets it."""

import json

import pytest
from click.testing import CliRunner

from tribo.cli.main import tribo
from tribo.core.errors import CaseError, NumericalError
from tribo.templates import template
from tribo.verification import refinement, suite
from tribo.verification.reference import Reference, Row

SMALL = ["--set", "grid.cells=24", "--set", "grid.size=0.7 mm", "--set", "kinematics.duration=20"]
SMALL += ["--set", "output.save_times=[]"]


def invoke(*args):
    return CliRunner().invoke(tribo, ["verify", *map(str, args)], env={"COLUMNS": "120"})


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "my.toml"
    path.write_text(template("ball_on_disk"))
    return path


@pytest.fixture
def failing(monkeypatch):
    wrong = Row("depth", "m", 1.0, 1.1, 1e-3, note="none")
    made_up = Reference("made up", "nowhere", lambda n, _: [wrong], (8,))
    monkeypatch.setattr(suite, "REFERENCES", (made_up,))


@pytest.fixture
def studied_once(monkeypatch):
    """What makes the study of a case makes it for the first command only."""
    found, refine = [], refinement.refine

    def first(model, tell):
        if not found:
            found.append(refine(model, tell))
        return found[0]

    monkeypatch.setattr(refinement, "refine", first)


def test_the_table_has_every_column_and_a_verdict():
    done = invoke("--only", "full contact, one decay length")
    assert done.exit_code == 0, done.output
    for word in ("quantity", "expected", "got", "error", "order", "verdict"):
        assert word in done.stdout
    assert "tribo.closed_forms.sinusoid" in done.stdout
    assert "0.99 (1)" in done.stdout
    assert "4 hold, 0 fail, 0 need" in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 120


def test_json_has_the_environment_and_a_row_for_each_quantity():
    data = json.loads(invoke("--only", "Westergaard", "--json").stdout)
    assert {"python", "platform", "packages", "holds", "rows"} <= data.keys()
    assert data["holds"] is True
    assert len(data["rows"]) == 3
    row = data["rows"][0]
    assert (row["quantity"], row["unit"], row["theory"]) == ("peak pressure", "Pa", 2.0)
    assert row["got"] == pytest.approx(row["expected"], rel=1e-4)
    assert row["order"] == pytest.approx(2.0, abs=0.2)
    assert "Westergaard (1939)" in row["source"]


@pytest.mark.parametrize("form", [[], ["--json"]])
def test_a_check_that_fails_is_named_and_the_exit_code_3(failing, form):
    done = invoke(*form)
    assert isinstance(done.exception, NumericalError)
    assert done.exception.exit_code == 3
    assert "made up: depth" in str(done.exception)
    # The table is printed all the same.
    assert "made up" in done.stdout
    if form:
        assert json.loads(done.stdout)["rows"][0]["verdict"] == "fails"


def test_no_such_check_says_which_there_are():
    done = invoke("--only", "nonsense")
    assert isinstance(done.exception, CaseError)
    assert "Hertz, circular" in str(done.exception)


def test_a_case_gets_an_uncertainty_for_each_result(case, studied_once):
    done = invoke(case, *SMALL, "--json")
    assert done.exit_code == 0, done.output
    data = json.loads(done.stdout)
    assert [level["cells"] for level in data["grids"]] == [[10, 10], [16, 16], [24, 24]]
    names = [estimate["name"] for estimate in data["estimates"]]
    assert names[:4] == [
        "peak pressure",
        "pressure at the centre",
        "half-width along",
        "half-width across",
    ]
    assert "ball: largest depth" in names
    assert "disk: volume" in names
    for estimate in data["estimates"]:
        assert 0 <= estimate["uncertainty"] < estimate["value"]
    shown = " ".join(invoke(case, *SMALL).stdout.split())
    for word in ("quantity", "±", "GCI %", "10, 16, 24 cells along x", *names[:1]):
        assert word in shown


@pytest.mark.slow
def test_where_values_diverge_nothing_is_quoted(case, studied_once):
    # Only the own cells resolve a peak at which the bodies yield.
    yields = [*SMALL, "--set", "grid.cells=48", "--set", "grid.size=0.6 mm"]
    for body in ("ball", "disk"):
        yields += ["--set", f"bodies.{body}.material.hardness=2.15 GPa"]
    data = json.loads(invoke(case, *yields, "--json").stdout)
    (yielded,) = (e for e in data["estimates"] if e["name"] == "ball: largest plastic depth")
    assert yielded["grid"]["behaviour"] == "diverges"
    assert yielded["grid"]["values"][0] == 0 < yielded["value"]
    assert yielded["uncertainty"] is yielded["grid"]["uncertainty"] is None
    shown = invoke(case, *yields).stdout
    row = next(line for line in shown.splitlines() if line.startswith(" ball: largest plastic"))
    assert row.split()[6:] == ["–", "–", "diverges", "–", "exact"]
    assert "Where values diverge no uncertainty can be quoted" in shown


def test_options_that_do_not_go_together_are_refused(case):
    assert invoke(case, "--only", "Hertz").exit_code == 2
    assert invoke("--set", "grid.cells=8").exit_code == 2
