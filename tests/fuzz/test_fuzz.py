"""A few of the fuzzed cases; the long run of them is a command."""

import random

import pytest
from fuzz import fuzzing, trial
from fuzz.generate import plausible, valid_cases

from tribo import CaseError
from tribo.config.load import validate_case


@pytest.mark.slow
def test_some_cases_of_each_kind_end_as_they_should():
    done = fuzzing.fuzz(len(trial.KINDS), seed=4, workers=1)
    assert done.faults == {}
    # Those that were stopped on a busy machine, with 130, are counted apart.
    codes = done.figures()["exit codes"]
    assert codes["0"] > 1
    assert codes["2"] > 5


def test_half_of_the_plausible_cases_are_valid():
    chance, valid = random.Random(1), 0
    for _ in range(100):
        try:
            validate_case(plausible(chance.choice(valid_cases()), chance))
        except CaseError:
            continue
        valid += 1
    assert valid > 50
