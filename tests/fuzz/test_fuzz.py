"""A few of the fuzzed cases; the long run of them is a command."""

import os
import random
import time
import tomllib

import pytest
from fuzz import fuzzing
from fuzz.generate import mutated, plausible, toml, valid_cases
from fuzz.trial import schema

from tribo import CaseError
from tribo.config.load import validate_case


def test_two_hundred_cases_end_as_they_should():
    done = fuzzing.fuzz(200, seed=3)
    assert done.faults == {}
    assert done.figures()["cases"] == 200
    # Enough of them ran, and were refused.
    assert min(done.figures()["exit codes"][code] for code in ("0", "2")) > 20


def test_a_case_is_repeatable():
    chances = [random.Random("1/7") for _ in range(2)]
    first, second = (mutated(valid_cases()[0], schema(), chance) for chance in chances)
    assert toml(first) == toml(second)


def test_what_is_written_is_what_was_made():
    chance = random.Random(1)
    for _ in range(50):
        case = plausible(chance.choice(valid_cases()), chance)
        assert tomllib.loads(toml(case)) == case


def test_half_of_the_plausible_cases_are_valid():
    chance, valid = random.Random(1), 0
    for _ in range(100):
        try:
            validate_case(plausible(chance.choice(valid_cases()), chance))
        except CaseError:
            continue
        valid += 1
    assert valid > 50


def hanging(pipe, seed, folder):
    pipe.recv()
    time.sleep(60)


def dying(pipe, seed, folder):
    pipe.recv()
    os._exit(1)


@pytest.mark.parametrize(("work", "words"), [(hanging, "hang"), (dying, "death")])
def test_a_hang_and_a_death_are_seen(monkeypatch, work, words):
    monkeypatch.setattr(fuzzing, "work", work)
    monkeypatch.setattr(fuzzing, "HANG", 3.0)
    monkeypatch.setattr(fuzzing, "START", "fork")
    done = fuzzing.fuzz(2, seed=1, workers=1)
    assert [fault.split(":")[0] for fault in done.faults.values()] == [words, words]
    assert (done.hangs, done.deaths) == ((2, 0) if words == "hang" else (0, 2))
