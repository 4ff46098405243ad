"""What this package offers to tribo."""

from __future__ import annotations

from tribo import Component, hookimpl

from tribo_uhmwpe.cross_shear import CrossShear


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer wear under cross-shear."""
    return (CrossShear,)
