"""What this package offers to tribo."""

from __future__ import annotations

from typing import Any

from tribo.plugin import Component, hookimpl

from tribo_topography.surface import Measured


@hookimpl
def tribo_components() -> tuple[type[Component[Any]], ...]:
    """Offer surfaces measured by an instrument."""
    return (Measured,)
