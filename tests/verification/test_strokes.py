"""The references of the track average wear as deep as the cases that people run."""

import numpy as np
import pytest

from tribo.contact.dcfft import DcFft
from tribo.verification import strokes
from tribo.verification.moving import to_and_fro
from tribo.verification.paper_bodies import BALL, WEAR_COEFFICIENT, on_flat

K = WEAR_COEFFICIENT


@pytest.mark.slow
def test_the_groove_on_the_ring_is_several_times_as_deep_as_the_elastic_approach():
    _, state = strokes._ring_average()
    assert state.bodies["flat"].wear.max() > 3 * state.reference_depth


def test_a_moved_contact_wears_what_archard_says_and_both_bodies_symmetrically():
    grid = strokes.STROKE_GRID
    model = on_flat(BALL, grid, DcFft(tolerance=1e-6))
    moved = to_and_fro(model, K, 2 * K, stroke=20, distance=30.0, passes=4)
    volume = K * 100.0 * 30.0
    assert np.sum(moved.ball) * grid.cell_area == pytest.approx(volume, rel=1e-9, abs=0)
    assert np.sum(moved.flat) * grid.cell_area == pytest.approx(2 * volume, rel=1e-9, abs=0)
    for depth in (moved.ball, moved.flat):
        np.testing.assert_allclose(depth, depth[::-1], rtol=0, atol=1e-12)
