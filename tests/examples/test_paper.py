"""The example that runs the paper's case both ways; the case `paper_hour` has its table."""

import pytest

SHORT = ("grid.cells=32", "kinematics.duration='100 s'", "output.save_times=[0, 100]")


@pytest.mark.slow
# The first contact, which the explicit steps leave at once, is of few cells.
@pytest.mark.filterwarnings("ignore:resolution")
def test_the_papers_explicit_steps_agree_with_implicit_ones(example):
    implicit, explicit = (
        example.run(*example.COARSE, *steps, *SHORT)
        for steps in (example.IMPLICIT, example.EXPLICIT)
    )
    assert explicit.totals()["steps"] == 400
    for body in ("ball", "disk"):
        assert 0 < example.difference(implicit, explicit, body) < 0.005
