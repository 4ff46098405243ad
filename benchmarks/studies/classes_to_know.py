"""Classes that one must know for a change, from the imports of the files concerned.

A change begins in one file; those of the same package that it imports, directly or through each
other, are the files concerned, and what they define or import are the classes to know. Names that
mean more than one class in the tree come last.

    python -m benchmarks.studies.classes_to_know
"""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[2]
CHANGES = {
    "implicit step": "tribo/stepping/implicit.py",
    "result file": "tribo/result/read.py",
    "gradient": "plugins/tribo-inverse/src/tribo_inverse/adjoint/gradient.py",
    "calibration": "plugins/tribo-inverse/src/tribo_inverse/calibration/calibrate.py",
}


def sources() -> dict[str, Path]:
    """Return the files of the kernel and of the packages, by module."""
    found = {}
    for root in (ROOT, *ROOT.glob("plugins/*/src")):
        for path in root.glob("tribo*/**/*.py"):
            parts = path.relative_to(root).with_suffix("").parts
            found[".".join(part for part in parts if part != "__init__")] = path
    return found


SOURCES = sources()
TREES = {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in SOURCES.items()}
CLASSES = {
    name: {node.name for node in tree.body if isinstance(node, ast.ClassDef)}
    for name, tree in TREES.items()
}
NAMES = Counter(name for classes in CLASSES.values() for name in classes)


def concerned(module: str) -> set[str]:
    """Return the modules of its package that a module imports, directly or not, and itself."""
    package, found, left = module.rpartition(".")[0], set(), [module]
    while left:
        name = left.pop()
        if name in found:
            continue
        found.add(name)
        imported = (n.module for n in ast.walk(TREES[name]) if isinstance(n, ast.ImportFrom))
        left += [m for m in imported if m in TREES and m.rpartition(".")[0] == package]
    return found


def to_know(modules: set[str]) -> set[str]:
    """Return the names of the classes of tribo that modules define or import."""
    own = {name for module in modules for name in CLASSES[module]}
    imported = {
        alias.name
        for module in modules
        for node in ast.walk(TREES[module])
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("tribo")
        for alias in node.names
    }
    return own | (imported & NAMES.keys())


def main() -> None:
    """Print the files and classes of each change, and names of several classes."""
    modules = {path.relative_to(ROOT).as_posix(): name for name, path in SOURCES.items()}
    for change, path in CHANGES.items():
        files = concerned(modules[path])
        print(f"{change:15} {len(to_know(files)):3} classes in {len(files):2} files")
    several = sorted(name for name, count in NAMES.items() if count > 1)
    print(f"names of several classes: {', '.join(several) or 'none'}")


if __name__ == "__main__":
    main()
