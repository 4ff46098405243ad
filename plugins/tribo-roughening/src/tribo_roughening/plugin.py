"""What this package offers to tribo."""

from __future__ import annotations

from tribo import Component, hookimpl

from tribo_roughening.detachment import Detachment


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer wear in particles."""
    return (Detachment,)
