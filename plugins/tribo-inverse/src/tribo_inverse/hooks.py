"""What this package offers to tribo."""

from __future__ import annotations

from importlib.resources import files

from tribo import CaseTemplate, Command, hookimpl


@hookimpl
def tribo_commands() -> list[Command]:
    """Offer `tribo calibrate`."""
    summary = "Fit a case to measured wear."
    return [Command("calibrate", summary, "tribo_inverse.command:calibrate")]


@hookimpl
def tribo_templates() -> list[CaseTemplate]:
    """Offer a file of measurements."""
    text = files("tribo_inverse").joinpath("templates/weighed.toml").read_text(encoding="utf-8")
    summary = "What was weighed in the paper's test, for tribo calibrate."
    return [CaseTemplate("weighed", summary, text)]
