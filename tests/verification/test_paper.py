"""The paper's hour against an independent elastic computation and the rigid limit.

The expected table was computed apart from this code, with an elastic
backward-Euler scheme on 128² to 192² cells. Its own accuracy is about 0.3 %
in depth, 1 % in centre pressure, one cell in half-width and, at the edge
where the grid shows, 4 % in the largest pressure.
"""

import tomllib

import pytest

from tribo import Simulation
from tribo.closed_forms.ball_on_track import track_profile
from tribo.templates import template

pytestmark = pytest.mark.slow

K = 3.11e-16
# s: half-widths along and across in m, centre and largest pressure in Pa,
# depths of ball and disk in m
EXPECTED = {
    0: (148.8e-6, 148.8e-6, 2155e6, 2155e6, 0.0, 0.0),
    200: (254e-6, 274e-6, 495e6, 495e6, 5.660e-6, 0.955e-6),
    500: (315e-6, 342e-6, 300e6, 330e6, 9.142e-6, 1.896e-6),
    1500: (406e-6, 455e-6, 167e6, 207e6, 15.84e-6, 4.252e-6),
    3600: (496e-6, 569e-6, 106e6, 143e6, 24.31e-6, 8.040e-6),
}


@pytest.fixture(scope="module")
def result():
    case = tomllib.loads(template("ball_on_disk"))
    case["grid"].update(size="2 mm", cells=160)
    return Simulation(case).run()


def test_the_table_holds_at_every_save(result):
    cell = result.grid.spacing[0]
    saves = result.saves()
    assert [save["time_s"] for save in saves] == list(EXPECTED)
    for save, expected in zip(saves, EXPECTED.values(), strict=True):
        along, across, centre, highest, ball, disk = expected
        assert save["contact_half_width_x_m"] == pytest.approx(along, abs=1.5 * cell)
        assert save["contact_half_width_y_m"] == pytest.approx(across, abs=1.5 * cell)
        assert save["centre_pressure_Pa"] == pytest.approx(centre, rel=0.02)
        assert save["max_pressure_Pa"] == pytest.approx(highest, rel=0.05)
        worn = save["bodies"]
        assert worn["ball"]["centre_wear_depth_m"] == pytest.approx(ball, rel=5e-3, abs=0)
        assert worn["disk"]["max_wear_depth_m"] == pytest.approx(disk, rel=5e-3, abs=0)
        for body in worn.values():
            volume = K * 100 * save["distance_m"]
            assert body["wear_volume_m3"] == pytest.approx(volume, rel=1e-10, abs=0)
            assert body["max_plastic_depth_m"] == 0


def test_it_takes_few_solves(result):
    assert result.totals()["contact_solves"] <= 140


def test_the_ball_is_flat_along_and_curved_across(result):
    # As measured in the paper, figures 6 and 7 by their captions.
    ball = result.body("ball").surface(-1)
    n = ball.shape[0] // 2
    reach = round(0.4e-3 / result.grid.spacing[0])
    assert abs(ball[n, n] - ball[n + reach, n]) < 0.5e-6
    assert ball[n, n] - ball[n, n + reach] > 3e-6


def test_the_pressure_is_a_plateau_along_and_rises_to_the_edges_across(result):
    p = result.field("pressure", -1)
    n = p.shape[0] // 2
    at = round(0.4e-3 / result.grid.spacing[0])
    assert p[n + at, n] == pytest.approx(p[n, n], rel=0.05)
    # p ∝ 1/(1 + qb) in the rigid limit, with b the half-length of the contact at y.
    rigid = track_profile(
        [0.0, result.grid.y[n + at]],
        360.0,
        load=100,
        radius=5e-3,
        track_length=2e-3,
        ball_wear_coefficient=K,
        flat_wear_coefficient=K,
    ).pressure
    assert p[n, n + at] / p[n, n] == pytest.approx(rigid[1] / rigid[0], rel=0.02)
    assert rigid[1] / rigid[0] > 1.08
