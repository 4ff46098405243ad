"""What the packages beside the kernel add, so that who asks for it is told what to install."""

from __future__ import annotations

COMMANDS = {
    "scar": ("tribo-scar", "Measure a scar between two height maps."),
}
"""Package and summary of each command."""
NAMES = {
    **dict.fromkeys(("MeasuredScar", "measured_scar"), "tribo-scar"),
}
"""Package of each name that was one of `tribo`."""


def how_to_install(package: str) -> str:
    """Return the command that installs a package, in the folder of tribo's sources."""
    return f"pip install ./plugins/{package}"
