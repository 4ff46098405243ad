"""A value whose unit was forgotten is named where a run fails, and in a check."""

import pytest
from command_line import tribo

FORGOTTEN = {
    "bodies.ball.surface.radius=5": "bodies.ball.surface.radius is 5 m",
    "bodies.ball.material.young=210": "bodies.ball.material.young is 210 Pa",
    "grid.size=2": "grid.size is 2 m",
    "load.normal=1e8": "load.normal is 1e+08 N",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("usual")
    assert tribo("new", "ball_on_disk", "my.toml", cwd=folder).returncode == 0
    return folder


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize("setting", list(FORGOTTEN))
def test_a_failure_names_the_quantity_out_of_its_usual_range(folder, command, setting):
    options = ["--set", setting, "--set", "grid.cells=32", *(["--force"] * (command == "run"))]
    failed = tribo(command, "my.toml", *options, cwd=folder)
    assert failed.returncode == 2
    assert failed.stderr.count("a unit forgotten") == 1
    assert failed.stderr.startswith(f"error: {FORGOTTEN[setting]}, usual are ")


def test_a_check_that_finds_nothing_else_still_asks(folder):
    coarse = ["--set", "grid.cells=64", "--set", "bodies.ball.material.density=7.85"]
    asked = tribo("check", "my.toml", *coarse, cwd=folder)
    assert asked.returncode == 0
    verdict, first, *_ = asked.stdout.splitlines()
    assert verdict.endswith("is valid, but:")
    assert first.startswith("  - bodies.ball.material.density is 7.85 kg/m^3, usual are")


@pytest.mark.parametrize("k", ["0", "'1e-6 mm^3/(N m)'"])
def test_what_is_usual_is_not_asked_about(folder, k):
    settings = ["--set", f"bodies.ball.wear.k={k}", "--set", "grid.cells=64"]
    assert "usual are" not in tribo("check", "my.toml", *settings, cwd=folder).stdout
