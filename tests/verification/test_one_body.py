"""A ball that alone wears, with steps of the error control: exact on a foundation, Argatov's law.

With equal steps both are rows of `tribo verify`.
"""

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

pytestmark = pytest.mark.slow

WORN = {"load": 100, "radius": 5e-3, "stiffness": FOUNDATION, "wear_coefficient": K}


def ball_only(**changes):
    bodies = [named("ball", paraboloid(), steel(), archard()), named("disk", flat(), steel())]
    return Simulation(case(bodies=bodies, **changes)).run().saves()[1:]


def test_the_foundation_follows_its_exact_worn_solution():
    saves = ball_only(
        grid=Grid((1.3e-3, 1.3e-3), (128, 128)),
        contact=foundation(),
        kinematics=motion(duration=3600),
        save_times=(10, 200),
        stepping=Implicit(pressure_tolerance=0.01, depth_tolerance=1e-4),
    )
    for row in saves:
        half_width = winkler.worn_sphere_half_width(row["distance_m"], **WORN)
        # The area is counted in cells; its edge is good to a part of one.
        assert np.sqrt(row["contact_area_m2"] / np.pi) == pytest.approx(half_width, rel=5e-3)
        # Backward Euler at these tolerances lags by less than 1 %.
        exact = winkler.worn_sphere_pressure(0.0, row["distance_m"], **WORN)
        assert row["centre_pressure_Pa"] == pytest.approx(exact, rel=0.01)
        # a = √(2Rδ): the approach is that of the unworn ball's cap.
        assert row["approach_m"] == pytest.approx(half_width**2 / (2 * 5e-3), rel=1e-3, abs=0)


def test_halved_tolerances_halve_the_error_of_the_steps():
    exact = winkler.worn_sphere_pressure(0.0, 20.0, **WORN)
    errors = []
    for tolerance in (0.08, 0.04, 0.02):
        saves = ball_only(
            contact=foundation(),
            grid=Grid((0.7e-3, 0.7e-3), (200, 200)),
            stepping=Implicit(pressure_tolerance=tolerance, depth_tolerance=0.1, settle=1.0),
        )
        errors.append(saves[-1]["centre_pressure_Pa"] / exact - 1)
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    # Backward Euler's error is positive, and in proportion to the increments.
    assert np.all(np.array(errors) > 0)
    assert np.all((orders > 0.8) & (orders < 1.25))


def test_the_half_space_follows_argatovs_law_to_the_depth_of_an_independent_run():
    saves = ball_only(
        grid=Grid((1.2e-3, 1.2e-3), (96, 96)), kinematics=motion(duration=3600), save_times=(500,)
    )
    for save in saves:
        argatov = ball_wear.elastic_ball_half_width(
            save["distance_m"],
            load=100,
            radius=5e-3,
            wear_coefficient=K,
            initial_half_width=148.837e-6,
        )
        assert np.sqrt(save["contact_area_m2"] / np.pi) == pytest.approx(argatov, rel=0.015)
    depth = saves[-1]["bodies"]["ball"]["centre_wear_depth_m"]
    # 26.698 µm in the rigid limit.
    assert depth == pytest.approx(26.509e-6, rel=3e-3)
