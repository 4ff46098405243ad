"""The rigid-limit ball on a track, against known figures and two brute-force runs."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tribo.closed_forms import ball_wear
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
    alone = ball_wear.ball(s, load=100.0, radius=5e-3, wear_coefficient=3.11e-16)
    assert worn.half_width_along == pytest.approx(alone.half_width, rel=1e-10, abs=0)
    assert worn.half_width_across == pytest.approx(alone.half_width, rel=1e-10, abs=0)
    assert worn.centre_pressure[1:] == pytest.approx(alone.pressure[1:], rel=1e-10)
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


def test_against_a_run_that_knows_only_gaps_and_archard():
    """Backward Euler on a plane of points, nothing assumed about the pressure's shape.

    In the rigid limit every point with pressure closes its gap within the step,
    k_b Δs p + (k_f Δs/ℓ) ∫ p dx = δ − gap; elsewhere the right side is smaller.
    """
    n, size = 60, 0.66e-3
    x = (np.arange(n) + 0.5) * size / n
    dx = x[1] - x[0]
    k, length, load = 3.11e-16, 2e-3, 100.0
    gap = (x[:, None] ** 2 + x[None, :] ** 2) / 1e-2
    ball, flat = np.zeros((n, n)), np.zeros(n)
    saves = np.geomspace(1e-3, 360.0, 90)

    def pressure(approach, step, worn):
        # Rows are independent: their line load P is the fixed point of a falling function.
        low, high = np.zeros(n), np.full(n, approach * length / (k * step))
        for _ in range(45):
            row = 0.5 * (low + high)
            p = np.maximum(approach - worn - k * step / length * row, 0.0) / (k * step)
            larger = 2 * dx * p.sum(axis=0) > row
            low, high = np.where(larger, row, low), np.where(larger, high, row)
        return p

    approach, before = 0.0, 0.0
    for s in saves:
        step = s - before
        worn = gap + ball + flat
        low, high = 0.0, approach + 5e-6
        for _ in range(40):
            approach = 0.5 * (low + high)
            p = pressure(approach, step, worn)
            low, high = (approach, high) if 4 * dx * dx * p.sum() < load else (low, approach)
        ball += k * step * p
        flat += k * step / length * 2 * dx * p.sum(axis=0)
        before = s
    worn = ball_on_track([360.0], **EQUAL)
    # The volume is exact whatever the step; cells of 11 µm leave 2e-4 in the shape.
    assert ball[0, 0] == pytest.approx(worn.ball_depth[0], rel=1e-3)
    assert flat[0] == pytest.approx(worn.flat_depth[0], rel=1e-3)
    along = np.count_nonzero(p[:, 0] > 0) * dx
    across = np.count_nonzero(p[0] > 0) * dx
    assert along == pytest.approx(worn.half_width_along[0], abs=dx)
    assert across == pytest.approx(worn.half_width_across[0], abs=dx)
    # Uniform along x, as the closed form finds, where the row has not just grown.
    inner = p[: int(0.7 * along / dx), 0]
    assert np.ptp(inner) / inner.mean() < 1e-6
    # Backward Euler lags by about Δs/4s, with steps of 13 % of s.
    assert inner[0] == pytest.approx(worn.centre_pressure[0], rel=0.05)


def test_order_and_shape_of_the_distances():
    forward = ball_on_track([20.0, 360.0], **EQUAL)
    backward = ball_on_track([360.0, 20.0], **EQUAL)
    assert np.array_equal(forward.flat_depth, backward.flat_depth[::-1])
    assert ball_on_track(20.0, **EQUAL).flat_depth.shape == (1,)
