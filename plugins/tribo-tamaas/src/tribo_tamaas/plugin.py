"""What this package offers to tribo."""

from __future__ import annotations

from typing import Any

from tribo.plugin import Component, hookimpl

from tribo_tamaas.solver import Tamaas


@hookimpl
def tribo_components() -> tuple[type[Component[Any]], ...]:
    """Offer tamaas's half-space."""
    return (Tamaas,)
