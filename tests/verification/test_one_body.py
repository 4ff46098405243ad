"""A ball that alone wears: exact on a foundation, a known limit on a half-space."""

import numpy as np
import pytest
from paper_models import (
    FOUNDATION,
    K,
    archard,
    case,
    flat,
    foundation,
    motion,
    named,
    paraboloid,
    steel,
)

from tribo import Grid, Simulation
from tribo.closed_forms import ball_wear, winkler
from tribo.stepping.implicit import Implicit


def ball_only(**changes):
    parts = {
        "grid": Grid((1.3e-3, 1.3e-3), (128, 128)),
        "bodies": [named("ball", paraboloid(), steel(), archard()), named("disk", flat(), steel())],
        "kinematics": motion(duration=3600),
    }
    return Simulation(case(**{**parts, **changes})).run()


@pytest.fixture(scope="module")
def on_foundation():
    return ball_only(
        contact=foundation(),
        save_times=(10, 200),
        stepping=Implicit(pressure_tolerance=0.01, depth_tolerance=1e-4),
    )


@pytest.mark.parametrize("save", [1, 2, 3])
def test_the_foundation_follows_its_exact_worn_solution(on_foundation, save):
    row = on_foundation.saves()[save]
    s = row["distance_m"]
    values = {
        "load": 100,
        "radius": 5e-3,
        "stiffness": FOUNDATION,
        "wear_coefficient": K,
    }
    half_width = winkler.worn_sphere_half_width(s, **values)
    # The area is counted in cells; its edge is good to a part of one.
    assert np.sqrt(row["contact_area_m2"] / np.pi) == pytest.approx(half_width, rel=5e-3)
    # Backward Euler at these tolerances lags by less than 1 %.
    exact = winkler.worn_sphere_pressure(0.0, s, **values)
    assert row["centre_pressure_Pa"] == pytest.approx(exact, rel=0.01)
    # a = √(2Rδ): the approach is that of the unworn ball's cap.
    assert row["approach_m"] == pytest.approx(half_width**2 / (2 * 5e-3), rel=1e-3, abs=0)


def test_the_error_of_a_step_is_of_first_order():
    exact = winkler.worn_sphere_pressure(
        0.0, 20.0, load=100, radius=5e-3, stiffness=FOUNDATION, wear_coefficient=K
    )
    errors = []
    for tolerance in (0.08, 0.04, 0.02):
        run = ball_only(
            contact=foundation(),
            grid=Grid((0.7e-3, 0.7e-3), (200, 200)),
            kinematics=motion(duration=200),
            stepping=Implicit(pressure_tolerance=tolerance, depth_tolerance=0.1, settle=1.0),
        )
        errors.append(run.saves()[-1]["centre_pressure_Pa"] / exact - 1)
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    # Halved tolerances halve the increments, and backward Euler's error with them.
    assert np.all(np.array(errors) > 0)
    assert np.all((orders > 0.8) & (orders < 1.25))


def test_the_half_space_tends_to_the_rigid_limit_and_to_argatovs():
    result = ball_only(grid=Grid((1.2e-3, 1.2e-3), (96, 96)), save_times=(500,))
    hertz = 148.837e-6
    for save in result.saves()[1:]:
        s = save["distance_m"]
        argatov = ball_wear.elastic_ball_half_width(
            s, load=100, radius=5e-3, wear_coefficient=K, initial_half_width=hertz
        )
        counted = np.sqrt(save["contact_area_m2"] / np.pi)
        assert counted == pytest.approx(argatov, rel=0.015)
    rigid = ball_wear.ball(360.0, load=100, radius=5e-3, wear_coefficient=K)
    # 26.698 µm rigid; an independent elastic run gave 26.509 µm.
    assert save["bodies"]["ball"]["centre_wear_depth_m"] == pytest.approx(26.509e-6, rel=3e-3)
    assert save["bodies"]["ball"]["centre_wear_depth_m"] == pytest.approx(rigid.depth, rel=0.01)
