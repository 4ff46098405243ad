"""Bodies worn alone, against known figures and the volumes of their caps."""

import numpy as np
import pytest

from tribo.closed_forms import ball_wear, winkler

CASE = {"load": 100.0, "radius": 5e-3, "wear_coefficient": 3.11e-16}


def test_ball_has_the_known_values():
    worn = ball_wear.ball(360.0, **CASE)
    assert worn.half_width * 1e6 == pytest.approx(516.7, abs=0.05)
    assert worn.depth * 1e6 == pytest.approx(26.698, abs=0.0005)
    assert worn.pressure / 1e6 == pytest.approx(119.23, abs=0.005)


def test_unworn_ball_touches_in_a_point():
    worn = ball_wear.ball([0.0, 1.0], **CASE)
    assert worn.half_width[0] == 0.0
    assert np.isinf(worn.pressure[0])


def test_faces_hold_the_worn_volume():
    s = np.array([1.0, 30.0])
    volume = ball_wear.worn_volume(s, load=100.0, wear_coefficient=3.11e-16)
    ball = ball_wear.ball(s, **CASE)
    assert np.pi / 2 * ball.half_width**2 * ball.depth == pytest.approx(volume, rel=1e-12, abs=0)
    cone = ball_wear.cone(s, load=100.0, semi_angle=1.4, wear_coefficient=3.11e-16)
    assert np.pi / 3 * cone.half_width**2 * cone.depth == pytest.approx(volume, rel=1e-12, abs=0)
    line = ball_wear.cylinder(s, line_load=100.0, radius=5e-3, wear_coefficient=3.11e-16)
    assert 4 / 3 * line.half_width * line.depth == pytest.approx(volume, rel=1e-12, abs=0)
    pin = ball_wear.flat_pin_depth(s, load=100.0, area=2e-6, wear_coefficient=3.11e-16)
    assert pin * 2e-6 == pytest.approx(volume, rel=1e-12, abs=0)


@pytest.mark.parametrize(
    "face",
    [
        lambda s: ball_wear.ball(s, **CASE),
        lambda s: ball_wear.cone(s, load=100.0, semi_angle=1.4, wear_coefficient=3.11e-16),
        lambda s: ball_wear.cylinder(s, line_load=1e5, radius=5e-3, wear_coefficient=3.11e-16),
    ],
)
def test_depth_grows_by_archards_law(face):
    ahead, behind, now = face(10.001), face(9.999), face(10.0)
    # A central difference over 2e-4 of s is good to 1e-8; round-off takes some of that.
    slope = (ahead.depth - behind.depth) / 0.002
    assert slope == pytest.approx(3.11e-16 * now.pressure, rel=1e-7, abs=0)


def test_elastic_ball_is_the_winkler_ball_of_the_same_start():
    stiffness = 1.2973e15
    a0 = winkler.sphere(100.0, 5e-3, stiffness).half_width
    s = np.array([0.0, 1.0, 360.0])
    argatov = ball_wear.elastic_ball_half_width(s, initial_half_width=a0, **CASE)
    exact = winkler.worn_sphere_half_width(s, stiffness=stiffness, **CASE)
    assert argatov == pytest.approx(exact, rel=1e-12, abs=0)
