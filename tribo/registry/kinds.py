"""The kinds of component by their base classes, and checks of the classes a plugin offers."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Mapping
from types import MappingProxyType

from tribo.component import Component
from tribo.contact.solver import ContactSolver
from tribo.effects.effect import Effect
from tribo.motion.kinematics import Kinematics
from tribo.observers.observer import Observer
from tribo.surfaces.surface import Surface
from tribo.wear.law import WearLaw

_BASES: list[type[Component]] = [ContactSolver, WearLaw, Kinematics, Surface, Effect, Observer]
KINDS: Mapping[str, type[Component]] = MappingProxyType({base.kind(): base for base in _BASES})
"""Base class of each kind, as ``"wear_law"``."""


def check_class(cls: object) -> None:
    """Raise `TypeError` unless `cls` is a class that implements exactly one kind of component."""
    if not inspect.isclass(cls):
        raise TypeError(f"{cls!r} is not a class; give the class, not an object of it")
    bases = [base for base in _BASES if issubclass(cls, base)]
    if len(bases) != 1:
        names = ", ".join(base.__name__ for base in _BASES)
        raise TypeError(f"{cls.__qualname__} must be a subclass of exactly one of {names}")
    if inspect.isabstract(cls):
        missing = ", ".join(sorted(getattr(cls, "__abstractmethods__", ())))
        base = bases[0]
        raise TypeError(
            f"{base.kind().replace('_', ' ')} {cls.__qualname__} has no method {missing}; "
            f"help(tribo.{base.__name__}) shows its form"
        )


def offered(answers: Iterable[object]) -> dict[str, type[Component]]:
    """Return the classes in the answers to the hook `tribo_components`, by name."""
    found: dict[str, type[Component]] = {}
    for answer in answers:
        if not isinstance(answer, Iterable):
            raise TypeError(
                f"tribo_components returns {answer!r}; it must return a list of classes"
            )
        for cls in answer:
            check_class(cls)
            if cls.type in found:
                raise ValueError(f"tribo_components returns {cls.type!r} twice")
            found[cls.type] = cls
    return found
