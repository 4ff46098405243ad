"""What this package offers to tribo."""

from __future__ import annotations

from tribo import Command, hookimpl


@hookimpl
def tribo_commands() -> list[Command]:
    """Offer `tribo report`."""
    summary = "Write a result as one HTML file to hand on."
    return [Command("report", summary, "tribo_report.command:report")]
