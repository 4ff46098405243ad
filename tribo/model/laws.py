"""The wear laws and interfacial effects of a case, and the fields that they need and keep."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from tribo.core.fields import FRICTION_COEFFICIENT, LOCAL_SLIP, WORN_DEPTH, Field
from tribo.guards.parts import GuardedEffect, GuardedLaw


@dataclass(frozen=True)
class Laws:
    """Laws by body, and effects, each after those that provide what it requires.

    Parameters
    ----------
    wear : Mapping of GuardedLaw
        The laws of the bodies that wear, by body.
    effects : tuple of GuardedEffect
        The interfacial effects.
    friction_coefficient : float or None
        Coefficient of friction of the case, if it has one.
    """

    wear: Mapping[str, GuardedLaw]
    effects: tuple[GuardedEffect, ...]
    friction_coefficient: float | None = None

    @cached_property
    def between(self) -> Mapping[str, tuple[GuardedEffect, Field]]:
        """The state fields of the effects, by key in `State.between`, each with its effect."""
        return {e.key_of(field): (e, field) for e in self.effects for field in e.state_fields}

    @cached_property
    def filling(self) -> tuple[tuple[str | None, str], ...]:
        """Keys of states that fill the gap, with the body whose law has each; None for effects."""
        of_laws = [(name, f.name, f) for name, law in self.wear.items() for f in law.state_fields]
        of_effects = [(None, key, field) for key, (_, field) in self.between.items()]
        return tuple((body, key) for body, key, f in (*of_laws, *of_effects) if f.fills)

    @cached_property
    def required(self) -> frozenset[str]:
        """Names of the fields that laws and effects need."""
        of_laws = (name for law in self.wear.values() for name in law.requires)
        return frozenset((*of_laws, *(n for effect in self.effects for n in effect.requires)))

    def kept_on(self, body: str | None) -> tuple[Field, ...]:
        """Return the state fields on a body's surface, or of the contact as a whole for None."""
        law = self.wear.get(body) if body is not None else None
        carried = (f for effect, f in self.between.values() if effect.body_of(f) == body)
        own = (f for f in (law.state_fields if law else ()) if f.name != WORN_DEPTH.name)
        return (*own, *carried)

    @cached_property
    def provided(self) -> frozenset[str]:
        """Names of the fields that effects provide."""
        return frozenset(field.name for effect in self.effects for field in effect.provides)

    @cached_property
    def friction_by_point(self) -> bool:
        """Whether friction differs from point to point, by the coefficient or the slip."""
        return not self.provided.isdisjoint((FRICTION_COEFFICIENT.name, LOCAL_SLIP.name))
