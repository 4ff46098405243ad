"""What this package offers to tribo."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from matplotlib.figure import Figure
from tribo import CaseTemplate, Component, LabRow, Result, hookimpl

from tribo_energy import report
from tribo_energy.dissipation import Dissipation
from tribo_energy.traction import FrictionTraction

EXAMPLE = Path(__file__).with_name("ball_on_disk.toml")


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer wear by dissipated energy, and the friction traction."""
    return (Dissipation, FrictionTraction)


@hookimpl
def tribo_lab_rows(result: Result) -> list[LabRow]:
    """Offer the dissipated energy."""
    return report.lab_rows(result)


@hookimpl
def tribo_figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Offer the worn volumes over the dissipated energy."""
    return report.figures(result)


@hookimpl
def tribo_templates() -> list[CaseTemplate]:
    """Offer the paper's test, worn by dissipated energy."""
    summary = "the paper's test, worn by dissipated energy"
    return [CaseTemplate("energy.ball_on_disk", summary, EXAMPLE.read_text(encoding="utf-8"))]
