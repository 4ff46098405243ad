"""The commands, as a user meets them."""

import json
import re
from pathlib import Path

import pytest
from command_line import tribo

from tribo import load_case
from tribo.cli.commands import OWN
from tribo.core.errors import CaseError
from tribo.packages import COMMANDS, how_to_install
from tribo.templates import TEMPLATES, template

CASE = template("ball_on_disk")


def setting(*settings):
    return [part for each in settings for part in ("--set", each)]


QUICK = setting("grid.cells=32", "grid.size=0.7 mm", "kinematics.duration=60")
QUICK += setting("output.save_times=[0, 20]")
EXPLICIT = setting("stepping.type=explicit", "stepping.time_step=50")
LARGE_STROKE = setting("kinematics.stroke=20 mm", "kinematics.frequency=2.5")


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    assert tribo("new", "ball_on_disk", "my.toml", cwd=folder).returncode == 0
    done = tribo("run", "my.toml", *QUICK, cwd=folder)
    assert done.returncode == 0, done.stderr
    return folder, done


@pytest.fixture
def case(tmp_path, monkeypatch):
    """A case in the current folder."""
    monkeypatch.chdir(tmp_path)
    path = Path("my.toml")
    path.write_text(CASE)
    return path


@pytest.mark.parametrize("name", COMMANDS)
def test_command_not_installed_is_answered_in_one_line(monkeypatch, name):
    package, _ = COMMANDS[name]
    monkeypatch.setattr("tribo.cli.main.offered", dict)
    monkeypatch.setattr("tribo.cli.main.refused", lambda package: [])
    done = tribo(name, "my.toml")
    assert done.returncode == CaseError.exit_code
    assert done.stderr.count("\n") == 1
    assert how_to_install(package) in done.stderr


def test_a_run_ends_with_a_lab_table(ran):
    folder, done = ran
    assert (folder / "my.h5").is_file()
    for words in ("volume, mm³", "mass, mg", "mm³/(N·m)", "scar across, mm", "Hertz", "yield"):
        assert words in done.stdout
    assert "warning" not in done.stderr
    assert not any(line.endswith(" ") for line in done.stdout.splitlines())


def test_show_json_has_the_documented_shape(ran):
    folder, _ = ran
    data = json.loads(tribo("show", "my.h5", "--json", cwd=folder).stdout)
    assert {"case", "provenance", "totals", "saves"} <= data.keys()
    assert {"contact_solves", "solver_iterations", "wall_time_s"} <= data["totals"].keys()
    assert [save["time_s"] for save in data["saves"]] == [0, 20, 60]
    last = data["saves"][-1]
    keys = "distance_m max_pressure_Pa centre_pressure_Pa contact_half_width_x_m approach_m"
    assert {*keys.split(), "contact_half_width_y_m", "contact_area_m2", "force_error"} <= {*last}
    assert last["bodies"].keys() == {"ball", "disk"} == data["lab"]["bodies"].keys()
    worn = "max_wear_depth_m centre_wear_depth_m wear_volume_m3 max_plastic_depth_m"
    assert {*worn.split()} <= {*last["bodies"]["ball"]}
    assert {"mass_kg", "scar_along_m", "scar_across_m"} <= {*data["lab"]["bodies"]["ball"]}
    first = {"hertz_peak_pressure_Pa", "yield_ratio", "load_ratio"}
    assert first <= {*data["lab"]["first_contact"]}


@pytest.mark.parametrize("name", list(TEMPLATES))
def test_a_template_names_the_next_command(tmp_path, name):
    done = tribo("new", name, "my.toml", cwd=tmp_path)
    assert done.returncode == 0
    assert "then: tribo check " in done.stdout
    load_case(tmp_path / "my.toml")


def test_a_template_is_printed_for_a_dash_and_an_unknown_one_is_told_before_the_missing_file(
    tmp_path,
):
    printed = tribo("new", "duty_cycle", "-", cwd=tmp_path)
    assert (printed.returncode, printed.stdout) == (0, template("duty_cycle"))
    assert not list(tmp_path.iterdir())
    unknown = tribo("new", "thirdbody", cwd=tmp_path)
    assert unknown.returncode == 2
    assert "'thirdbody'" in unknown.stderr
    assert "duty_cycle, " in unknown.stderr
    assert tribo("new", "duty_cycle", cwd=tmp_path).returncode == 2


def test_templates_are_listed_where_none_is_named(tmp_path):
    listed = tribo("new", cwd=tmp_path)
    names = {line.split()[0] for line in listed.stdout.splitlines() if line.strip()}
    assert listed.returncode == 0
    assert {*TEMPLATES, "weighed", "thermal.ball_on_disk"} < names


@pytest.mark.parametrize(
    ("changes", "foretold"),
    [
        (["stop.depth=0.5 um"], r"0.5 µm, about reached after [\d.]+ s"),
        (["stop={depth='1 mm', body='disk'}"], r"1000 µm, about not reached, [\d.]+ µm at"),
    ],
)
def test_check_begins_with_its_verdict_and_foretells_the_end(case, changes, foretold):
    done = tribo("check", "my.toml", *LARGE_STROKE, *setting(*changes))
    assert done.stdout.startswith("my.toml is valid.\n")
    assert max(map(len, done.stdout.splitlines())) <= 80
    assert re.search(foretold, " ".join(done.stdout.split()))


def test_check_names_what_would_stop_a_run(case):
    done = tribo("check", "my.toml", *LARGE_STROKE, *setting("grid.size=0.9 mm"), "--json")
    assert done.returncode == 3
    data = json.loads(done.stdout)
    window, *facts = data["findings"]
    assert (window["kind"], data["problems"]) == ("window", [window["words"]])
    assert {each["kind"] for each in facts} == {"sensitivity"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("settings", "code"),
    [
        (setting("grid.size=0.36 mm"), 3),
        (EXPLICIT, 2),
        ([], 0),
    ],
)
def test_check_ends_with_the_exit_code_of_the_run(case, settings, code):
    done = tribo("check", "my.toml", *QUICK, *settings)
    assert done.returncode == tribo("run", "my.toml", *QUICK, *settings).returncode == code
    assert done.stdout.startswith("my.toml is valid") == (code == 0)


@pytest.mark.parametrize("command", ["", *OWN])
def test_every_command_has_help_with_an_example(command):
    done = tribo(*command.split(), "--help")
    assert done.returncode == 0
    assert "Example" in done.stdout


# What is wrong, where it is said to be, and a word of the remedy.
BAD = {
    "unknown key": ("young = ", "yuong = ", "bodies.ball.material.yuong", "young"),
    "window too small": ('["2 mm", "2 mm"]', '"0.2 mm"', "grid.size", "larger"),
    "swept ball": ('swept = "disk"', 'swept = "ball"', "bodies.ball.surface", "kinematics.swept"),
    "save times beyond the end": ("1500, 3600", "1500, 3601", "output.save_times", "end"),
    "not TOML": ("[grid]", "[grid", "line", "TOML"),
}


@pytest.mark.parametrize(("old", "new", "where", "remedy"), BAD.values(), ids=BAD)
def test_bad_input_is_one_line_with_path_and_remedy(case, old, new, where, remedy):
    case.write_text(CASE.replace(old, new, 1), encoding="utf-8")
    done = tribo("run", "my.toml")
    assert (done.returncode, done.stdout) == (2, "")
    first = done.stderr.splitlines()[0]
    assert first.startswith("error: ")
    assert where in first
    assert remedy in first
    assert list(Path().iterdir()) == [case]


def test_the_nearest_command_is_suggested():
    done = tribo("chek")
    assert done.returncode == 2
    assert "did you mean 'check'?" in done.stderr


def test_a_contact_that_outgrows_the_window_exits_with_3_and_keeps_what_was_saved(case):
    settings = [*QUICK, *setting("grid.size=0.36 mm")]
    done = tribo("run", "my.toml", *settings)
    assert done.returncode == 3
    assert "grid.size" in done.stderr
    assert "my.h5 holds what was saved until then" in done.stderr
    assert tribo("show", "my.h5").returncode == 0
    again = tribo("run", "my.toml", *settings)
    assert again.returncode == 2
    assert "tribo resume my.h5" in again.stderr


def test_a_line_contact_is_checked_in_its_own_window_and_is_plain_json(case):
    roller = CASE.replace('"sphere", radius', '"cylinder", radius').replace(
        'size = ["2 mm", "2 mm"]', 'size = "1 mm"\nends_at_window = true'
    )
    case.write_text(roller)
    short = setting("grid.cells=48", "kinematics.duration=20", "output.save_times=[]")
    done = tribo("check", "my.toml", *short, "--json")
    data = json.loads(done.stdout, parse_constant=lambda name: pytest.fail(name))
    assert data["hertz"]["half_width_y"] is None
    # The roller ends where the window does: 1 mm, not the wider one of the estimate.
    assert data["last"]["half_width_y"] == pytest.approx(0.5e-3)


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("run my.toml -o my.toml --force", "the case itself"),
        ("new ball_on_disk my.toml", "--force"),
        ("demo -d .", "--force"),
    ],
)
def test_a_case_is_not_written_over_unasked(case, command, words):
    other = Path("ball_on_disk.toml")
    other.write_text("mine")
    done = tribo(*command.split())
    assert done.returncode == 2
    assert words in done.stderr
    assert (case.read_text(), other.read_text()) == (CASE, "mine")


def test_a_finished_run_is_resumed_without_its_plugin_and_stays_as_it_is(case):
    Path("own.py").write_text(
        "from tribo import Archard\n\n\nclass Mine(Archard):\n    type = 'mine'\n"
    )
    law = setting("bodies.ball.wear={type='mine', k=1e-15}")
    assert tribo("run", "my.toml", *QUICK, *law, "--plugin", "own.py").returncode == 0
    before = Path("my.h5").read_bytes()
    done = tribo("resume", "my.h5")
    assert done.returncode == 0
    assert "my.h5" in done.stdout
    assert Path("my.h5").read_bytes() == before
