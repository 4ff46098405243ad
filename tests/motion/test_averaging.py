"""What the stroke average costs, as a motion states it, against runs of a moving contact."""

import numpy as np
import pytest
from paper_models import K, archard, case, flat, last, motion, named, steel

from tribo import Cylinder, Grid, Implicit
from tribo.core.errors import CaseError
from tribo.motion.averaging_error import groove_excess
from tribo.motion.closed_track import Unidirectional
from tribo.simulation.positions import composed
from tribo.simulation.validity import track_average


def stroke(value="2 mm", **more):
    return motion(stroke=value, duration="1 h", **more)


@pytest.mark.parametrize(
    ("stroke", "deep", "found"),
    [(2.25, 0.26, 17.2), (3.88, 0.2, 6.1), (5.75, 0.14, 2.4), (4.44, 0.6, 13)],
)
def test_a_ball_that_wears_ten_times_faster_makes_shallow_grooves_too_deep(stroke, deep, found):
    # Strokes in half-widths and grooves in approaches, from `compared` in the benchmark.
    stated = 100 * groove_excess(stroke, 1.0, deep, 1.0, volume_ratio=10.0)
    assert stated == pytest.approx(found, abs=1.5)


def line(length, distance, wears, positions):
    """A cylinder on a flat, which wear by these coefficients."""
    names = [("cylinder", Cylinder(radius="5 mm")), ("flat", flat())]
    kinematics = {"stroke": length, "duration": None, "distance": distance}
    return case(
        grid=Grid((0.8e-3, 1e-3), (64, 2)),
        ends_at_window=True,
        bodies=[
            named(*body, steel(), archard(k) if k else None)
            for body, k in zip(names, wears, strict=True)
        ],
        kinematics=motion(**kinematics, positions=positions),
        stepping=Implicit(depth_tolerance=0.01, pressure_tolerance=0.1, settle=0.1),
    )


def along(*given):
    """Model and end of such a run, and the depth of its groove at mid-stroke."""
    model = composed(line(*given))
    state = last(model)
    wear = state.bodies["flat"].wear
    middle = slice((len(wear) - 1) // 2, len(wear) // 2 + 1)
    return model, state, np.max(np.mean(wear[middle], axis=0))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("length", "distance", "wears", "is_cheap"),
    [
        (2.0e-3, 50, (K, K), True),
        (1.5e-3, 60, (K, 10 * K), False),
        (2.5e-3, 1000, (0, K), True),
    ],
)
def test_of_a_line_the_formula_tells_where_the_average_costs_little(
    length, distance, wears, is_cheap
):
    # At 4 to 33 half-widths, with grooves of 0.4 to 6 times the approach.
    model, state, averaged = along(length, distance, wears, "average")
    stated = groove_excess(length, *track_average(model, state))
    *_, resolved = along(length, distance, wears, 2 * round(length / 60e-6) + 1)
    found = averaged / resolved - 1
    assert (found < 0.01) == (stated < 0.01) == is_cheap
    assert 0.8 * found < stated < 3 * found + 0.005


def test_a_shallow_groove_is_average_down_to_strokes_of_two_half_widths_only():
    assert groove_excess(3.0, 1.0, 1e-9, 1.0) < 0.01
    assert groove_excess(1.0, 1.0, 1e-9, 1.0) == pytest.approx(0.6, abs=0.1)
    assert groove_excess(0.3, 1.0, 1e-9, 1.0) > 3


def test_a_stroke_under_one_half_width_is_refused_with_a_remedy():
    with pytest.raises(CaseError, match=r"^kinematics\.stroke: 0\.1 mm is shorter") as refused:
        stroke("0.1 mm").check_contact(0.15e-3)
    assert 'at least 0.15 mm, or resolve it by kinematics.positions = "auto"' in str(refused.value)
    stroke("0.16 mm").check_contact(0.15e-3)


def test_a_closed_track_under_one_half_width_is_refused():
    with pytest.raises(CaseError, match=r"0\.1 mm long, .*0\.15 mm.* 0\.3 mm"):
        Unidirectional(speed=0.1, distance=1, track_length=1e-4).check_contact(0.15e-3)
