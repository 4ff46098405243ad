"""The mistakes of physics in `mutants.toml` are found; what finds each is in the docs."""

import json

import pytest
from verification.found import TABLE, asked, copied, mutants, mutated

MUTANTS = {each["name"]: each for each in mutants()}
FOUND = json.loads(TABLE.read_text("utf-8"))


@pytest.mark.parametrize("mutant", MUTANTS.values(), ids=MUTANTS)
def test_a_mutant_has_a_place(mutant):
    assert mutated(mutant)


def test_a_case_finds_every_mutant():
    assert [row["mutant"] for row in FOUND] == list(MUTANTS)
    assert all("case" in row for row in FOUND)


@pytest.mark.slow
@pytest.mark.parametrize("row", FOUND[5::20], ids=lambda row: row["mutant"])
def test_a_mutant_is_found(tmp_path, row):
    environment = copied(tmp_path)
    (tmp_path / row["file"]).write_text(mutated(MUTANTS[row["mutant"]]), encoding="utf-8")
    assert asked(tmp_path, environment, row["case"])["quantity"] == row["quantity"]
