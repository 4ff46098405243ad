"""Every wrong implementation is caught, by the check that says what is wrong."""

import pytest
from testing.conformance import (
    mutants_calls,
    mutants_component,
    mutants_config,
    mutants_contact_solver,
    mutants_effect,
    mutants_kinematics,
    mutants_observer,
    mutants_surface,
    mutants_wear_law,
)
from testing.conformance.caught import MUTANTS
from testing.conformance.honest import HONEST

from tribo.registry.kinds import KINDS
from tribo.testing import check, parametrize_checks
from tribo.testing.kit import SUITES, kind_of, subjects

# Their import lists the mutants.
MUTANT_FILES = (
    mutants_config,
    mutants_component,
    mutants_calls,
    mutants_wear_law,
    mutants_contact_solver,
    mutants_kinematics,
    mutants_surface,
    mutants_effect,
    mutants_observer,
)

for honest in HONEST:
    globals()[f"test_{honest.__name__}_conforms"] = parametrize_checks(honest, configs=[{}])


@pytest.mark.parametrize(
    ("name", "mutant", "raising"), MUTANTS, ids=[f"{m.__name__}-{name}" for name, m, _ in MUTANTS]
)
@pytest.mark.filterwarnings("ignore")
def test_a_mutant_is_caught_by_its_check(name, mutant, raising):
    checks = {one.name: one for one in SUITES[kind_of(mutant).name].checks}
    (subject,) = subjects(mutant, [{}], {})
    with pytest.raises(raising):
        checks[name].run(subject)


def test_there_are_mutants_of_every_kind():
    assert {kind_of(mutant).name for _, mutant, _ in MUTANTS} == set(KINDS)


def test_every_check_catches_a_mutant():
    checks = {one.name for suite in SUITES.values() for one in suite.checks}
    assert checks == {name for name, _, _ in MUTANTS}


@pytest.mark.parametrize("kind", KINDS)
def test_a_mutant_fails_the_whole_kit(kind):
    name, mutant, _ = next(entry for entry in reversed(MUTANTS) if kind_of(entry[1]).name == kind)
    report = check(mutant, [{}])
    assert not report.ok
    assert name in {outcome.check for outcome in report.failures}
