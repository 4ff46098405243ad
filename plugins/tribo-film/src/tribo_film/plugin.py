"""What this package offers to tribo."""

from __future__ import annotations

from tribo import Component, hookimpl

from tribo_film.mixed import Mixed


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer mixed lubrication."""
    return (Mixed,)
