"""The hooks by which tribo finds this package."""

from __future__ import annotations

from collections.abc import Iterable

from tribo.plugin import Effect, WearLaw, hookimpl

from tribo_energy.dissipation import Dissipation
from tribo_energy.traction import FrictionTraction


@hookimpl
def tribo_wear_laws() -> Iterable[type[WearLaw]]:
    """Offer wear by dissipated energy."""
    return (Dissipation,)


@hookimpl
def tribo_effects() -> Iterable[type[Effect]]:
    """Offer the friction traction."""
    return (FrictionTraction,)
