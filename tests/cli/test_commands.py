"""The commands, as a user meets them."""

import csv
import json
import re
from pathlib import Path

import pytest
from command_line import tribo

from tribo.cli.main import COMMANDS
from tribo.templates import TEMPLATES, template

EXAMPLES = Path(__file__).parents[2] / "examples"
QUICK = ["--set", "grid.cells=32", "--set", "grid.size=0.7 mm", "--set", "kinematics.duration=60"]
QUICK += ["--set", "output.save_times=[0, 20]"]


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


@pytest.mark.slow
def test_a_run_ends_with_a_lab_table(ran):
    folder, done = ran
    assert (folder / "my.h5").is_file()
    for words in ("volume, mm³", "mass, mg", "mm³/(N·m)", "scar across, mm", "Hertz", "yield"):
        assert words in done.stdout
    assert "warning" not in done.stderr


def test_show_json_has_the_documented_shape(ran):
    folder, _ = ran
    shown = tribo("show", "my.h5", "--json", cwd=folder)
    data = json.loads(shown.stdout)
    assert {"case", "provenance", "totals", "saves"} <= data.keys()
    assert {"contact_solves", "solver_iterations", "wall_time_s"} <= data["totals"].keys()
    assert [save["time_s"] for save in data["saves"]] == [0, 20, 60]
    last = data["saves"][-1]
    assert {
        "distance_m",
        "max_pressure_Pa",
        "centre_pressure_Pa",
        "contact_half_width_x_m",
        "contact_half_width_y_m",
        "contact_area_m2",
        "approach_m",
        "force_error",
    } <= last.keys()
    assert last["bodies"].keys() == {"ball", "disk"}
    assert {
        "max_wear_depth_m",
        "centre_wear_depth_m",
        "wear_volume_m3",
        "max_plastic_depth_m",
    } <= last["bodies"]["ball"].keys()
    assert last["bodies"]["ball"]["wear_volume_m3"] == pytest.approx(
        3.11e-16 * 100 * 6, rel=1e-6, abs=0
    )
    assert data["lab"]["bodies"].keys() == {"ball", "disk"}
    ball = data["lab"]["bodies"]["ball"]
    assert ball["specific_wear_rate_mm3_per_Nm"] == pytest.approx(3.11e-7, rel=1e-6, abs=0)
    assert {"mass_kg", "scar_along_m", "scar_across_m"} <= ball.keys()
    first = data["lab"]["first_contact"]
    assert first["max_pressure_Pa"] == data["saves"][0]["max_pressure_Pa"]
    assert {"hertz_peak_pressure_Pa", "yield_ratio"} <= first.keys()


def test_show_prints_the_table_again(ran):
    folder, done = ran
    shown = tribo("show", "my.h5", cwd=folder)
    assert shown.returncode == 0
    table, provenance = shown.stdout.split("\nMade with ")
    assert table in done.stdout
    assert "bodies.ball.wear: archard, tribo.wear.archard.Archard of tribo" in provenance


def test_export_writes_csv_with_units_in_the_column_names(ran):
    folder, _ = ran
    assert tribo("export", "my.h5", "-d", "csv", cwd=folder).returncode == 0
    with (folder / "csv" / "history.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert float(rows[-1]["time_s"]) == 60
    assert "bodies.ball.wear_volume_m3" in rows[0]
    with (folder / "csv" / "profiles_x.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 3 * 32
    assert {"time_s", "x_m", "pressure_Pa", "bodies.ball.wear_depth_m"} <= rows[0].keys()


@pytest.mark.slow
def test_plot_writes_pictures(ran):
    folder, _ = ran
    done = tribo("plot", "my.h5", "-d", "pictures", cwd=folder)
    assert done.returncode == 0, done.stderr
    assert len(list((folder / "pictures").glob("*.png"))) >= 6


def test_schema_is_json(tmp_path):
    data = json.loads(tribo("schema", cwd=tmp_path).stdout)
    assert "bodies" in data["properties"]


@pytest.mark.parametrize("name", list(TEMPLATES))
def test_every_template_is_valid_and_predicted(tmp_path, name):
    assert tribo("new", name, "case.toml", cwd=tmp_path).returncode == 0
    done = tribo("check", "case.toml", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    for words in ("Hertz half-widths", "p0/H", "cells across", "window", "memory", "result file"):
        assert words in done.stdout
    assert "holds it" in done.stdout
    assert ("averages over the stroke" in " ".join(done.stdout.split())) == (name != "pin_on_disk")


def test_check_begins_with_its_verdict(case):
    long = ["--set", "kinematics.stroke=20 mm", "--set", "kinematics.frequency=2.5"]
    done = tribo("check", "my.toml", *long)
    assert done.stdout.startswith("my.toml is valid.\n")
    # As the report of the run words it.
    assert "94 % of the pressure at which the softer body first" in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80
    small = [*long, "--set", "grid.size=0.9 mm", "--set", "grid.cells=64"]
    done = tribo("check", "my.toml", *small)
    assert done.returncode == 3
    assert done.stderr == "error: a run of my.toml would stop on its way\n"
    verdict, first, *_ = done.stdout.splitlines()
    assert verdict == "my.toml is valid, but:"
    assert first.startswith("  - the contact outgrows the window of 0.9 × 0.9 mm")
    data = json.loads(tribo("check", "my.toml", *small, "--json").stdout)
    (problem,) = data["problems"]
    assert problem in " ".join(done.stdout.split())


EXPLICIT = ["stepping.type=explicit", "stepping.time_step=50"]


@pytest.mark.parametrize(
    ("settings", "code"),
    [
        (["grid.size=0.36 mm"], 3),
        (EXPLICIT, 2),
        ([*EXPLICIT, "stepping.allow_unstable=true"], 0),
        ([], 0),
    ],
)
def test_check_ends_with_the_exit_code_of_the_run(case, settings, code):
    options = [*QUICK, *(part for text in settings for part in ("--set", text))]
    done = tribo("check", "my.toml", *options)
    assert done.returncode == tribo("run", "my.toml", *options).returncode == code
    assert done.stdout.startswith("my.toml is valid")


@pytest.mark.slow
def test_check_predicts_what_the_stroke_average_costs_and_the_run_ends_with(case):
    coarse = ["--set", "grid.size=1.3 mm", "--set", "grid.cells=48"]
    (problem,) = json.loads(tribo("check", "my.toml", *coarse, "--json").stdout)["problems"]
    ran = tribo("run", "my.toml", *coarse).stderr.splitlines()
    end = [line for line in ran if "averaging: at 3600 s" in line]
    foreseen, found = (re.search(r"about (\d+) % too deep", text)[1] for text in (problem, *end))
    assert int(foreseen) == pytest.approx(17.7, abs=1.5)
    assert int(found) == pytest.approx(17.7, abs=1.5)


@pytest.mark.parametrize("command", ["check", "run"])
@pytest.mark.slow
def test_a_stroke_under_one_half_width_is_refused_unless_asked_for(case, command):
    short = ["--set", "kinematics.stroke=0.1 mm"]
    done = tribo(command, "my.toml", *short)
    assert done.returncode == 2
    assert "error: kinematics.stroke: 0.1 mm is shorter than the half-width" in done.stderr
    allowed = ["--set", "kinematics.allow_short_stroke=true"]
    assert tribo(command, "my.toml", *short, *allowed).returncode == 0


@pytest.mark.parametrize("name", list(TEMPLATES))
def test_examples_are_the_templates(name):
    assert (EXAMPLES / f"{name}.toml").read_text() == template(name)


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_every_command_has_help_with_an_example(command):
    done = tribo(*command.split(), "--help")
    assert done.returncode == 0
    assert "Example" in done.stdout


CASE = template("ball_on_disk")
BAD = {
    "unknown key": ("young = ", "yuong = ", "bodies.ball.material.yuong", "young"),
    "unknown table": ("[load]", "[laod]", "laod", "load"),
    "unknown type": ('"archard"', '"archrad"', "bodies.ball.wear.type", "archard"),
    "unknown contact": ('"dcfft"', '"dcftt"', "contact.type", "dcfft"),
    "wrong dimension": ('"100 N"', '"100 mm"', "load.normal", "force"),
    "negative modulus": ('"207 GPa"', '"-207 GPa"', "bodies.ball.material.young", "greater"),
    "zero modulus": ('"207 GPa"', "0", "bodies.ball.material.young", "greater"),
    "NaN modulus": ('"207 GPa"', "nan", "bodies.ball.material.young", "finite"),
    "negative radius": ('"5 mm"', '"-5 mm"', "bodies.ball.surface.radius", "greater"),
    "zero load": ('"100 N"', "0", "load.normal", "greater"),
    "negative load": ('"100 N"', '"-1 N"', "load.normal", "greater"),
    "negative stroke": ('stroke = "2 mm"', "stroke = -1", "kinematics.stroke", "greater"),
    "zero stroke": ('stroke = "2 mm"', "stroke = 0", "kinematics.stroke", "greater"),
    "Poisson's ratio of 0.5": (
        "poisson = 0.3",
        "poisson = 0.5",
        "bodies.ball.material.poisson",
        "0.5",
    ),
    "Poisson's ratio of -1": (
        "poisson = 0.3",
        "poisson = -1",
        "bodies.ball.material.poisson",
        "-1",
    ),
    "window too small": ('["2 mm", "2 mm"]', '"0.2 mm"', "grid.size", "larger"),
    "swept ball": ('swept = "disk"', 'swept = "ball"', "bodies.ball.surface", "kinematics.swept"),
    "unknown body": ('swept = "disk"', 'swept = "dsik"', "kinematics.swept", "disk"),
    "save times out of order": ("500, 1500", "1500, 500", "output.save_times", "increase"),
    "save times beyond the end": ("1500, 3600", "1500, 3601", "output.save_times", "end"),
    "not TOML": ("[grid]", "[grid", "line", "TOML"),
}


@pytest.mark.parametrize(
    ("command", "mistake"), [*(("run", mistake) for mistake in BAD), ("check", "unknown key")]
)
def test_bad_input_is_one_line_with_path_and_remedy(case, command, mistake):
    old, new, where, remedy = BAD[mistake]
    assert old in CASE
    case.write_text(CASE.replace(old, new, 1))
    done = tribo(command, "my.toml")
    assert done.returncode == 2
    assert done.stdout == ""
    first = done.stderr.splitlines()[0]
    assert first.startswith("error: ")
    assert where in first
    assert remedy in first
    assert list(Path().iterdir()) == [case]


@pytest.mark.parametrize("option", ["--no-plugin", "--plugins"])
def test_an_option_of_all_commands_stands_before_them(tmp_path, option):
    done = tribo("run", "case.toml", option, "acme", cwd=tmp_path)
    assert done.returncode == 2
    assert f"Error: '{option}' stands before the command." in done.stderr


def test_the_nearest_command_is_suggested():
    done = tribo("chek")
    assert done.returncode == 2
    assert "did you mean 'check'?" in done.stderr


def test_a_wrong_encoding_is_named(case):
    case.write_text(CASE + "# Bäll", encoding="latin-1")
    done = tribo("run", case)
    assert done.returncode == 2
    assert ": not UTF-8" in done.stderr


@pytest.mark.slow
def test_existing_output_needs_force(ran):
    folder, _ = ran
    done = tribo("run", "my.toml", *QUICK, cwd=folder)
    assert done.returncode == 2
    assert "--force" in done.stderr
    assert tribo("run", "my.toml", *QUICK, "--force", cwd=folder).returncode == 0


def test_a_contact_that_outgrows_the_window_exits_with_3(case):
    settings = [*QUICK, "--set", "grid.size=0.36 mm"]
    done = tribo("run", "my.toml", *settings)
    assert done.returncode == 3
    assert "grid.size" in done.stderr
    assert "my.h5 holds what was saved until then" in done.stderr
    assert tribo("show", "my.h5").returncode == 0
    again = tribo("run", "my.toml", *settings)
    assert again.returncode == 2
    assert "tribo resume my.h5" in again.stderr


def test_a_solve_that_does_not_converge_exits_with_3(case):
    settings = [*QUICK, "--set", "contact.max_iterations=2"]
    done = tribo("run", "my.toml", *settings)
    assert done.returncode == 3
    assert "max_iterations" in done.stderr
    assert "residual" in done.stderr


LINE = """
[grid]
size = "1 mm"
cells = 48
ends_at_window = true
[load]
normal = 100
[bodies.roller]
surface = { type = "cylinder", radius = "5 mm" }
wear = { type = "archard", k = 3e-16 }
material = { young = "207 GPa", poisson = 0.3 }
[bodies.disk]
surface = "flat"
material = { young = "207 GPa", poisson = 0.3 }
[kinematics]
type = "reciprocating"
stroke = "2 mm"
frequency = 25
distance = "2 m"
"""


def test_a_line_contact_is_checked_in_its_own_window_and_told_in_plain_json(tmp_path):
    (tmp_path / "line.toml").write_text(LINE)
    told = tribo("check", "line.toml", cwd=tmp_path)
    assert "74.82 µm of a line contact" in told.stdout
    assert "inf" not in told.stdout
    hard = tribo(
        "check", "line.toml", "--set", "bodies.disk.material.hardness='4 GPa'", cwd=tmp_path
    )
    assert "(1.79 H/2.8)" in hard.stdout
    done = tribo("check", "line.toml", "--json", cwd=tmp_path)
    data = json.loads(done.stdout, parse_constant=lambda name: pytest.fail(name))
    assert data["hertz"]["half_width_y"] is None
    # The roller ends where the window does: 1 mm, not the wider one of the estimate.
    assert data["last"]["half_width_y"] == pytest.approx(0.5e-3)


def test_a_run_does_not_write_over_its_own_case(case):
    done = tribo("run", "my.toml", "-o", "my.toml", "--force")
    assert done.returncode == 2
    assert "the case itself" in done.stderr
    assert case.read_text() == CASE


def test_the_demo_does_not_write_over_a_case_unasked(tmp_path):
    (tmp_path / "ball_on_disk.toml").write_text("mine")
    done = tribo("demo", "-d", ".", cwd=tmp_path)
    assert done.returncode == 2
    assert "--force" in done.stderr
    assert (tmp_path / "ball_on_disk.toml").read_text() == "mine"
