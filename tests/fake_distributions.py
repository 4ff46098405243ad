"""Distributions for tests: a folder that looks like installed packages."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from tribo.registry.hookspecs import GROUP
from tribo.registry.plugins import Plugin, installed

OBSERVER = """
from tribo import Observer, hookimpl

class {title}(Observer):
    type = "{name}"

@hookimpl
def tribo_components():
    return [{title}]
"""

LAW = """
from tribo import WearLaw, WearRate, hookimpl

class Hot(WearLaw):
    type = "{name}"
    requires = ()

    def rate(self, local):
        return WearRate(3e-16 * local.pressure)

@hookimpl
def tribo_components():
    return [Hot]
"""


SHORT = [
    f"--set={change}"
    for change in (
        *("grid.size=0.7 mm", "grid.cells=32", "kinematics.duration=0.1"),
        "output.save_times=[]",
    )
]
"""Words that make a run of a template short."""


def observer(name: str) -> str:
    """Return the code of a plugin with one observer of this name."""
    return OBSERVER.format(name=name, title=name.split(".")[-1].title())


def plugins(*distributions: str) -> list[Plugin]:
    """Return the plugins of these distributions."""
    return [plugin for plugin in installed() if plugin.distribution in distributions]


def distribute(
    folder: Path,
    name: str,
    version: str,
    points: Mapping[str, str],
    group: str = GROUP,
    **modules: str,
) -> None:
    """Put a distribution with entry points {name: module} and modules into `folder`."""
    info = folder / f"{name.replace('-', '_')}-{version}.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\nSummary: A {name} for tests.\n"
    )
    lines = [f"[{group}]", *(f"{key} = {value}" for key, value in points.items()), ""]
    (info / "entry_points.txt").write_text("\n".join(lines) if points else "")
    for module, code in modules.items():
        (folder / f"{module}.py").write_text(code)
