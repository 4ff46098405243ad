"""The hooks by which tribo finds this package."""

from __future__ import annotations

from collections.abc import Iterable

from tribo.plugin import Effect, WearLaw, hookimpl

from tribo_thermal.arrhenius import Arrhenius
from tribo_thermal.flash import Flash
from tribo_thermal.softening import Softening


@hookimpl
def tribo_effects() -> Iterable[type[Effect]]:
    """Offer the contact temperature."""
    return (Flash,)


@hookimpl
def tribo_wear_laws() -> Iterable[type[WearLaw]]:
    """Offer Archard's law with a coefficient, or a hardness, that follows the temperature."""
    return Arrhenius, Softening
