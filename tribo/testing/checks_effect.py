"""What every effect must fulfil."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from tribo.core.fields import ContactConditions, LocalConditions, WearRate
from tribo.testing import samples
from tribo.testing.checks_calls import Exercise, call_checks, locked
from tribo.testing.compare import expect_array
from tribo.testing.declared import expect_declared
from tribo.testing.subject import Subject, fact, require
from tribo.wear.law import WearLaw


def _inputs(subject: Subject, effect: Any, number: int) -> ContactConditions:
    conditions = samples.contact_conditions(subject, effect)
    if number == 0:
        return conditions
    return replace(conditions, pressure=0.5 * conditions.pressure, time=20.0, distance=2.0)


def _call(effect: Any, conditions: ContactConditions) -> Mapping[str, Any]:
    return {name: dict(values) for name, values in effect.fields(conditions).items()}


EXERCISE = Exercise(_inputs, _call)


@fact
def provided_fields_are_declared(subject: Subject) -> None:
    """It provides at least one field, each with a name, an SI unit and a description."""
    effect = subject.make()
    require(effect.provides, "provides is empty; an effect that provides nothing has no use")
    expect_declared("provides", effect.provides)


@fact
def every_declared_field_is_answered(subject: Subject) -> None:
    """Each declared field comes for each body, finite and of the window's shape; no other does."""
    effect = subject.make()
    for number in (0, 1):
        _expect_answers(effect, locked(_inputs(subject, effect, number)), samples.BODIES)


@fact
def bodies_may_have_any_names(subject: Subject) -> None:
    """Nothing depends on what the bodies are called."""
    effect = subject.make()
    names = ("upper", "lower")
    given = locked(samples.contact_conditions(subject, effect, names))
    answers = _expect_answers(effect, given, names)
    usual = effect.fields(locked(samples.contact_conditions(subject, effect)))
    for field in effect.provides:
        for name, before in zip(names, samples.BODIES, strict=True):
            same = np.array_equal(answers[field.name][name], usual[field.name][before])
            require(same, f"{field.name!r} of a body changes when {before!r} is called {name!r}")


@fact
def only_declared_fields_are_asked_for(subject: Subject) -> None:
    """It asks for no field but those in `requires`."""
    effect = subject.make()
    conditions = samples.contact_conditions(subject, effect)
    fields: Any = samples.Asked(conditions.fields)  # type: ignore[arg-type]
    error: Exception | None = None
    try:
        effect.fields(locked(replace(conditions, fields=fields)))
    except Exception as raised:
        error = raised
    missed = ", ".join(sorted(fields.missed))
    require(not missed, f"it asked for the field {missed}; add that to requires")
    if error is not None:
        raise error


def _reads(names: Sequence[str]) -> WearLaw:
    """Return a law that requires some fields and wears as if they were not there."""

    class Reads(WearLaw):
        type = "tribo.testing.reads"
        requires = tuple(names)

        def rate(self, local: LocalConditions) -> WearRate:
            return samples.archard().rate(local)

    return Reads()


@fact
def runs_in_a_case(subject: Subject) -> None:
    """In a small case a law gets the fields it requires in every step."""
    effect = subject.make()
    law = _reads([field.name for field in effect.provides])
    samples.expect_volume_balance(samples.small_model(subject, law=law, effects=[effect]))


CHECKS = (
    *call_checks(EXERCISE),
    provided_fields_are_declared,
    every_declared_field_is_answered,
    bodies_may_have_any_names,
    only_declared_fields_are_asked_for,
    runs_in_a_case,
)


def _expect_answers(
    effect: Any, conditions: ContactConditions, names: Sequence[str]
) -> Mapping[str, Mapping[str, Any]]:
    answers: Mapping[str, Mapping[str, Any]] = effect.fields(conditions)
    declared = {field.name for field in effect.provides}
    require(
        set(answers) == declared,
        f"fields gave {sorted(answers)}; provides declares {sorted(declared)}",
    )
    for field, values in answers.items():
        require(
            set(values) == set(names),
            f"{field!r} came for the bodies {sorted(values)} of {sorted(names)}",
        )
        for name, value in values.items():
            where = f"{field!r} of body {name!r}"
            try:
                whole = np.broadcast_to(value, conditions.grid.cells)
            except ValueError:
                whole = np.asarray(value)
            expect_array(where, whole, conditions.grid.cells)
    return answers
