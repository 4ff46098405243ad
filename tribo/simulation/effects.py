"""Effects in the order in which they need one another."""

from __future__ import annotations

from collections.abc import Sequence
from graphlib import CycleError, TopologicalSorter

from tribo.case import Case
from tribo.core.errors import CaseError
from tribo.core.fields import FRICTION_COEFFICIENT, LOAD_SHARE, OF_MOTION, Field, names_of
from tribo.guards.parts import GuardedEffect


def in_order(case: Case, effects: Sequence[GuardedEffect]) -> tuple[GuardedEffect, ...]:
    """Return the effects of a case and its motion, each after the providers of its fields.

    `CaseError` if nothing provides a field that an effect or a wear law requires, if a field other
    than the share of the load is provided twice, or if it has the name of a state of a wear law.
    Effects may keep a state of the same name on each body.
    """
    of_laws = {f.name for b in case.bodies.values() if b.wear for f in b.wear.state_fields}
    known = {*OF_MOTION}
    if case.friction is not None:
        known.add(FRICTION_COEFFICIENT.name)
    # By name the bodies that have a state; a state in the contact belongs to all.
    kept: dict[str, set[str]] = {}
    for effect in effects:
        for field in effect.state_fields:
            on = effect.body_of(field)
            bodies, others = {*case.bodies} if on is None else {on}, kept.get(field.name, set())
            if field.name in known | of_laws or bodies & others:
                raise _twice(field, effect)
            kept[field.name] = bodies | others
    known.update(kept)
    states = known | of_laws
    for effect in effects:
        for field in effect.provides:
            if field.name in states or field.name in known - {LOAD_SHARE.name}:
                raise _twice(field, effect)
            known.add(field.name)
    for effect in effects:
        others = {f.name for other in effects if other is not effect for f in other.provides}
        if missing := sorted(set(effect.requires) - others - states):
            raise CaseError(_missing(f"effect {effect.component.type!r}", missing), "effects")
    for name in case.bodies:
        for law in case.bodies[name].laws():
            if missing := sorted(set(names_of(law.requires)) - known):
                text = _missing(f"wear law {law.type!r}", missing)
                raise CaseError(text, f"bodies.{name}.wear")
    # What several provide is known once all have.
    provided = [{field.name for field in effect.provides} for effect in effects]
    after = {
        one: [at for at, names in enumerate(provided) if at != one and names & {*effect.requires}]
        for one, effect in enumerate(effects)
    }
    try:
        return tuple(effects[at] for at in TopologicalSorter(after).static_order())
    except CycleError as error:
        types = ", ".join(effects[at].component.type for at in error.args[1][1:])
        raise CaseError(
            f"each of {types} needs what the next provides, so that they wait for one another",
            "effects",
        ) from None


def _twice(field: Field, effect: GuardedEffect) -> CaseError:
    second = effect.component.type
    text = f"{field.name!r} is provided twice, the second time by {second!r}; keep one"
    return CaseError(text, "effects")


def _missing(who: str, missing: Sequence[str]) -> str:
    if list(missing) == [FRICTION_COEFFICIENT.name]:
        return f"{who} needs a coefficient of friction: add friction = 0.1 above the first table"
    return (
        f"{who} needs {' and '.join(missing)}, which no effect of this case provides: add an "
        "effect that does ('tribo plugins list' names those installed)"
    )
