"""Every wrong implementation is caught, by the check that says what is wrong."""

import pytest
from testing.conformance.honest_effects import Slip
from testing.conformance.mutants import MUTANTS, Spring, product
from testing.conformance.test_mistakes import FOUND

from tribo.testing import samples
from tribo.testing.kit import SUITES, names_of, perform, suites
from tribo.testing.likely import LIKELY


@pytest.mark.parametrize(("name", "mutant", "raising"), MUTANTS)
@pytest.mark.filterwarnings("ignore")
def test_a_mutant_is_caught_by_its_check(monkeypatch, name, mutant, raising):
    # One never comes to its end.
    monkeypatch.setattr(samples, "STEPS", 100)
    (checks,) = suites(mutant, [{}], {})
    with pytest.raises(raising):
        perform(checks, name)


@pytest.mark.parametrize(
    ("sound", "name"),
    [
        (type("Stated", (Slip,), {"pull_back": product}), "product_is_that_of_differences"),
        (Spring, "runs_in_a_case"),
    ],
)
def test_what_is_right_is_none(sound, name):
    (checks,) = suites(sound, [{}], {})
    perform(checks, name)


def test_every_check_catches_a_mutant():
    checks = {name for suite in SUITES.values() for name in names_of(suite)}
    found = {name for row in FOUND for name in row["found_by"]}
    assert {*LIKELY} <= checks
    assert checks == found | {name for name, _, _ in MUTANTS}
