"""Plugins add rows, pictures, formats and templates; several at once."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner
from fake_distributions import distribute, observer

from tribo.cli.main import tribo
from tribo.registry.registry import default_registry
from tribo.templates import template

HOOKS = """
from matplotlib.figure import Figure
from tribo import CaseTemplate, ExportFormat, LabRow

def write(result, folder):
    folder.mkdir()
    (folder / "loads.txt").write_text(str(result.system.load))
    return [folder / "loads.txt"]

@hookimpl
def tribo_lab_rows(result):
    return [LabRow("path of {0}", float(result.distances[-1]), "m")]

@hookimpl
def tribo_figures(result):
    return {{"{0}_picture": Figure}}

@hookimpl
def tribo_export_formats():
    return [ExportFormat("{0}.txt", "the load", write)]

@hookimpl
def tribo_templates():
    return [CaseTemplate("{0}.case", "a case", "# of {0}")]
"""


@pytest.fixture(autouse=True)
def own_registry(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Two plugins that add everything; nothing else is installed."""
    for name in ("adds_a", "adds_b"):
        code = observer(f"{name}.calm") + HOOKS.format(name)
        distribute(folder, name, "1.0", {f"{name}.calm": name}, **{name: code})
    monkeypatch.setenv("TRIBO_PLUGINS", "adds_a,adds_b")
    monkeypatch.chdir(folder)
    default_registry.cache_clear()
    yield
    default_registry.cache_clear()
    for name in ("adds_a", "adds_b", "adds_c"):
        sys.modules.pop(name, None)


def run(*observers: str) -> Path:
    case = Path("case.toml")
    case.write_text(f"observers = {json.dumps(observers)}\n{template('ball_on_disk')}")
    path = Path("case.h5")
    changes = (
        "grid.cells=32",
        "grid.size=0.7 mm",
        "kinematics.duration=0.1",
        "output.save_times=[]",
    )
    options = [word for change in changes for word in ("--set", change)]
    done = CliRunner().invoke(tribo, ["run", str(case), *options])
    assert done.exit_code == 0, done.output
    return path


def told(*args: str) -> str:
    done = CliRunner().invoke(tribo, args, catch_exceptions=False)
    assert done.exit_code == 0, done.output
    return done.output


def test_the_plugins_of_a_case_add_rows_and_pictures() -> None:
    path = run("adds_b.calm", "adds_a.calm")
    shown = told("show", str(path))
    assert "path of adds_a: 0.01 m" in shown
    assert "path of adds_b: 0.01 m" in shown
    rows = json.loads(told("show", str(path), "--json"))["lab"]["plugins"]
    assert {row["label"] for row in rows} == {"path of adds_a", "path of adds_b"}
    drawn = told("plot", str(path))
    assert "adds_a_picture.png" in drawn
    assert "adds_b_picture.png" in drawn


def test_a_plugin_that_the_case_does_not_name_adds_nothing() -> None:
    assert "path of" not in told("show", str(run("adds_a.calm"))).replace("path of adds_a", "")


def test_a_result_is_shown_where_its_plugin_is_gone(monkeypatch: pytest.MonkeyPatch) -> None:
    path = run("adds_a.calm")
    monkeypatch.setenv("TRIBO_DISABLE_PLUGINS", "*")
    default_registry.cache_clear()
    assert "path of" not in told("show", str(path))


def test_formats_and_templates_come_from_every_plugin() -> None:
    path = run()
    assert "loads.txt" in told("export", str(path), "--format", "adds_b.txt")
    assert Path("case-adds_b.txt/loads.txt").read_text() == "100.0"
    told("new", "adds_a.case", "new.toml")
    assert Path("new.toml").read_text() == "# of adds_a"


def test_an_unknown_format_or_template_lists_what_there_is() -> None:
    for args, name in (
        (("export", "x.h5", "--format", "adds_b.tx"), "adds_b.txt"),
        (("new", "adds_b.cas", "new.toml"), "adds_b.case"),
    ):
        done = CliRunner().invoke(tribo, args)
        assert f"did you mean '{name}'?" in str(done.exception)
        assert name.replace("adds_b", "adds_a") in str(done.exception)


def test_a_broken_plugin_is_left_out_of_the_formats(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    distribute(folder, "adds_c", "1.0", {"adds_c.calm": "adds_c"}, adds_c="1/0")
    monkeypatch.setenv("TRIBO_PLUGINS", "adds_a,adds_c")
    default_registry.cache_clear()
    with pytest.warns(match="adds_c 1.0 is left out: ZeroDivisionError"):
        told("new", "adds_a.case", "new.toml")


def test_a_hook_that_raises_is_named_by_file_and_line(folder: Path) -> None:
    file = folder / "adds_b.py"
    file.write_text(file.read_text().replace("return [CaseT", "1 / 0; return [CaseT"))
    done = CliRunner().invoke(tribo, ["new", "adds_a.case", "new.toml"])
    assert f"tribo_templates raised ZeroDivisionError: division by zero ({file}, line " in str(
        done.exception
    )
