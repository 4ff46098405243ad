"""A new plugin is a complete distribution."""

import ast
import re
import subprocess
import sys
import tomllib
from importlib.metadata import version

import pytest
from packaging.requirements import Requirement
from scaffold.plugins_of_each_kind import NAMES

from tribo.core.errors import CaseError
from tribo.registry.kinds import KINDS
from tribo.scaffold import plugin_names, write_plugin

KNOWN = [kind.replace("_", "-") for kind in KINDS]
EACH = pytest.mark.parametrize(("kind", "name"), [*zip(KNOWN, NAMES.values(), strict=True)])


@EACH
def test_it_is_a_complete_distribution(kind, name, tmp_path):
    folder, names = tmp_path / name, plugin_names(name)
    written = write_plugin(name, kind, folder)
    assert written == sorted(p for p in folder.rglob("*") if p.is_file())
    assert {"LICENSE", ".gitignore", "py.typed"} < {p.name for p in written}
    project = tomllib.loads((folder / "pyproject.toml").read_text())["project"]
    assert project["name"] == name
    assert not re.match("A [aeiou]", project["description"])
    assert project["dependencies"][0] == "tribo>=0.2.dev0"
    assert Requirement("tribo>=0.2.dev0").specifier.contains(version("tribo"), prereleases=True)
    entry = {names["component"]: names["package"]}
    assert project["entry-points"] == {"tribo.2": entry}
    assert (folder / "example.toml").read_text().strip() in (folder / "README.md").read_text()
    assert "${{ matrix.python }}" in (folder / ".github/workflows/ci.yml").read_text()


@EACH
def test_its_code_uses_the_names_of_the_package_only(kind, name, tmp_path):
    for file in write_plugin(name, kind, tmp_path / name):
        if file.suffix == ".py":
            imports = (n for n in ast.walk(ast.parse(file.read_text())) if hasattr(n, "module"))
            used = {node.module for node in imports if node.module.startswith("tribo")}
            assert used <= {"tribo", *(["tribo.testing"] if file.parent.name == "tests" else [])}


def test_a_law_is_25_lines_and_with_its_tests_50(tmp_path):
    write_plugin("acme-fretting", "wear-law", tmp_path / "new")
    law, tests = (
        len((tmp_path / "new" / path).read_text().splitlines())
        for path in ("src/acme_fretting/fretting.py", "tests/test_fretting.py")
    )
    assert law <= 25
    assert law + tests <= 50


def test_it_is_formatted_however_long_its_name(tmp_path):
    name = "a-very-long-name-for-any-model"
    for kind in NAMES:
        write_plugin(name, kind, tmp_path / kind)
    for command in (("check",), ("format", "--check")):
        ruff = (sys.executable, "-m", "ruff", *command, "--no-cache", str(tmp_path))
        done = subprocess.run(ruff, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    ("kind", "folder", "says"),
    [
        ("wear-lwa", "new", "did you mean 'wear-law'"),
        ("xyz", "new", "There are contact-solver, wear-law, kinematics, surface, effect, observer"),
        ("wear-law", ".", "exists; give another folder"),
        ("wear-law", "nowhere/new", "there is no folder .*nowhere; make it with: mkdir"),
    ],
)
def test_what_cannot_be_written_is_refused(kind, folder, says, tmp_path):
    with pytest.raises(CaseError, match=says):
        write_plugin("acme-fretting", kind, tmp_path / folder)
    assert not list(tmp_path.iterdir())
