"""A ball worn alone, against known figures and the volume of its cap."""

import numpy as np
import pytest

from tribo.closed_forms import ball_wear

CASE = {"load": 100.0, "radius": 5e-3, "wear_coefficient": 3.11e-16}


def test_ball_has_the_known_values():
    worn = ball_wear.ball(360.0, **CASE)
    assert worn.half_width * 1e6 == pytest.approx(516.7, abs=0.05)
    assert worn.depth * 1e6 == pytest.approx(26.698, abs=0.0005)
    assert worn.pressure / 1e6 == pytest.approx(119.23, abs=0.005)


def test_the_face_holds_the_worn_volume():
    # With p = F/A that is Archard's law too: dh/ds = kp follows from dV = A dh.
    s = np.array([0.0, 1.0, 30.0])
    ball = ball_wear.ball(s, **CASE)
    volume = np.pi / 2 * ball.half_width**2 * ball.depth
    assert volume == pytest.approx(3.11e-16 * 100.0 * s, rel=1e-12, abs=0)
    assert np.isinf(ball.pressure[0])
