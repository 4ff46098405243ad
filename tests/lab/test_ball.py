"""What a ball has lost by its scar, against integrals of the shapes the formulas stand for."""

import numpy as np
import pytest
from scipy.integrate import quad

from tribo.closed_forms.ball_on_track import ball_on_track
from tribo.lab import ball

R = 5e-3


@pytest.mark.parametrize("d", [1e-6, 1e-3, 2e-3, 9e-3])
def test_cap_volume_is_that_of_a_body_of_revolution(d):
    h = ball.ball_cap_depth(d, R)
    # z runs down from the pole; the section there has radius² z(2R − z).
    volume, _ = quad(lambda z: np.pi * z * (2 * R - z), 0.0, h)
    assert h * (2 * R - h) == pytest.approx(d**2 / 4, rel=1e-12, abs=0)
    assert ball.ball_cap_volume(d, R) == pytest.approx(volume, rel=1e-10, abs=0)
    assert ball.cap_diameter(volume, R) == pytest.approx(d, rel=1e-9, abs=0)


def test_shallow_form_falls_short_by_its_next_term():
    for d, part in ((1e-3, 0.0033), (2e-3, 0.0133)):
        shortfall = 1 - ball.shallow_cap_volume(d, R) / ball.ball_cap_volume(d, R)
        assert shortfall == pytest.approx(part, abs=2e-4)


def test_conforming_volume_by_how_much_the_flat_cap_overstates():
    d = 1e-3
    for curved, times in ((6e-3, 6.0), (8e-3, 8 / 3)):
        ratio = ball.shallow_cap_volume(d, R) / ball.conforming_ball_volume(d, d, R, curved)
        assert ratio == pytest.approx(times, rel=1e-9)


def test_conforming_volume_of_a_scar_flat_along_the_track():
    """The paraboloid between ball and parabolic groove, integrated: d⊥/d∥ times the formula."""
    curved, across = 20e-3, 1e-3
    along = across * np.sqrt(1 - R / curved)
    n = 1000
    x = (np.arange(n) + 0.5) / n * along / 2
    y = (np.arange(n) + 0.5) / n * across / 2
    depth = along**2 / 8 / R - x[:, None] ** 2 / 2 / R - y**2 / 2 * (1 / R - 1 / curved)
    volume = 4 * np.sum(np.maximum(depth, 0)) * (x[1] - x[0]) * (y[1] - y[0])
    formula = ball.conforming_ball_volume(along, across, R, curved)
    # A midpoint sum of a thousand cells a side errs by about 1e-6.
    assert volume == pytest.approx(formula * across / along, rel=1e-5, abs=0)
    assert volume == pytest.approx(ball.flat_along_ball_volume(along, across, R), rel=1e-5, abs=0)


@pytest.mark.parametrize(
    ("k_flat", "low", "within"),
    [(0.0, 0.0, 1e-9), (3.11e-16, 0.03, 5e-3), (1e-10, 1 - 9 * np.pi / 32, 1e-3)],
)
def test_volume_of_a_scar_flat_along_the_track_in_the_rigid_limit(k_flat, low, within):
    worn = ball_on_track(
        [360.0],
        load=100.0,
        radius=R,
        track_length=2e-3,
        ball_wear_coefficient=3.11e-16,
        flat_wear_coefficient=k_flat,
    )
    along, across = 2 * worn.half_width_along[0], 2 * worn.half_width_across[0]
    volume = ball.flat_along_ball_volume(along, across, R)
    assert 1 - volume / worn.ball_volume[0] == pytest.approx(low, abs=within)
