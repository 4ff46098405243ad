"""What nests thousands of levels deep is refused in one line, whichever way it comes."""

import pytest
from command_line import tribo

from tribo import CaseError, Simulation
from tribo.templates import template

PATH = ".".join(["a"] * 4000)
TABLES = f"\n[{PATH}]\nx = 1\n"
CASE = template("ball_on_disk")
FILES = {
    "case.toml": CASE,
    "tables.toml": CASE + TABLES,
}
COMMANDS = {
    "tables": "check tables.toml",
    "path": f"check case.toml --set {PATH}=1",
    "axis": f"sweep case.toml --vary {PATH}=1,2",
}


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_what_nests_too_deeply_is_refused_by_every_command(tmp_path, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    done = tribo(*command.split())
    assert done.returncode == 2
    assert done.stderr.startswith("error: ")
    assert "internal" not in done.stderr


def test_tables_from_python_that_nest_too_deeply():
    inside = {}
    for _ in range(4000):
        inside = {"a": inside}
    with pytest.raises(CaseError):
        Simulation(inside)
