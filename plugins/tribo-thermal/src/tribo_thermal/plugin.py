"""What this package offers to tribo."""

from __future__ import annotations

from typing import Any

from tribo.plugin import Component, hookimpl

from tribo_thermal.arrhenius import Arrhenius
from tribo_thermal.flash import Flash
from tribo_thermal.softening import Softening


@hookimpl
def tribo_components() -> tuple[type[Component[Any]], ...]:
    """Offer the contact temperature, and Archard's law with what follows it."""
    return (Flash, Arrhenius, Softening)
