"""Effects in the order in which they need one another."""

from __future__ import annotations

from collections.abc import Sequence

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
    ordered: list[GuardedEffect] = []
    waiting = list(effects)
    while waiting:
        # What several provide is known once all have.
        free = [e for e in waiting if not any(_needs(e, other) for other in waiting)]
        ready = (free or waiting)[0]
        missing = sorted(set(ready.requires) - known - of_laws)
        if missing or not free:
            missing = missing or [LOAD_SHARE.name]
            text = _missing(f"effect {ready.component.type!r}", missing, waiting)
            raise MissingFieldError(text, "effects", missing)
        shares = {LOAD_SHARE.name} & {name for e in ordered for name in _provided(e)}
        waiting.remove(ready)
        ordered.append(ready)
        for field in ready.provides:
            if field.name in (known | of_laws) - shares:
                raise _twice(field, ready)
            known.add(field.name)
    for name in case.bodies:
        for law in case.bodies[name].laws():
            if missing := sorted(set(names_of(law.requires)) - known):
                text = _missing(f"wear law {law.type!r}", missing, [])
                raise MissingFieldError(text, f"bodies.{name}.wear", missing)
    return tuple(ordered)


def _needs(effect: GuardedEffect, other: GuardedEffect) -> bool:
    return effect is not other and bool(set(effect.requires) & _provided(other))


def _provided(effect: GuardedEffect) -> set[str]:
    return {field.name for field in effect.provides}


def _twice(field: Field, effect: GuardedEffect) -> CaseError:
    second = effect.component.type
    text = f"{field.name!r} is provided twice, the second time by {second!r}; keep one"
    return CaseError(text, "effects")


class MissingFieldError(CaseError):
    """A law or an effect needs fields that nothing provides."""

    def __init__(self, message: str, path: str, missing: Sequence[str]) -> None:
        super().__init__(message, path)
        self.missing = set(missing)


def _missing(who: str, missing: Sequence[str], waiting: Sequence[GuardedEffect]) -> str:
    if list(missing) == [FRICTION_COEFFICIENT.name]:
        return f"{who} needs a coefficient of friction: add friction = 0.1 above the first table"
    in_circle = [effect.component.type for effect in waiting if _provided(effect) & set(missing)]
    if in_circle:
        return (
            f"{who} needs {', '.join(missing)}, which {', '.join(in_circle)} provides, but these "
            "effects wait for one another"
        )
    return (
        f"{who} needs {' and '.join(missing)}, which no effect of this case provides: add an "
        "effect that does ('tribo plugins list' names those installed)"
    )
