"""What this package offers to tribo."""

from __future__ import annotations

from tribo.plugin import hookimpl

from tribo_topography.surface import Measured


@hookimpl
def tribo_surfaces() -> tuple[type[Measured], ...]:
    """Offer surfaces measured by an instrument."""
    return (Measured,)
