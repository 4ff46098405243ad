"""What this package offers to tribo."""

from __future__ import annotations

from typing import Any

from tribo.plugin import Component, hookimpl

from tribo_energy.dissipation import Dissipation
from tribo_energy.traction import FrictionTraction


@hookimpl
def tribo_components() -> tuple[type[Component[Any]], ...]:
    """Offer wear by dissipated energy, and the friction traction."""
    return (Dissipation, FrictionTraction)
