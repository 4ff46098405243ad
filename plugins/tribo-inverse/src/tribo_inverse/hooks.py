"""The hooks of this package."""

from __future__ import annotations

from importlib.resources import files
from typing import TYPE_CHECKING

from tribo import CaseTemplate, Command, Finding, hookimpl

if TYPE_CHECKING:
    from tribo.kernel_api import Model


@hookimpl
def tribo_commands() -> list[Command]:
    """Offer `tribo calibrate`."""
    summary = "Fit a case to measured wear."
    return [Command("calibrate", summary, "tribo_inverse.command:calibrate")]


@hookimpl
def tribo_findings(model: Model, half_width_x: float) -> list[Finding]:
    """Report the numbers of a case with the largest influence on its answer."""
    from tribo_inverse.adjoint.sensitivity import of_case

    return of_case(model, half_width_x)


@hookimpl
def tribo_templates() -> list[CaseTemplate]:
    """Offer a file of measurements."""
    text = files("tribo_inverse").joinpath("templates/weighed.toml").read_text(encoding="utf-8")
    summary = "What was weighed in the paper's test, for tribo calibrate."
    return [CaseTemplate("weighed", summary, text)]
