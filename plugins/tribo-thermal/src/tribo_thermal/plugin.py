"""What this package offers to tribo."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from matplotlib.figure import Figure
from tribo import CaseTemplate, Component, LabRow, Result, hookimpl

from tribo_thermal import report
from tribo_thermal.arrhenius import Arrhenius
from tribo_thermal.flash import Flash
from tribo_thermal.softening import Softening

EXAMPLE = Path(__file__).with_name("ball_on_disk.toml")


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer the contact temperature, and Archard's law with what follows it."""
    return (Flash, Arrhenius, Softening)


@hookimpl
def tribo_lab_rows(result: Result) -> list[LabRow]:
    """Offer the highest temperatures in the contact."""
    return report.lab_rows(result)


@hookimpl
def tribo_figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Offer the temperature in the contact over time."""
    return report.figures(result)


@hookimpl
def tribo_templates() -> list[CaseTemplate]:
    """Offer the paper's test in its warm bath, with wear that follows the temperature."""
    summary = "the paper's test, with wear that follows the temperature of the contact"
    return [CaseTemplate("thermal.ball_on_disk", summary, EXAMPLE.read_text(encoding="utf-8"))]
