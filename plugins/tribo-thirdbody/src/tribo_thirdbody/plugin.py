"""What this package offers to tribo."""

from __future__ import annotations

from tribo import Component, hookimpl

from tribo_thirdbody.debris import Debris


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer debris between the bodies."""
    return (Debris,)
