"""Positions along a stroke: a quadrature whose nodes lie at whole cells."""

import numpy as np
import pytest
from paper_models import case, motion, small

from tribo import CaseError, Grid, Reciprocating
from tribo.config.load import validate_case
from tribo.motion.exposure import Passing
from tribo.motion.stroke import Stroke
from tribo.simulation.march import begin


def test_every_cell_of_the_stroke_is_a_position():
    np.testing.assert_array_equal(Stroke(6e-4, 1e-4).cells, np.arange(-3, 4))
    # More positions than there are cells would stand twice in one.
    np.testing.assert_array_equal(Stroke(6e-4, 1e-4, 99).cells, np.arange(-3, 4))


@pytest.mark.parametrize(
    ("stroke", "positions"),
    # With the last two positions a cell apart, and 1.5e-9 cells over a whole number of them.
    [(2e-3, 5), (64.3e-5, 33), (64.3e-5, 65), (64e-5 + 1.5e-14, "cells"), (2.5e-5, 3)],
)
def test_a_sine_takes_half_a_cycle_for_its_stroke(stroke, positions):
    sine = motion(stroke=stroke, waveform="sinusoidal", positions=positions)
    cycle = sine.cycle(Grid(64e-5, 64))
    assert sum(p.share for p in cycle) == pytest.approx(1, abs=1e-14)
    speeds = [p.speeds[0][0] for p in cycle]
    assert min(speeds) > 0
    assert speeds == pytest.approx(speeds[::-1], rel=1e-10, abs=0)
    # Mean speed 2 S f.
    pace = sum(p.share * share / speed for p in cycle for speed, share in p.speeds)
    assert pace == pytest.approx(1 / (2 * stroke * 25), rel=1e-10)


def test_a_passing_body_has_the_rows_of_all_its_positions():
    grid = Grid(1e-3, 10)
    exposures = Reciprocating(stroke="0.4 mm", frequency=25, cycles=1, positions="cells").exposures(
        grid, ["ball", "disk"]
    )
    disk = exposures["disk"]
    assert isinstance(disk, Passing)
    assert (disk.rows, disk.starts) == (14, (4, 3, 2, 1, 0))
    assert disk.volume(np.ones((14, 10))) == pytest.approx(1.4e-6)
    assert exposures["ball"].starts is None


def test_positions_that_cannot_serve_the_contact_are_refused():
    kinematics = motion(stroke="2 mm", positions=9)
    # A half-width of 0.2 mm.
    with pytest.raises(CaseError, match=r"kinematics\.positions: 9 .* 0.3 mm apart.*at least 21"):
        begin(small(grid=Grid((2e-3, 2e-3), (20, 20)), kinematics=kinematics))


@pytest.mark.parametrize("given", [4, 1, "all", 2.5])
def test_positions_are_an_odd_number_or_a_word(given):
    motion = {"type": "reciprocating", "stroke": 2e-3, "frequency": 25, "cycles": 1}
    with pytest.raises(CaseError, match=r"kinematics\.positions"):
        validate_case(case().model_dump() | {"kinematics": motion | {"positions": given}})
