"""The hooks that a plugin may implement, and what they return."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import pluggy

from tribo.core.column import Column
from tribo.core.findings import Finding

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from tribo.component import Component
    from tribo.lab.heights import Heights
    from tribo.model.model import Model
    from tribo.result.read import Result

PROJECT = "tribo"
"""Name of the plugin manager."""
api_version = 2
"""Number of the contract between tribo and its plugins (docs/reference/contract.md)."""
GROUP = f"{PROJECT}.{api_version}"
"""Group of the entry points of plugins."""

hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)
"""Marks a function of a plugin as the implementation of the hook it is named after."""


class LabRow(NamedTuple):
    """A quantity below the tables after a run: its label, value, unit, and key in JSON.

    Examples
    --------
    >>> print(tribo.LabRow("depth of the film", 1.3e-7, "m"))
    depth of the film: 1.3e-07 m
    """

    label: str
    value: float
    unit: str
    key: str = ""

    def __str__(self) -> str:
        return f"{self.label}: {self.value:.4g} {self.unit}".rstrip()


class ExportFormat(NamedTuple):
    """A format of `tribo export`: its name, what it holds, and a function that writes it.

    Examples
    --------
    >>> def write(result, path):
    ...     path.write_text(f"{result.distances[-1]:g} m")
    ...     return [path]
    >>> @tribo.hookimpl
    ... def tribo_export_formats():
    ...     return [tribo.ExportFormat("path", "the path slid", write)]
    """

    name: str
    summary: str
    write: Callable[[Result, Path], Iterable[Path]]


class HeightFormat(NamedTuple):
    """A format of measured height maps: its name, what it holds, and a function that reads it.

    Examples
    --------
    >>> def read(path):
    ...     return tribo.Heights(1e-9 * np.fromfile(path).reshape(512, 512), (1e-6, 1e-6))
    >>> @tribo.hookimpl
    ... def tribo_height_formats():
    ...     return [tribo.HeightFormat("acme", "heights in nm on 512 × 512 pixels", read)]
    """

    name: str
    summary: str
    read: Callable[[Path], Heights]


class CaseTemplate(NamedTuple):
    """A case of `tribo new`: its name, what it is, and its text, in TOML.

    Examples
    --------
    >>> from pathlib import Path
    >>> @tribo.hookimpl
    ... def tribo_templates():
    ...     text = Path(__file__).with_name("rig.toml").read_text("utf-8")
    ...     return [tribo.CaseTemplate("acme.rig", "the rig of our lab", text)]
    """

    name: str
    summary: str
    text: str


class Command(NamedTuple):
    """A command of `tribo`: its name, what it does, and where it lies, as ``"acme.fit:fit"``.

    The click command in that module is imported when it is called.

    Examples
    --------
    >>> @tribo.hookimpl
    ... def tribo_commands():
    ...     return [tribo.Command("fit", "fit k to masses", "acme.fit:fit")]
    """

    name: str
    summary: str
    place: str


ITEMS: Mapping[str, type[Any]] = {
    "tribo_quantities": Column,
    "tribo_export_formats": ExportFormat,
    "tribo_height_formats": HeightFormat,
    "tribo_templates": CaseTemplate,
    "tribo_cases": Path,
    "tribo_findings": Finding,
    "tribo_commands": Command,
}
"""What the answers to a hook consist of."""


@hookspec
def tribo_components() -> Iterable[type[Component]]:
    """Return classes that a case may name; the base of each is its kind."""
    return ()


@hookspec
def tribo_quantities() -> Iterable[Column]:
    """Return numbers read off a `Result`: for lab tables, sweeps, comparisons, calibrations."""
    return ()


@hookspec
def tribo_figures(result: Result) -> Mapping[str, Callable[[], Figure]]:
    """Return functions that draw a result that used this plugin, by file name."""
    return {}


@hookspec
def tribo_export_formats() -> Iterable[ExportFormat]:
    """Return formats for `tribo export`."""
    return ()


@hookspec
def tribo_height_formats() -> Iterable[HeightFormat]:
    """Return formats of measured height maps, for `tribo scar`."""
    return ()


@hookspec
def tribo_templates() -> Iterable[CaseTemplate]:
    """Return cases for `tribo new`."""
    return ()


@hookspec
def tribo_cases() -> Iterable[Path]:
    """Return folders of validation cases, for `tribo verify`."""
    return ()


@hookspec
def tribo_findings(model: Model, half_width_x: float) -> Iterable[Finding]:
    """Return findings on a case, given half the length (m) of its first contact."""
    return ()


@hookspec
def tribo_commands() -> Iterable[Command]:
    """Return commands of `tribo`."""
    return ()
