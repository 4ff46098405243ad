"""Commands with plugins installed: sound, broken, deadly or turned off."""

import json

import pytest
from fake_distributions import LAW, OBSERVER, SHORT, distribute

from tribo import Result
from tribo.registry import child
from tribo.templates import template

GOOD = LAW.format(name="odd.one")
CASE = template("ball_on_disk")


def install(folder, distribution="odd", code=GOOD, name="odd.one"):
    module = distribution.replace("-", "_")
    distribute(folder, distribution, "1.0", {name: module}, **{module: code})


def cases(folder):
    (folder / "plain.toml").write_text(CASE)
    named = CASE.replace('{ type = "archard", k = "3.11e-16 1/Pa" }', '"odd.one"', 1)
    assert named != CASE
    (folder / "named.toml").write_text(named)


FORMAT = """
from tribo import ExportFormat, hookimpl
@hookimpl
def tribo_export_formats():
    return [ExportFormat("calm", "Nothing.", lambda result, folder: [])]
"""


@pytest.mark.slow
def test_a_plugin_that_breaks_or_crashes_is_named_and_ends_no_command(folder, asked, monkeypatch):
    monkeypatch.setenv("TRIBO_PLUGINS", "odd,deadly,calm")
    cases(folder)
    install(folder, code="raise SystemExit(0)")
    install(folder, "deadly", "import os; os.abort()", name="odd.deadly")
    distribute(folder, "calm", "1.0", {"calm": "calm"}, **{"calm": FORMAT})
    plain = asked("run", "plain.toml", *SHORT)
    assert (plain.returncode, plain.stderr.count("odd")) == (0, 0)
    named = asked("run", "named.toml")
    assert named.returncode == 2
    (line,) = named.stderr.splitlines()
    assert line.startswith("error: bodies.ball.wear: wear law 'odd.one' cannot be used: odd")
    done = asked("export", "plain.h5", "--format", "calm")
    assert done.returncode == 0, done.stderr
    warned = [line for line in done.stderr.splitlines() if "left out" in line]
    assert sorted(line.split()[1] for line in warned) == ["deadly", "odd"]
    assert asked("plugins", "list").returncode == 0


@pytest.mark.slow
def test_the_doctor_names_every_fault_and_none_hurts_a_list_or_a_check(folder, asked, monkeypatch):
    monkeypatch.setenv("TRIBO_PLUGINS", "endless,left,right")
    install(folder, "endless", "while True: pass", name="odd.endless")
    install(folder, "left", name="odd.both")
    install(folder, "right", name="odd.both")
    conflict = "broken: another package offers 'odd.both' too"
    listed = asked("plugins", "list", "--json")
    statuses = {row["name"]: row["status"] for row in json.loads(listed.stdout)}
    assert statuses["odd.endless"] == "available"
    with monkeypatch.context() as patient:
        patient.setattr(child, "TIMES", 0.5)
        checked = asked("plugins", "check", "odd.endless")
    assert checked.returncode == 2
    assert "endless 1.0, which is broken: its import did not end within 0.5 times" in checked.stderr
    for verb in ("show", "check"):
        done = asked("plugins", verb, "odd.both")
        assert done.returncode == 2
        assert conflict in done.stderr
    (folder / "endless.py").write_text("import os; os.abort()")
    doctor = asked("doctor")
    assert doctor.returncode == 3
    assert "broken: its import crashed the process (SIGABRT)" in doctor.stdout
    assert conflict in doctor.stdout


@pytest.mark.slow
def test_malformed_distributions_harm_no_other(folder, asked):
    cases(folder)
    install(folder)
    faults = {
        "equals": "[console_scripts]\nno equals sign\n",
        "nameless": "[tribo.2]\nmalformed.law = malformed\n",
        "odd_value": "[console_scripts]\nmalformed = not a module !!\n",
    }
    for name, lines in faults.items():
        info = folder / f"{name}-1.0.dist-info"
        info.mkdir()
        (info / "entry_points.txt").write_text(lines)
        if name != "nameless":
            (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    assert asked("plugins", "list").returncode == 0
    done = asked("run", "named.toml", *SHORT)
    assert done.returncode == 0, done.stderr
    with Result.open(folder / "named.h5") as result:
        made = result.provenance["components"]["bodies.ball.wear"]
        plugins = {(p["distribution"], p["status"]) for p in result.provenance["plugins"]}
    assert (made["distribution"], made["version"]) == ("odd", "1.0")
    assert ("odd", "loaded") in plugins


@pytest.mark.slow
def test_what_needs_a_file_is_not_checked(folder, asked):
    line = '    type = "odd.one"'
    code = OBSERVER.format(name="odd.one", title="Odd").replace(line, f"    path: Path\n{line}")
    install(folder, "reader", f"from pathlib import Path\n{code}")
    done = asked("plugins", "check", "odd.one")
    assert done.returncode == 0, done.stderr
    assert "odd.one: not checked, for want of a file as its path" in done.stdout
