"""The example that runs the paper's case both ways; `verification/test_paper` has its table."""

import pytest

# The first contact, which the explicit steps leave at once, is of few cells.
pytestmark = pytest.mark.filterwarnings("ignore:resolution")

SHORT = ("grid.cells=32", "kinematics.duration='100 s'", "output.save_times=[0, 100]")


@pytest.fixture(scope="module")
def paper(example):
    return example


@pytest.fixture(scope="module")
def implicit(paper):
    return paper.run(*paper.COARSE, *paper.IMPLICIT, *SHORT)


@pytest.mark.slow
def test_the_papers_explicit_steps_agree_with_implicit_ones(paper, implicit):
    explicit = paper.run(*paper.COARSE, *paper.EXPLICIT, *SHORT)
    assert explicit.totals()["steps"] == 400
    for body in ("ball", "disk"):
        assert 0 < paper.difference(implicit, explicit, body) < 0.005


@pytest.mark.slow
def test_side_by_side_has_a_row_a_table_for_each_quantity(paper, implicit):
    text = paper.side_by_side({"expected": paper.EXPECTED, "mine": paper.table(implicit)})
    assert text.count("  mine") == len(paper.EXPECTED) - 1
    assert "5.660" in text
