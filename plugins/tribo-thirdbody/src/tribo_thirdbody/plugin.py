"""What this package offers to tribo."""

from __future__ import annotations

from pathlib import Path

from tribo import Component, hookimpl

from tribo_thirdbody.debris import Debris


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer debris between the bodies."""
    return (Debris,)


@hookimpl
def tribo_cases() -> tuple[Path, ...]:
    """Offer the validation cases of this package."""
    return (Path(__file__).with_name("cases"),)
