"""Imports go one way."""

import ast
import re
import sys
import tomllib
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import tribo

ROOT = Path(tribo.__file__).parent
PLUGINS = ROOT.parent / "plugins"

# A package, or a module beside them, may import those of its own rank or below.
RANK = {
    "core": 0,
    "packages": 0,
    "templates": 0,
    "units": 1,
    "closed_forms": 1,
    "component": 1,
    "contract": 2,
    "result": 2,
    "contact": 3,
    "wear": 3,
    "motion": 3,
    "surfaces": 3,
    "effects": 3,
    "observers": 3,
    "lab": 4,
    "registry": 4,
    "config": 5,
    "case": 5,
    "guards": 4,
    "integration": 1,
    "model": 5,
    "evolution": 5,
    "stepping": 5,
    "simulation": 6,
    "plotting": 7,
    "study": 8,
    "testing": 7,
    "verification": 7,
    "scaffold": 7,
    "cli": 9,
    "kernel_api": 10,
    "__init__": 10,
    "__main__": 10,
}
LOW = {"core", "component", "integration", "model", "evolution", "stepping"}
MODELS = {"contact", "wear", "motion", "surfaces", "effects", "observers"}


@cache
def imports(path: Path, *, types: bool = False) -> set[str]:
    """Modules of tribo that a file imports, those for type checking only with `types`."""
    tree = ast.parse(path.read_text())
    skipped = {
        id(node)
        for block in ast.walk(tree)
        if not types and isinstance(block, ast.If) and ast.unparse(block.test) == "TYPE_CHECKING"
        for node in ast.walk(block)
    }
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and id(node) not in skipped:
            names = {f"{node.module}.{alias.name}" for alias in node.names}
            found |= names & MODULES.keys() or {node.module or ""}
        elif isinstance(node, ast.Import) and id(node) not in skipped:
            found |= {alias.name for alias in node.names}
    # The names of `tribo` lie above all of it.
    found = {"tribo.__init__" if name == "tribo" else name for name in found}
    return {name for name in found if name.startswith("tribo.")}


def packages(path: Path, *, types: bool = False) -> set[str]:
    """Packages of tribo that a file imports, and modules beside them."""
    return {name.split(".")[1] for name in imports(path, types=types)}


MODULES = {
    ".".join(path.relative_to(ROOT.parent).with_suffix("").parts): path
    for path in ROOT.rglob("*.py")
    # Scripts of validation cases import tribo as a user does.
    if "cases" not in path.parts
}
FILES = sorted(MODULES.values())


def package_of(path):
    return path.relative_to(ROOT).parts[0].removesuffix(".py")


def test_imports_go_one_way():
    for path in FILES:
        above = [other for other in packages(path) if RANK[other] > RANK[package_of(path)]]
        assert not above, path


def test_core_and_steps_name_nothing_above_them_even_as_a_type():
    for path in (p for p in FILES if package_of(p) in LOW):
        named = packages(path, types=True)
        assert not [other for other in named if RANK[other] > RANK[package_of(path)]], path


def test_models_use_only_what_a_stranger_may():
    for path in (p for p in FILES if package_of(p) in MODELS):
        own = {"core", "component", "closed_forms", "result", package_of(path)}
        assert packages(path) <= own, path


def test_packages_use_what_the_kernel_hands_out():
    for path in PLUGINS.glob("*/src/**/*.py"):
        assert imports(path) <= {"tribo.__init__", "tribo.kernel_api"}, path


def test_packages_declare_what_they_import():
    for folder in (file.parent for file in PLUGINS.glob("*/pyproject.toml")):
        project = tomllib.loads((folder / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        extras = project.get("optional-dependencies", {}).values()
        needed = [*project["dependencies"], *(name for extra in extras for name in extra)]
        declared = {re.match(r"[\w-]+", name)[0].lower() for name in needed} | {folder.name}
        for path in folder.glob("src/**/*.py"):
            tree = ast.parse(path.read_text(encoding="utf-8"))
            modules = {
                name.split(".")[0]
                for node in ast.walk(tree)
                if isinstance(node, ast.Import | ast.ImportFrom)
                for name in [getattr(node, "module", None) or node.names[0].name]
            }
            modules -= sys.stdlib_module_names
            assert {name.lower().replace("_", "-") for name in modules} <= declared, path


def test_every_package_has_a_rank():
    assert {path.relative_to(ROOT).parts[0].removesuffix(".py") for path in FILES} == set(RANK)


def test_no_module_imports_what_imports_it():
    # Types may name one another: what happens as modules run counts, within functions too.
    list(TopologicalSorter({name: imports(path) for name, path in MODULES.items()}).static_order())
