"""The rigid-limit ball on a track: known figures, and rows integrated in time."""

import numpy as np
import pytest
from ball_on_track import ball_on_track
from scipy.integrate import solve_ivp

R = 5e-3
EQUAL = {
    "load": 100.0,
    "radius": R,
    "track_length": 2e-3,
    "ball_wear_coefficient": 3.11e-16,
    "flat_wear_coefficient": 3.11e-16,
}
WEIGHED = EQUAL | {
    "ball_wear_coefficient": 2.0e-6 / 7850 / (100 * 360),
    "flat_wear_coefficient": 0.2e-6 / 7850 / (100 * 360),
}


def half_lengths(y, distance, case):
    """Half-lengths b of the contact along the track: b² + ⅔ q b³ = c² - y²."""
    worn = ball_on_track(distance, **case)
    q = 2 * case["flat_wear_coefficient"] / case["ball_wear_coefficient"] / case["track_length"]
    b = worn.half_width_along * np.linspace(1, 0, 4001)
    outline = np.sqrt(np.maximum(worn.half_width_across**2 - b**2 - 2 / 3 * q * b**3, 0.0))
    return np.interp(np.abs(y), outline, b), q


def test_without_wear_of_the_flat_it_is_the_ball_alone():
    s = np.array([0.0, 1.0, 360.0])
    worn = ball_on_track(s, **EQUAL | {"flat_wear_coefficient": 0.0})
    alone = (4 * R * 3.11e-16 * 100 * s / np.pi) ** 0.25
    assert worn.half_width_along == pytest.approx(alone, rel=1e-10, abs=0)
    assert worn.half_width_across == pytest.approx(alone, rel=1e-10, abs=0)
    assert worn.centre_pressure[1:] == pytest.approx(100 / (np.pi * alone[1:] ** 2), rel=1e-10)
    assert np.all(worn.flat_depth == 0.0)


@pytest.mark.parametrize("case", [EQUAL, WEIGHED])
def test_against_the_rows_integrated_in_time(case):
    """Depth of every row as an ordinary differential equation in s, no closed form."""
    k_ball, k_flat = case["ball_wear_coefficient"], case["flat_wear_coefficient"]
    first, last = 20.0, 360.0
    y = (np.arange(2000) + 0.5) * 1.3e-3 / 2000
    dy = y[1] - y[0]
    start, worn = ball_on_track([first], **case), ball_on_track([last], **case)
    approach = start.half_width_across[0] ** 2 / (2 * R)
    b, q = half_lengths(y, first, case)

    def rates(_, state):
        b = np.sqrt(np.maximum(2 * R * (state[0] - state[1:]) - y**2, 0.0))
        share = k_ball + 2 * k_flat * b / case["track_length"]
        speed = case["load"] / np.sum(2 * dy * 2 * b / share)
        return np.concatenate([[speed], 2 * k_flat * b / case["track_length"] * speed / share])

    groove = q * b**3 / (3 * R)
    end = solve_ivp(rates, (first, last), [approach, *groove], rtol=1e-6, atol=1e-12).y[:, -1]
    # 3e-6 is what is left by rows of 0.65 µm, cut by the contact's border.
    assert end[1] == pytest.approx(worn.flat_depth[0], rel=2e-5)
    assert end[0] - end[1] == pytest.approx(worn.ball_depth[0], rel=2e-5)
    b, q = half_lengths(y, last, case)
    carried = 2 * np.sum(worn.peak_pressure / (1 + q * b) * 2 * b * dy)
    assert carried == pytest.approx(case["load"], rel=1e-4)
