"""What nests thousands of levels deep is refused in one line, whichever way it comes."""

import pytest
from command_line import tribo

from tribo import CaseError, Simulation
from tribo.templates import template

PATH = ".".join(["a"] * 4000)


@pytest.mark.parametrize("words", [("check",), ("check", "--set"), ("sweep", "--vary")])
def test_what_nests_too_deeply_is_refused_by_every_command(tmp_path, words):
    command, *option = words
    tables = "" if option else f"\n[{PATH}]\nx = 1\n"
    (tmp_path / "case.toml").write_text(template("ball_on_disk") + tables)
    given = [*option, f"{PATH}=1,2"] if option else []
    done = tribo(command, "case.toml", *given, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("error: ")
    assert "internal" not in done.stderr


def test_tables_from_python_that_nest_too_deeply():
    inside = {}
    for _ in range(4000):
        inside = {"a": inside}
    with pytest.raises(CaseError):
        Simulation(inside)
