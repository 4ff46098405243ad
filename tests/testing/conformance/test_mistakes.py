"""The mistakes that authors make are found; which check finds each is in the docs."""

import json

import pytest
from testing.conformance.found import TABLE
from testing.conformance.mistakes import HONEST, MISTAKES, configuration

from tribo.registry import child
from tribo.testing import check
from tribo.testing.kit import outcome_of, suites

FOUND = json.loads(TABLE.read_text("utf-8"))
ENDS = ("crashed the process", "did not end")


@pytest.mark.parametrize("model", HONEST)
def test_a_sound_model_conforms(model):
    report = check(model, [configuration(model)])
    assert report.ok, report


def test_the_table_has_them_all_and_95_percent_are_found():
    assert {row["mistake"] for row in FOUND} == set(MISTAKES)
    assert sum(bool(row["found_by"]) for row in FOUND) >= 0.95 * len(FOUND) >= 0.95 * 40


@pytest.mark.parametrize(
    "row",
    [
        pytest.param(
            row, id=row["mistake"], marks=pytest.mark.slow if row["ends_the_process"] else ()
        )
        for row in FOUND
    ],
)
@pytest.mark.filterwarnings("ignore")
def test_a_mistake_is_found(row, monkeypatch):
    cls = MISTAKES[row["mistake"]]
    (checks,) = suites(cls, [configuration(cls)])
    if row["ends_the_process"]:
        monkeypatch.setattr(child, "TIMES", 1)
        outcomes, ended = child.in_child(outcome_of, [(checks, row["found_by"][0])])
        assert not outcomes
        assert any(end in ended for end in ENDS)
        return
    for name in row["found_by"][:1]:
        outcome = outcome_of(checks, name)
        assert outcome.status == "failed"
        assert "NameError" not in outcome.message
