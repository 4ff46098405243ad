"""The result of a run that is not done: what each command makes of it."""

import shutil
from itertools import product
from pathlib import Path

import pytest
from click.testing import CliRunner
from made_results import quick_reports, written
from paper_models import StopAfter, case, motion

from tribo import CaseError, Grid, Interrupted, Result, Simulation
from tribo.cli.main import tribo
from tribo.observers.observer import Observer
from tribo.result.checkpoint import RunFolder
from tribo.templates import template

GRID = Grid((0.7e-3, 0.7e-3), (24, 24))
READING = {
    "show": "show r.h5",
    "json": "show r.h5 --json",
    "export": "export r.h5 -d out",
    "plot": "plot r.h5 -d out --only pressure_map",
    "report": "report r.h5 -o out.html",
    "compare": "compare r.h5 other.h5 --no-plots",
}
WRITING = {
    "check": "check case.toml --set begin=r.h5",
    "run": "run case.toml -o r.h5",
    "resume": "resume r.h5",
    "force": "run case.toml -o r.h5 --force",
}
BEGINNING = [WRITING[name] for name in ("check", "run", "resume")]
UNSAVED = ("unsaved", "running, unsaved", "alone")
SAVED = ("one save", "running", "killed", "interrupted", "interrupted, alone")


class Copies(Observer):
    """Copies the folder of the run as it is created, and after each save."""

    _count: int = 0

    def on_start(self, run):
        self._copy()

    def on_save(self, snapshot):
        self._copy()

    def _copy(self):
        self._count += 1
        shutil.copytree("work", f"copy{self._count}")


@pytest.fixture(scope="module")
def states(tmp_path_factory):
    folder = tmp_path_factory.mktemp("states")
    written(folder / "other.h5", times=(0.0, 5.0), grid=GRID)
    simulation = Simulation(case(grid=GRID, kinematics=motion(duration=60), save_times=(5, 20)))
    (folder / "work").mkdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        with pytest.raises(Interrupted):
            simulation.run("work/r.h5", observers=[Copies(), StopAfter(steps=13)])
    return folder


@pytest.fixture
def state(states, tmp_path, monkeypatch):
    """Return how to make a state of a result, in this folder."""
    folder = RunFolder(tmp_path / "r.h5")

    def make(name):
        number = {"unsaved": 1, "running, unsaved": 1, "one save": 2}.get(name, 3)
        source = states / ("work" if name.startswith("interrupted") else f"copy{number}")
        shutil.copytree(source, tmp_path, dirs_exist_ok=True)
        shutil.copy(states / "other.h5", tmp_path)
        if name.endswith("alone"):
            shutil.rmtree("r.h5.run")
        (tmp_path / "case.toml").write_text(template("ball_on_disk"))
        if name.startswith("running"):
            folder.lock()

    monkeypatch.chdir(tmp_path)
    yield make
    folder.unlock()


def files():
    return {path: path.is_file() and path.read_bytes() for path in Path().rglob("*")}


def refusal(command):
    before = files()
    error = CliRunner().invoke(tribo, command.split()).exception
    assert isinstance(error, CaseError), repr(error)
    assert files() == before
    return str(error)


@pytest.mark.parametrize(
    ("name", "command"),
    [
        *product(("unsaved",), [*READING.values(), *BEGINNING]),
        *product(UNSAVED[1:], [READING["show"], *BEGINNING]),
    ],
)
def test_of_a_result_without_a_save_it_is_told_where_its_rest_is(state, name, command):
    state(name)
    said = refusal(command)
    if command.startswith("run"):
        assert said.startswith("r.h5 exists; ")
    else:
        assert ("r.h5.run, which is not beside it" in said) == (name == "alone")
        # Elsewhere there may be good checkpoints, which --force would remove.
        assert ("--force" in said) == (name == "unsaved")
        assert ("try again" in said) == (name == "running, unsaved")


@pytest.mark.parametrize("command", [READING["show"], WRITING["resume"]])
def test_a_run_that_left_its_folder_alone_is_started_again(state, command):
    state("unsaved")
    Path("r.h5").unlink()
    assert "'tribo run --force' starts again" in refusal(command)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "command"),
    # Every command reads by one way.
    [
        *product(("one save",), READING.values()),
        *product(SAVED[1:], [READING["show"]]),
    ],
)
def test_a_result_is_read_as_far_as_it_came(state, monkeypatch, name, command):
    quick_reports(monkeypatch)
    state(name)
    done = CliRunner().invoke(tribo, command.split())
    assert done.exit_code == 0, done.exception


@pytest.mark.parametrize("name", SAVED)
def test_no_run_begins_with_a_result_or_upon_it_before_it_is_done(state, name):
    state(name)
    if not name.startswith("interrupted"):
        assert refusal(WRITING["check"]).startswith("begin: ")
    assert "'tribo resume r.h5'" in refusal(WRITING["run"])


@pytest.mark.slow
@pytest.mark.parametrize("name", SAVED)
def test_a_run_is_resumed_where_its_checkpoints_are_and_none_writes(state, name):
    state(name)
    if name in ("running", "interrupted, alone"):
        if name == "running":
            assert Result.open("r.h5").status == "running"
            assert "in use" in refusal(WRITING["force"])
        said = refusal(WRITING["resume"])
        assert ("r.h5.run, which is not beside it" in said) == (name != "running")
        assert "--force" not in said
    else:
        done = CliRunner().invoke(tribo, WRITING["resume"].split())
        assert done.exit_code == 0, done.exception
        with Result.open("r.h5") as result:
            assert result.status == "done"
