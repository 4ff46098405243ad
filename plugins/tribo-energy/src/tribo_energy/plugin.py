"""What this package offers to tribo."""

from __future__ import annotations

from pathlib import Path

from tribo import CaseTemplate, Component, hookimpl

from tribo_energy.dissipation import Dissipation
from tribo_energy.report import tribo_figures, tribo_lab_rows
from tribo_energy.traction import FrictionTraction

__all__ = ["tribo_components", "tribo_figures", "tribo_lab_rows", "tribo_templates"]

EXAMPLE = Path(__file__).with_name("ball_on_disk.toml")


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer wear by dissipated energy, and the friction traction."""
    return (Dissipation, FrictionTraction)


@hookimpl
def tribo_templates() -> list[CaseTemplate]:
    """Offer the paper's test, worn by dissipated energy."""
    summary = "the paper's test, worn by dissipated energy"
    return [CaseTemplate("energy.ball_on_disk", summary, EXAMPLE.read_text(encoding="utf-8"))]
