"""What this package offers to tribo."""

from __future__ import annotations

from tribo.plugin import hookimpl

from tribo_tamaas.solver import Tamaas


@hookimpl
def tribo_contact_solvers() -> tuple[type[Tamaas], ...]:
    """Offer tamaas's half-space."""
    return (Tamaas,)
