"""Strokes and tracks that are too short for their average."""

import pytest
from paper_models import motion

from tribo.core.errors import CaseError
from tribo.motion.closed_track import Unidirectional


def stroke(value="2 mm", **more):
    return motion(stroke=value, duration="1 h", **more)


@pytest.mark.parametrize(
    ("given", "half_width", "warns"),
    [
        ({"positions": "average"}, 0.19e-3, False),
        ({"positions": "average"}, 0.21e-3, True),
        ({"positions": 33}, 0.5e-3, False),
    ],
)
def test_an_averaged_stroke_warns_below_5_lengths_of_the_contact(given, half_width, warns):
    assert (stroke(**given).limitation(half_width) is not None) == warns


def test_a_stroke_under_one_half_width_is_refused_with_a_remedy():
    with pytest.raises(CaseError, match=r"^kinematics\.stroke: 0\.1 mm is shorter") as refused:
        stroke("0.1 mm").check_contact(0.15e-3)
    assert "at least 0.15 mm" in str(refused.value)
    assert "kinematics.allow_short_stroke = true" in str(refused.value)
    stroke("0.16 mm").check_contact(0.15e-3)
    stroke("0.1 mm", allow_short_stroke=True).check_contact(0.15e-3)


@pytest.mark.parametrize(
    ("track", "place"), [({"track_length": 1e-4}, "length"), ({"track_radius": 1e-5}, "radius")]
)
def test_a_closed_track_under_one_half_width_is_refused(track, place):
    given = {"speed": 0.1, "distance": 1, **track}
    with pytest.raises(CaseError, match=rf"^kinematics\.track_{place}: "):
        Unidirectional(**given).check_contact(0.15e-3)
