"""The kinds of component: the hook that offers them and the class they implement."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from tribo.interfaces.component import Component
from tribo.interfaces.contact import ContactSolver
from tribo.interfaces.effect import Effect
from tribo.interfaces.kinematics import Kinematics
from tribo.interfaces.observer import Observer
from tribo.interfaces.surface import Surface
from tribo.interfaces.wear import WearLaw


@dataclass(frozen=True)
class Kind:
    """A kind of component.

    Parameters
    ----------
    name : str
        Its name in the registry, as ``"wear_law"``.
    words : str
        Its name in a sentence, as ``"wear law"``.
    hook : str
        The hook by which plugins offer it.
    interface : type
        The abstract class it implements.
    """

    name: str
    words: str
    hook: str
    interface: type[Component]


KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        kind.name: kind
        for kind in (
            Kind("contact_solver", "contact solver", "tribo_contact_solvers", ContactSolver),
            Kind("wear_law", "wear law", "tribo_wear_laws", WearLaw),
            Kind("kinematics", "kinematics", "tribo_kinematics", Kinematics),
            Kind("surface", "surface", "tribo_surfaces", Surface),
            Kind("effect", "effect", "tribo_effects", Effect),
            Kind("observer", "observer", "tribo_observers", Observer),
        )
    }
)
