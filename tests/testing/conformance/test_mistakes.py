"""The mistakes that authors make are found; which check finds each is in the docs."""

import json
from pathlib import Path

import pytest
from testing.conformance.honest import HONEST
from testing.conformance.honest_effects import EFFECTS
from testing.conformance.honest_laws import LAWS
from testing.conformance.mistakes import MISTAKES, configuration

from tribo.testing import check
from tribo.testing.kit import _outcome, outcome_of, suites

FOUND = json.loads((Path(__file__).parents[3] / "docs/_data/mistakes.json").read_text("utf-8"))
ENDS = ("crashed the process", "did not end")


@pytest.mark.parametrize("model", [*HONEST, *LAWS, *EFFECTS])
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
    (checks,) = suites(cls, [configuration(cls)], {})
    if row["ends_the_process"]:
        monkeypatch.setenv("TRIBO_PLUGIN_TIME_LIMIT", "0.7")
        outcome = outcome_of(checks, row["found_by"][0])
        assert any(end in outcome.message for end in ENDS)
        return
    for name in row["found_by"][:1]:
        assert _outcome(checks, name).status == "failed"
