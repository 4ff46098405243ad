"""What this package offers to tribo."""

from __future__ import annotations

from tribo import Command, hookimpl


@hookimpl
def tribo_commands() -> list[Command]:
    """Offer `tribo scar`."""
    return [
        Command("scar", "Measure a scar between two height maps.", "tribo_scar.command:scar"),
    ]
