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


@pytest.mark.parametrize(
    "command",
    [
        f"check {{case}} --set {PATH}=1",
        f"check {{case}} --set load.normal={{{{{PATH}=1}}}}",
        f"compare {{case}} --vary load.normal={{{{{PATH}=1}}}},{{{{a=2}}}}",
        f"compare {{case}} --vary load.normal={{{{{PATH}=1}}}},a,{{{{b=,",
        "sweep {study}",
        "calibrate {case} --measured {measured}",
    ],
    ids=["path", "value", "values", "half a value", "study", "measured"],
)
def test_what_nests_too_deeply_is_refused_by_every_command(case: Path, command: str) -> None:
    study, measured = case.with_name("study.toml"), case.with_name("measured.toml")
    study.write_text(STUDY + TABLES)
    measured.write_text(MEASURED + TABLES)
    message = refusal(*command.format(case=case, study=study, measured=measured).split())
    assert "nested too deeply" in message


def test_tables_from_python_that_nest_too_deeply() -> None:
    inside: dict[str, object] = {}
    for _ in range(4000):
        inside = {"a": inside}
    with pytest.raises(CaseError, match="the case: tables or lists are nested too deeply"):
        Simulation(inside)
