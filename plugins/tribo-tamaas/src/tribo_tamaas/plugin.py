"""What this package offers to tribo."""

from __future__ import annotations

from tribo import Component, hookimpl

from tribo_tamaas.solver import Tamaas


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer tamaas's half-space."""
    return (Tamaas,)
