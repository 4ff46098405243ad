"""Imports go one way."""

import ast
from pathlib import Path

import pytest

import tribo

ROOT = Path(tribo.__file__).parent

# A package may import those of its own rank or below.
RANK = {
    "core": 0,
    "templates": 0,
    "closed_forms": 1,
    "component": 1,
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
    "stepping": 5,
    "simulation": 6,
    "plotting": 7,
    "study": 8,
    "report": 8,
    "testing": 7,
    "verification": 7,
    "scaffold": 7,
    "cli": 9,
}
MODELS = {"contact", "wear", "motion", "surfaces", "effects", "observers"}


# A result shows itself, and a notebook asks the object.
SHOWN = {
    "result/read.py": {"lab", "plotting", "cli"},
    # A page has the tables of the terminal.
    "report/result.py": {"cli"},
    "report/comparison.py": {"cli"},
    "report/calibration.py": {"cli"},
}


def imports(path: Path) -> list[str]:
    """Packages of tribo that a file imports, those for type checking left out."""
    tree = ast.parse(path.read_text())
    found = []
    skipped = {
        id(node)
        for block in ast.walk(tree)
        if isinstance(block, ast.If) and ast.unparse(block.test) == "TYPE_CHECKING"
        for node in ast.walk(block)
    }
    for node in ast.walk(tree):
        if id(node) in skipped:
            continue
        names = []
        if isinstance(node, ast.ImportFrom):
            names = [node.module or ""]
            if node.module == "tribo":
                names = [f"tribo.{alias.name}" for alias in node.names]
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        found += [name.split(".")[1] for name in names if name.startswith("tribo.")]
    return found


FILES = sorted(p for p in ROOT.rglob("*.py") if p.parent != ROOT)


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(ROOT)))
def test_imports_go_one_way(path):
    package = path.relative_to(ROOT).parts[0]
    for other in set(imports(path)) - SHOWN.get(path.relative_to(ROOT).as_posix(), set()):
        assert RANK[other] <= RANK[package], f"{package} imports {other}"


@pytest.mark.parametrize(
    "path",
    [p for p in FILES if p.relative_to(ROOT).parts[0] in MODELS],
    ids=lambda p: str(p.relative_to(ROOT)),
)
def test_models_use_only_what_a_stranger_may(path):
    package = path.relative_to(ROOT).parts[0]
    assert set(imports(path)) <= {"core", "component", "closed_forms", "result", package}


def test_every_package_has_a_rank():
    packages = {p.name for p in ROOT.iterdir() if p.is_dir() and p.name != "__pycache__"}
    assert packages | {"component", "case"} == set(RANK)
