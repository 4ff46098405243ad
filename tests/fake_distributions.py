"""Distributions for tests: a folder that looks like installed packages."""

from __future__ import annotations

from pathlib import Path

from tribo.registry.loader import Source, installed

OBSERVER = """
from typing import Literal
from tribo.plugin import Observer, hookimpl

class {title}Config(Observer):
    type = "{name}"

class {title}(Observer[{title}Config]):
    Config = {title}Config

@hookimpl
def tribo_observers():
    return [{title}]
"""


def observer(name: str) -> str:
    """Return the code of a plugin with one observer of this name."""
    return OBSERVER.format(name=name, title=name.split(".")[-1].title())


def sources(*distributions: str) -> list[Source]:
    """Return the plugins of these distributions."""
    return [s for s in installed() if s.record.distribution in distributions]


def distribute(
    folder: Path, name: str, version: str, points: dict[str, dict[str, str]], **modules: str
) -> None:
    """Put a distribution with entry points {group: {name: module}} and modules into `folder`."""
    info = folder / f"{name.replace('-', '_')}-{version}.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\nSummary: A {name} for tests.\n"
    )
    lines = []
    for group, entries in points.items():
        lines += [f"[{group}]", *(f"{key} = {value}" for key, value in entries.items()), ""]
    (info / "entry_points.txt").write_text("\n".join(lines))
    for module, code in modules.items():
        (folder / f"{module}.py").write_text(code)
