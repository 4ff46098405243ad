"""What the stroke average costs, as a motion states it, against runs of a moving contact."""

import pytest
from paper_models import motion, small

from tribo.core.errors import CaseError
from tribo.motion.averaging_error import groove_excess
from tribo.motion.closed_track import Unidirectional
from tribo.simulation.march import begin


@pytest.mark.parametrize(
    ("stroke", "deep", "found"),
    [(2.25, 0.26, 17.2), (3.88, 0.2, 6.1), (5.75, 0.14, 2.4), (4.44, 0.6, 13)],
)
def test_a_ball_that_wears_ten_times_faster_makes_shallow_grooves_too_deep(stroke, deep, found):
    # Strokes in half-widths and grooves in approaches, from `compared` in the benchmark.
    stated = 100 * groove_excess(stroke, 1.0, deep, 1.0, volume_ratio=10.0)
    assert stated == pytest.approx(found, abs=1.5)


@pytest.mark.parametrize(
    ("stroke", "deep", "ratio", "found"),
    [(8.42, 0.382, 1, 0.02), (6, 6.1, 0.1, 11.8), (33.3, 6.1, 0, 0.05)],
)
def test_of_a_cylinder_the_formula_tells_where_the_average_costs_little(stroke, deep, ratio, found):
    # In the same units, by a cylinder on a flat with positions 60 µm apart.
    stated = 100 * groove_excess(stroke, 1.0, deep, 1.0, ratio, line=True)
    assert 0.8 * found < stated < 3 * found + 0.5


def test_a_shallow_groove_is_average_down_to_strokes_of_two_half_widths_only():
    assert groove_excess(3.0, 1.0, 1e-9, 1.0) < 0.01
    assert groove_excess(1.0, 1.0, 1e-9, 1.0) == pytest.approx(0.6, abs=0.1)
    assert groove_excess(0.3, 1.0, 1e-9, 1.0) > 3


@pytest.mark.parametrize(
    "kinematics",
    [
        motion(stroke="0.1 mm", positions="average"),
        Unidirectional(speed=0.1, distance=1, track_length="0.1 mm"),
    ],
)
def test_a_track_under_one_half_width_is_not_averaged(kinematics):
    with pytest.raises(CaseError, match=r"0\.1 mm, less than the half-width") as refused:
        begin(small(kinematics=kinematics))
    assert refused.value.path == "kinematics"
