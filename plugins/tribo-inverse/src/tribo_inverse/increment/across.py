"""Effects that state their `pull_back`: evaluated once, then held."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from tribo import Array, ContactConditions, Effect
from tribo.kernel_api import GuardedEffect, Model, leaves

Fields = Mapping[str, Mapping[str, Array]]
"""By field and body, shape (nx, ny)."""


@dataclass(frozen=True)
class EffectFields:
    """The fields of an effect in a contact."""

    effect: GuardedEffect
    contact: ContactConditions
    fields: Fields

    @property
    def told(self) -> dict[str, Array]:
        """The possible inputs of the fields, by path; numbers too in the shape of the window."""
        contact = self.contact
        own = {name: of for name, of in contact.fields.items() if name in self.effect.requires}
        parts = {**vars(contact), "system": vars(contact.system), "fields": own}
        return {
            ".".join(map(str, place)): np.broadcast_to(value, contact.pressure.shape)
            for place, value, _ in (*leaves(parts), *leaves(self.effect.component))
            if isinstance(value, float | np.ndarray) and np.all(np.isfinite(value))
        }

    def back(self, cotangents: Fields) -> list[Array]:
        """Return the derivatives in the inputs `told` from the derivatives in the fields."""
        pull_back, shape = self.effect.component.pull_back, self.contact.pressure.shape
        found = self.effect.ask(pull_back, self.contact, cotangents)
        each = (np.asarray(found.get(path, 0.0)) for path in self.told)
        return [
            by if by.shape == shape else np.full(shape, np.sum(by) / np.prod(shape)) for by in each
        ]


class HeldEffect(GuardedEffect):
    """An effect that notes its answers, or repeats the answers given."""

    def __init__(self, effect: GuardedEffect, given: Sequence[EffectFields]) -> None:
        vars(self).update(vars(effect))
        self._effect, self._given, self.noted = effect, given, list[EffectFields]()

    def fields(self, contact: ContactConditions) -> dict[str, dict[str, Array]]:
        """Return its fields."""
        given = self._given[len(self.noted)].fields if self._given else None
        found = self._effect.fields(contact) if given is None else given
        self.noted.append(EffectFields(self._effect, contact, found))
        return {name: dict(of_bodies) for name, of_bodies in found.items()}


def held(model: Model, answers: Sequence[Sequence[EffectFields]] = ()) -> Model:
    """Return a model whose effects with a `pull_back` note answers, or repeat the answers given."""
    given = iter(answers)
    effects = tuple(
        effect
        if type(effect.component).pull_back is Effect.pull_back
        else HeldEffect(effect, next(given, ()))
        for effect in model.laws.effects
    )
    return replace(model, laws=replace(model.laws, effects=effects))


def held_effects(model: Model) -> list[HeldEffect]:
    """Return the effects of a model that are `held`."""
    return [effect for effect in model.laws.effects if isinstance(effect, HeldEffect)]
