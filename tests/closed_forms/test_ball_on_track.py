"""The rigid-limit ball on a track: known figures, and rows integrated in time."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tribo.closed_forms.ball_on_track import ball_on_track, track_profile

EQUAL = {
    "load": 100.0,
    "radius": 5e-3,
    "track_length": 2e-3,
    "ball_wear_coefficient": 3.11e-16,
    "flat_wear_coefficient": 3.11e-16,
}
WEIGHED = EQUAL | {
    "ball_wear_coefficient": 2.0e-6 / 7850 / (100 * 360),
    "flat_wear_coefficient": 0.2e-6 / 7850 / (100 * 360),
}


def test_equal_wear_coefficients_have_the_known_values():
    worn = ball_on_track([360.0], **EQUAL)
    assert worn.half_width_along[0] * 1e6 == pytest.approx(494, abs=0.5)
    assert worn.half_width_across[0] * 1e6 == pytest.approx(570, abs=0.5)
    assert worn.ball_depth[0] * 1e6 == pytest.approx(24.44, abs=0.005)
    assert worn.flat_depth[0] * 1e6 == pytest.approx(8.06, abs=0.005)


def test_weighed_volumes_have_the_known_values():
    worn = ball_on_track([360.0], **WEIGHED)
    assert worn.half_width_along[0] * 1e3 == pytest.approx(1.116, abs=5e-4)
    # Known to a micrometre from a stepped solution: 1.157 against 1.1565.
    assert worn.half_width_across[0] * 1e3 == pytest.approx(1.157, abs=1e-3)
    assert worn.ball_depth[0] * 1e6 == pytest.approx(124.5, abs=0.05)
    assert worn.flat_depth[0] * 1e6 == pytest.approx(9.26, abs=0.005)


def test_without_wear_of_the_flat_it_is_the_ball_alone():
    s = np.array([0.0, 1.0, 360.0])
    worn = ball_on_track(s, **EQUAL | {"flat_wear_coefficient": 0.0})
    alone = (4 * 5e-3 * 3.11e-16 * 100 * s / np.pi) ** 0.25
    assert worn.half_width_along == pytest.approx(alone, rel=1e-10, abs=0)
    assert worn.half_width_across == pytest.approx(alone, rel=1e-10, abs=0)
    assert worn.centre_pressure[1:] == pytest.approx(100 / (np.pi * alone[1:] ** 2), rel=1e-10)
    assert np.all(worn.flat_depth == 0.0)


@pytest.mark.parametrize("case", [EQUAL, WEIGHED])
def test_profile_carries_the_load_and_holds_the_volumes(case):
    worn = ball_on_track([360.0], **case)
    c = worn.half_width_across[0]
    # y = c sin t: half-lengths vanish like cos t, so midpoint sums converge fast.
    t = (np.arange(2000) + 0.5) * np.pi / 2000 - np.pi / 2
    profile = track_profile(c * np.sin(t), 360.0, **case)
    dy = c * np.cos(t) * np.pi / 2000
    carried = np.sum(profile.pressure * 2 * profile.half_length * dy)
    ball = np.sum(2 / 3 * profile.half_length**3 / 5e-3 * dy)
    flat = np.sum(profile.flat_depth * dy) * 2e-3
    assert carried == pytest.approx(100.0, rel=1e-6)
    assert ball == pytest.approx(worn.ball_volume[0], rel=1e-6, abs=0)
    assert flat == pytest.approx(worn.flat_volume[0], rel=1e-6, abs=0)
    assert track_profile(1.01 * c, 360.0, **case).pressure == 0.0


@pytest.mark.parametrize("case", [EQUAL, WEIGHED])
def test_against_the_rows_integrated_in_time(case):
    """Depth of every row as an ordinary differential equation in s, no closed form."""
    load, radius, length = case["load"], case["radius"], case["track_length"]
    k_ball, k_flat = case["ball_wear_coefficient"], case["flat_wear_coefficient"]
    first, last = 20.0, 360.0
    y = (np.arange(2000) + 0.5) * 1.3e-3 / 2000
    dy = y[1] - y[0]
    start = ball_on_track([first], **case)
    approach = start.half_width_across[0] ** 2 / (2 * radius)
    groove = track_profile(y, first, **case).flat_depth

    def rates(_, state):
        b = np.sqrt(np.maximum(2 * radius * (state[0] - state[1:]) - y**2, 0.0))
        share = k_ball + 2 * k_flat * b / length
        speed = load / np.sum(2 * dy * 2 * b / share)
        return np.concatenate([[speed], 2 * k_flat * b / length * speed / share])

    end = solve_ivp(rates, (first, last), [approach, *groove], rtol=1e-6, atol=1e-12).y[:, -1]
    worn = ball_on_track([last], **case)
    # 3e-6 is what is left by rows of 0.65 µm, cut by the contact's border.
    assert end[1] == pytest.approx(worn.flat_depth[0], rel=2e-5)
    assert end[0] - end[1] == pytest.approx(worn.ball_depth[0], rel=2e-5)


def test_order_and_shape_of_the_distances():
    forward = ball_on_track([20.0, 360.0], **EQUAL)
    backward = ball_on_track([360.0, 20.0], **EQUAL)
    assert np.array_equal(forward.flat_depth, backward.flat_depth[::-1])
    assert ball_on_track(20.0, **EQUAL).flat_depth.shape == (1,)
