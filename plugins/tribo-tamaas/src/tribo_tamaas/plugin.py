"""What this package offers to tribo."""

from __future__ import annotations

from pathlib import Path

from tribo import Component, hookimpl

from tribo_tamaas.solver import Tamaas


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer tamaas's half-space."""
    return (Tamaas,)


@hookimpl
def tribo_cases() -> tuple[Path, ...]:
    """Offer the validation cases of this package."""
    return (Path(__file__).with_name("cases"),)
