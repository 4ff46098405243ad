"""A value whose unit was forgotten is named where a run fails, and in a check."""

import pytest
from click.testing import CliRunner

from tribo.cli.main import tribo
from tribo.core.errors import CaseError
from tribo.templates import template

FORGOTTEN = {
    "bodies.ball.surface.radius=5": "bodies.ball.surface.radius is 5 m",
    "bodies.ball.material.young=210": "bodies.ball.material.young is 210 Pa",
    "grid.size=2": "grid.size is 2 m",
    "load.normal=1e8": "load.normal is 1e+08 N",
}


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "my.toml"
    path.write_text(template("ball_on_disk"))
    return path


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize("setting", list(FORGOTTEN))
def test_a_failure_names_the_quantity_out_of_its_usual_range(case, command, setting):
    options = ["--set", setting, "--set", "grid.cells=32"]
    failed = CliRunner().invoke(tribo, [command, str(case), *options])
    assert isinstance(failed.exception, CaseError)
    words = str(failed.exception)
    assert words.count("a unit forgotten") == 1
    assert words.startswith(f"{FORGOTTEN[setting]}, usual are ")


def test_a_check_that_finds_nothing_else_still_asks(case):
    coarse = ["--set", "grid.cells=64", "--set", "bodies.ball.material.density=7.85"]
    asked = CliRunner().invoke(tribo, ["check", str(case), *coarse])
    assert asked.exit_code == 0
    verdict, first, *_ = asked.stdout.splitlines()
    assert verdict.endswith("is valid, but:")
    assert first.startswith("  - bodies.ball.material.density is 7.85 kg/m^3, usual are")


@pytest.mark.parametrize("k", ["0", "'1e-6 mm^3/(N m)'"])
def test_what_is_usual_is_not_asked_about(case, k):
    settings = ["--set", f"bodies.ball.wear.k={k}", "--set", "grid.cells=64"]
    asked = CliRunner().invoke(tribo, ["check", str(case), *settings])
    assert "usual are" not in asked.stdout
