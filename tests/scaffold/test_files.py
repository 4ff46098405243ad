"""A new plugin is a complete distribution, which works as it was written."""

from __future__ import annotations

import ast
import importlib
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from scaffold.plugins_of_each_kind import NAMES

from tribo.core.errors import CaseError
from tribo.registry.kinds import KINDS
from tribo.registry.registry import Registry
from tribo.scaffold import PluginName, write_plugin
from tribo.simulation.run import Simulation

KINDS_OF_NAMES = list(NAMES.items())


def test_there_is_a_start_for_every_kind() -> None:
    assert [kind.replace("-", "_") for kind in sorted(NAMES)] == sorted(KINDS)


@pytest.mark.parametrize(("kind", "name"), KINDS_OF_NAMES)
def test_it_is_a_complete_distribution(kind: str, name: str, tmp_path: Path) -> None:
    folder = tmp_path / name
    written = write_plugin(name, kind, folder)
    assert written == sorted(p for p in folder.rglob("*") if p.is_file())
    package = name.replace("-", "_")
    assert {str(p.relative_to(folder)) for p in written} == {
        ".github/workflows/ci.yml",
        ".gitignore",
        "LICENSE",
        "README.md",
        "example.toml",
        "pyproject.toml",
        f"src/{package}/__init__.py",
        f"src/{package}/py.typed",
        f"src/{package}/{PluginName(name).module}.py",
        "tests/test_conformance.py",
        "tests/test_example.py",
    }
    project = tomllib.loads((folder / "pyproject.toml").read_text())["project"]
    assert project["name"] == name
    assert not re.match("A [aeiou]", project["description"])
    assert "tribo>=0.1,<0.2" in project["dependencies"]
    points = {"tribo": {PluginName(name).component: package}}
    assert project["entry-points"] == points
    assert (folder / "example.toml").read_text().strip() in (folder / "README.md").read_text()
    assert "${{ matrix.python }}" in (folder / ".github/workflows/ci.yml").read_text()


@pytest.mark.parametrize(("kind", "name"), KINDS_OF_NAMES)
def test_its_code_uses_nothing_of_tribo_but_what_a_plugin_may(
    kind: str, name: str, tmp_path: Path
) -> None:
    public = {"tribo", "tribo.testing"}
    for file in write_plugin(name, kind, tmp_path / name):
        if file.suffix != ".py":
            continue
        allowed = public if file.parent.name == "tests" else {"tribo"}
        imported = {
            node.module
            for node in ast.walk(ast.parse(file.read_text()))
            if isinstance(node, ast.ImportFrom)
        }
        assert {m for m in imported if m and m.startswith("tribo")} <= allowed


@pytest.mark.parametrize(("kind", "name"), KINDS_OF_NAMES)
def test_its_example_runs_with_it(
    kind: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plugin = PluginName(name)
    write_plugin(name, kind, tmp_path / name)
    monkeypatch.syspath_prepend(str(tmp_path / name / "src"))
    # Gone again after the test, so that no other sees it.
    for module in (plugin.package, f"{plugin.package}.{plugin.module}"):
        monkeypatch.setitem(sys.modules, module, None)
        del sys.modules[module]
    registry = Registry.with_plugins(importlib.import_module(plugin.package))
    assert [p.reason for p in registry.plugins] == ["", ""]
    assert plugin.component in registry.names(kind.replace("-", "_"))
    with Simulation(tmp_path / name / "example.toml", registry=registry).run() as result:
        used = {c["type"]: c["class"] for c in result.provenance["components"].values()}
    assert used[plugin.component] == f"{plugin.package}.{plugin.module}.{plugin.title}"


def test_its_conformance_test_covers_every_class_of_the_hook(tmp_path: Path) -> None:
    folder = tmp_path / "acme-fretting"
    write_plugin(folder.name, "wear-law", folder)
    module = folder / "src/acme_fretting/fretting.py"
    text = module.read_text()
    second = text[text.index("class Fretting") :]
    second = second.replace("Fretting", "Second").replace("acme.fretting", "acme.second")
    module.write_text(text + "\n\n" + second.replace("depth_rate=k", "depth_rate=2 * k"))
    package = folder / "src/acme_fretting/__init__.py"
    package.write_text(
        package.read_text()
        .replace("import Fretting", "import Fretting, Second")
        .replace("(Fretting,)", "(Fretting, Second)")
    )
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests"],
        cwd=folder,
        env={"PYTHONPATH": os.pathsep.join([str(folder / "src"), *sys.path])},
        capture_output=True,
        text=True,
        check=False,
    )
    # The depth of the second is twice what its derivative says.
    assert "test_Second_conforms[derivative_is_that_of_the_depth" in done.stdout
    assert "FAILED tests/test_conformance.py::test_Fretting" not in done.stdout


@pytest.mark.parametrize("kind", NAMES)
def test_it_is_formatted_however_long_its_name(kind: str, tmp_path: Path) -> None:
    name = "a-very-long-name-for-any-model"
    assert len(name) == 30
    write_plugin(name, kind, tmp_path / name)
    for command in (("check",), ("format", "--check")):
        ruff = (sys.executable, "-m", "ruff", *command, "--no-cache", str(tmp_path / name))
        done = subprocess.run(ruff, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout


def test_the_kind_may_be_spelt_as_in_the_registry(tmp_path: Path) -> None:
    assert write_plugin("acme-fretting", "wear_law", tmp_path / "new")


@pytest.mark.parametrize(
    ("kind", "begins"),
    [("wear-lwa", "'wear-lwa'; did you mean 'wear-law'?"), ("xyz", "'xyz'.")],
)
def test_an_unknown_kind_is_refused(kind: str, begins: str, tmp_path: Path) -> None:
    with pytest.raises(CaseError) as caught:
        write_plugin("acme-fretting", kind, tmp_path / "new")
    assert str(caught.value) == (
        f"unknown kind {begins} Known: contact-solver, wear-law, kinematics, surface, effect, "
        "observer"
    )
    assert not (tmp_path / "new").exists()


def test_nothing_is_written_over(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="exists; give another folder"):
        write_plugin("acme-fretting", "wear-law", tmp_path)
    assert not list(tmp_path.iterdir())


def test_the_folder_s_parent_must_exist(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=r"there is no folder .*nowhere; make it first"):
        write_plugin("acme-fretting", "wear-law", tmp_path / "nowhere" / "new")
