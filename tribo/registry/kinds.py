"""The kinds of component, each known by its base class."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from tribo.component import Component
from tribo.contact.solver import ContactSolver
from tribo.effects.effect import Effect
from tribo.motion.kinematics import Kinematics
from tribo.observers.observer import Observer
from tribo.surfaces.surface import Surface
from tribo.wear.law import WearLaw


@dataclass(frozen=True)
class Kind:
    """A kind of component: its name, as ``"wear_law"``, and the base of its classes."""

    name: str
    interface: type[Component]

    @property
    def words(self) -> str:
        """Its name in a sentence, as ``"wear law"``."""
        return self.name.replace("_", " ")

    @property
    def article(self) -> str:
        """The article of `words`: ``"a"`` or ``"an"``."""
        return "an" if self.name[0] in "aeiou" else "a"


INTERFACES: dict[str, type[Component]] = {
    "contact_solver": ContactSolver,
    "wear_law": WearLaw,
    "kinematics": Kinematics,
    "surface": Surface,
    "effect": Effect,
    "observer": Observer,
}
KINDS: Mapping[str, Kind] = MappingProxyType({n: Kind(n, base) for n, base in INTERFACES.items()})


def kind_of(cls: object) -> Kind:
    """Return the kind of component that a class implements; TypeError if it is none."""
    if not inspect.isclass(cls):
        raise TypeError(f"{cls!r} is not a class; give the class, not an object of it")
    kinds = [kind for kind in KINDS.values() if issubclass(cls, kind.interface)]
    if len(kinds) != 1:
        names = ", ".join(kind.interface.__name__ for kind in KINDS.values())
        raise TypeError(f"{cls.__qualname__} must be a subclass of exactly one of {names}")
    if inspect.isabstract(cls):
        missing = ", ".join(sorted(getattr(cls, "__abstractmethods__", ())))
        raise TypeError(f"{cls.__qualname__} does not define {missing}")
    return kinds[0]
