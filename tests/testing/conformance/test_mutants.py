"""Every wrong implementation is caught, by the check that says what is wrong."""

import sys
import tomllib
from os import getpid
from pathlib import Path
from types import ModuleType
from typing import Annotated

import pytest
from pydantic import field_validator, model_serializer
from testing.conformance.honest_laws import Law
from testing.conformance.mistakes import copy_of
from testing.conformance.test_mistakes import FOUND

from tribo import Quantity
from tribo.testing import samples
from tribo.testing.kit import SUITES, names_of, outcome_of, suites
from tribo.testing.likely import LIKELY

# The configuration, by the example of a wear law.


class WithoutUnit(Law):
    q: float = 3.0
    """Something."""


class Undescribed(Law):
    q: Annotated[float, Quantity("1")] = 3.0


class MillimetresEachTime(Law):
    q: Annotated[float, Quantity("m")] = 3.0
    """A length in mm."""

    @field_validator("q")
    @classmethod
    def _to_metres(cls, value):
        return 1e-3 * value


class AnotherWithoutDefaults(Law):
    @model_serializer(mode="wrap")
    def _short(self, handler, info):
        return {**handler(self), **({"k": 2e-16} if info.exclude_defaults else {})}


def _local():
    class Unreachable(Law):
        """A class that no other process can find."""

    return Unreachable


# Another process that imports this file makes a module of another name.
here = sys.modules[f"only_in_{getpid()}"] = ModuleType("here")
here.OnlyHere = type("OnlyHere", (Law,), {"__module__": f"only_in_{getpid()}"})

MUTANTS = [
    ("configuration_is_described", WithoutUnit),
    ("configuration_is_described", Undescribed),
    ("configuration_survives_a_file", MillimetresEachTime),
    ("configuration_survives_a_file", AnotherWithoutDefaults),
    ("configuration_survives_a_file", _local()),
    ("configuration_survives_a_file", here.OnlyHere),
]
MUTANTS += [
    (check, copy_of(model, mistake))
    for check, models in tomllib.loads(Path(__file__).with_name("mutants.toml").read_text()).items()
    for model, mistakes in models.items()
    for mistake in mistakes.values()
]


@pytest.mark.parametrize(("name", "mutant"), MUTANTS)
@pytest.mark.filterwarnings("ignore")
def test_a_mutant_is_caught_by_its_check(monkeypatch, name, mutant):
    # One never comes to its end.
    monkeypatch.setattr(samples, "STEPS", 100)
    (checks,) = suites(mutant, [{}])
    assert outcome_of(checks, name).status == "failed"


def test_every_check_catches_a_mutant():
    checks = {name for suite in SUITES.values() for name in names_of(suite)}
    found = {name for row in FOUND for name in row["found_by"]}
    assert {*LIKELY} <= checks
    assert checks == found | {name for name, _ in MUTANTS}
