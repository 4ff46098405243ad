"""What this package offers to tribo."""

from __future__ import annotations

from pathlib import Path

from tribo import CaseTemplate, Component, hookimpl

from tribo_thermal.arrhenius import Arrhenius
from tribo_thermal.flash import Flash
from tribo_thermal.report import tribo_figures, tribo_lab_rows
from tribo_thermal.softening import Softening

__all__ = ["tribo_components", "tribo_figures", "tribo_lab_rows", "tribo_templates"]

EXAMPLE = Path(__file__).with_name("ball_on_disk.toml")


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer the contact temperature, and Archard's law with what follows it."""
    return (Flash, Arrhenius, Softening)


@hookimpl
def tribo_templates() -> list[CaseTemplate]:
    """Offer the paper's test in its warm bath, with wear that follows the temperature."""
    summary = "the paper's test, with wear that follows the temperature of the contact"
    return [CaseTemplate("thermal.ball_on_disk", summary, EXAMPLE.read_text(encoding="utf-8"))]
