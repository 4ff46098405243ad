"""A file that is not what a command takes: one clear message, exit 2, and nothing written."""

import pytest
from click.testing import CliRunner
from made_results import written

from tribo.cli.main import tribo
from tribo.core.errors import CaseError
from tribo.templates import template

CASE = {
    "run": "run {}",
    "check": "check {}",
    "compare": "compare {} --vary grid.cells=16,24",
    "sweep": "sweep {} --vary grid.cells=16,24",
    "calibrate": "calibrate {} --measured measured.toml",
    "measured": "calibrate case.toml --measured {}",
    "verify": "verify {}",
}
RESULT = {name: f"{name} {{}}" for name in ("show", "resume", "plot", "export")}
RESULT["compare"] = "compare result.h5 {}"
MEASURED = '[[measured]]\nbody = "ball"\nquantity = "mass"\nvalue = "1 mg"\nresolution = "0.1 mg"\n'


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("files")
    (path / "case.toml").write_text(template("ball_on_disk"))
    (path / "measured.toml").write_text(MEASURED)
    written(path / "result.h5")
    (path / "empty").touch()
    (path / "binary").write_bytes(bytes(range(128, 256)) * 100)
    (path / "folder").mkdir()
    return path


def told(monkeypatch, folder, command, file):
    monkeypatch.chdir(folder)
    before = sorted(folder.iterdir())
    done = CliRunner().invoke(tribo, command.format(file).split())
    assert isinstance(done.exception, CaseError)
    assert done.exception.exit_code == 2
    assert done.stdout == ""
    assert sorted(folder.iterdir()) == before
    return str(done.exception)


@pytest.mark.parametrize("file", ["none", "folder", "empty", "binary"])
@pytest.mark.parametrize("command", [*CASE.values(), *RESULT.values()])
def test_what_is_no_such_file_is_named_in_one_line(monkeypatch, folder, command, file):
    text = told(monkeypatch, folder, command, file)
    assert text.startswith(file)
    assert "\n" not in text


@pytest.mark.parametrize("command", CASE.values())
def test_a_result_given_for_a_case_is_told(monkeypatch, folder, command):
    text = told(monkeypatch, folder, command, "result.h5")
    assert text.startswith("result.h5 is a result, not ")
    assert text.endswith("; see it with: tribo show result.h5")


@pytest.mark.parametrize("command", [c for n, c in RESULT.items() if n != "compare"])
def test_a_case_given_for_a_result_is_told(monkeypatch, folder, command):
    assert "tribo run case.toml" in told(monkeypatch, folder, command, "case.toml")


@pytest.mark.parametrize("name", ["out.csv", "out.toml"])
def test_a_result_is_not_written_under_the_name_of_another_format(monkeypatch, folder, name):
    assert "name it out.h5" in told(monkeypatch, folder, "run case.toml -o {}", name)
