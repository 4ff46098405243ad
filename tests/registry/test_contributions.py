"""Plugins add rows, pictures, formats, templates and cases; several at once."""

import json
import os
from pathlib import Path

import pytest
from command_line import tribo
from fake_distributions import SHORT, distribute, observer

from tribo import Result
from tribo.plotting.figures import result_pictures, write_figures
from tribo.registry.registry import default_registry
from tribo.templates import template

HOOKS = """
from matplotlib.figure import Figure
from pathlib import Path
from tribo import CaseTemplate, Column, ExportFormat

def write(result, folder):
    folder.mkdir()
    (folder / "loads.txt").write_text(str(result.system.load))
    return [folder / "loads.txt"]

@hookimpl
def tribo_quantities():
    read = lambda result: result.distances[-1]
    return [Column("path_of_{0}", "m", "path of {0}", read)]

@hookimpl
def tribo_figures(result):
    return {{"{0}_picture": Figure}}

@hookimpl
def tribo_export_formats():
    return [ExportFormat("{0}.txt", "the load", write)]

@hookimpl
def tribo_templates():
    return [CaseTemplate("{0}.case", "a case", "# of {0}")]

@hookimpl
def tribo_cases():
    return [Path("{0}_cases")]
"""


@pytest.fixture(autouse=True)
def installed(folder, monkeypatch):
    """Three plugins that add everything, and one of hooks alone; nothing else is installed."""
    for name in ("adds_a", "adds_b", "adds_c"):
        code = observer(f"{name}.calm") + HOOKS.format(name)
        distribute(folder, name, "1.0", {f"{name}.calm": name}, **{name: code})
    alone = "from tribo import hookimpl\n" + HOOKS.format("alone")
    distribute(folder, "adds-alone", "1.0", {"adds-alone": "adds_alone"}, adds_alone=alone)
    os.environ["TRIBO_PLUGINS"] = "adds_a,adds_b,adds_c,adds-alone"
    monkeypatch.chdir(folder)


def told(*args):
    done = tribo(*args)
    assert done.returncode == 0, done.stderr
    return done.stdout + done.stderr


def refused(*args):
    done = tribo(*args)
    assert done.returncode in (2, 3)
    return done.stderr


def run(*observers):
    Path("case.toml").write_text(f"observers = {json.dumps(observers)}\n{template('ball_on_disk')}")
    told("run", "case.toml", *SHORT)


@pytest.mark.slow
def test_plugins_of_a_case_and_those_of_hooks_alone_add_rows_and_pictures_and_no_others_do():
    run("adds_b.calm", "adds_a.calm")
    default_registry.cache_clear()
    # Nor does one that another case has loaded.
    default_registry().load_all()
    rows = json.loads(told("show", "case.h5", "--json"))["lab"]["plugins"]
    names = {"adds_a", "adds_b", "alone"}
    assert {row["label"] for row in rows} == {f"path of {name}" for name in names}
    assert "path of adds_b: 10 mm" in told("show", "case.h5")
    with Result.open("case.h5") as result:
        pictures = result_pictures(result)
    added = {name: draw for name, draw in pictures.items() if name.endswith("_picture")}
    written = {path.name for path in write_figures(added, Path())}
    assert written == {f"{name}_picture.png" for name in names}
    # A result is shown without the plugins that made it.
    os.environ["TRIBO_DISABLE_PLUGINS"] = "*"
    default_registry.cache_clear()
    assert "path of" not in told("show", "case.h5")


@pytest.mark.slow
def test_formats_and_templates_come_from_every_plugin():
    run()
    assert "loads.txt" in told("export", "case.h5", "--format", "adds_b.txt")
    assert Path("case-adds_b.txt/loads.txt").read_text() == "100.0"
    told("new", "adds_a.case", "new.toml")
    assert Path("new.toml").read_text() == "# of adds_a"


@pytest.mark.parametrize(
    ("args", "meant", "other"),
    [
        (("export", "x.h5", "--format", "adds_b.tx"), "adds_b.txt", "adds_a.txt"),
        (("new", "adds_b.cas", "new.toml"), "adds_b.case", "adds_a.case"),
    ],
)
def test_an_unknown_format_or_template_lists_what_there_is(args, meant, other):
    message = refused(*args)
    assert f"did you mean '{meant}'?" in message
    assert other in message


@pytest.mark.parametrize(
    ("instead", "words"),
    [
        ("1 / 0; return [CaseT", "ZeroDivisionError: division by zero ({file}, line "),
        ("return ['text'] or [CaseT", "TypeError: "),
    ],
    ids=["raises", "answers with another class"],
)
def test_a_hook_that_fails_is_named_and_hurts_no_other(folder, instead, words):
    file = folder / "adds_b.py"
    file.write_text(file.read_text().replace("return [CaseT", instead))
    message = told("new", "adds_a.case", "new.toml")
    assert Path("new.toml").read_text() == "# of adds_a"
    assert "tribo_templates of adds_b is left out" in message
    assert words.format(file=file) in message


def test_verify_has_the_cases_of_every_plugin_and_names_a_folder_without_any(folder):
    names = ["adds_a", "adds_b", "adds_c"]
    for name in names:
        mine = folder / f"{name}_cases" / f"case_of_{name}"
        mine.mkdir(parents=True)
        (mine / f"case_of_{name}.py").write_text("def found(): return {'x': 2.5}\n")
        (mine / "expected.toml").write_text(
            "title = 't'\nsource = 'nowhere'\nkind = 'measured'\npublished = true\n"
            "[[expect]]\nquantity = 'x'\nvalue = 2.0\ntolerance = 0.3\nreason = 'made up'\n"
        )
    done = tribo("verify", "case_of_", "--json")
    rows = json.loads(done.stdout)["rows"]
    assert {row["case"]: (row["expected"], row["got"], row["verdict"]) for row in rows} == {
        f"case_of_{name}": (2.0, 2.5, "holds") for name in names
    }
    assert "alone_cases" in done.stderr
