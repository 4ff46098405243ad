"""Numbers at module level that decide something are few, and each has its source."""

from benchmarks.studies.deciding_numbers import numbers

BUDGET = 300


def test_numbers_that_decide_are_within_their_budget():
    assert len(numbers()) <= BUDGET


def test_each_number_has_its_source():
    assert not [f"{number.path}: {number.name}" for number in numbers() if not number.note]
