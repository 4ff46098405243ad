"""What nests thousands of levels deep is refused in one line, whichever way it comes."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from tribo import CaseError, Simulation
from tribo.cli.main import tribo
from tribo.templates import template

PATH = ".".join(["a"] * 4000)
TABLES = f"[{PATH}]\nx = 1\n"
DEEP = {
    "tables": "\n" + TABLES,
    "an inline table": f"\n[odd]\nq = {{{PATH} = 1}}\n",
    "lists": "\n[odd]\nq = " + 200 * "[" + 200 * "]",
    "many lists": "\n[odd]\nq = " + 4000 * "[" + 4000 * "]",
}
STUDY = "case = 'case.toml'\n[grid.load]\nnormal = [1, 2]\n"
MEASURED = """
fit = ['bodies.ball.wear.k']
[[measured]]
body = 'ball'
quantity = 'depth'
value = 1
"""


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "case.toml"
    path.write_text(template("ball_on_disk"))
    return path


def refusal(*arguments: str | Path) -> str:
    ended = CliRunner().invoke(tribo, list(map(str, arguments)))
    assert isinstance(ended.exception, CaseError), ended.exception
    return str(ended.exception)


@pytest.mark.parametrize("text", DEEP.values(), ids=DEEP)
def test_a_case_that_nests_too_deeply(case: Path, text: str) -> None:
    case.write_text(case.read_text() + text)
    message = refusal("check", case)
    assert "case.toml: tables or lists are nested too deeply" in message
    assert "\n" not in message


@pytest.mark.parametrize("change", [f"{PATH}=1", f"load.normal={{{PATH}=1}}"])
def test_an_override_that_nests_too_deeply(case: Path, change: str) -> None:
    assert "nested too deeply" in refusal("check", case, "--set", change)


@pytest.mark.parametrize("values", [f"{{{PATH}=1}},{{a=2}}", f"{{{PATH}=1}},a,{{b=,"])
def test_values_to_vary_that_nest_too_deeply(case: Path, values: str) -> None:
    assert "nested too deeply" in refusal("compare", case, "--vary", f"load.normal={values}")


def test_a_study_that_nests_too_deeply(case: Path) -> None:
    study = case.with_name("study.toml")
    study.write_text(STUDY + TABLES)
    assert "study.toml: tables or lists are nested" in refusal("sweep", study)


def test_measured_values_that_nest_too_deeply(case: Path) -> None:
    measured = case.with_name("measured.toml")
    measured.write_text(MEASURED + TABLES)
    message = refusal("calibrate", case, "--measured", measured)
    assert "measured.toml: tables or lists are nested" in message


def test_tables_from_python_that_nest_too_deeply() -> None:
    inside: dict[str, object] = {}
    for _ in range(4000):
        inside = {"a": inside}
    with pytest.raises(CaseError, match="the case: tables or lists are nested too deeply"):
        Simulation(inside)
