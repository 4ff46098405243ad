"""A ball that alone wears on a foundation, with steps of the error control.

With equal steps it is a row of `tribo verify`.
"""

import numpy as np
import pytest
from paper_models import FOUNDATION, K, archard, case, flat, foundation, named, paraboloid, steel

from tribo import Grid, Simulation
from tribo.closed_forms import winkler
from tribo.stepping.implicit import Implicit


@pytest.mark.slow
def test_halved_tolerances_halve_the_error_of_the_steps():
    worn = {"load": 100, "radius": 5e-3, "stiffness": FOUNDATION, "wear_coefficient": K}
    exact = winkler.worn_sphere_pressure(0.0, 20.0, **worn)
    bodies = [named("ball", paraboloid(), steel(), archard()), named("disk", flat(), steel())]
    errors = []
    for tolerance in (0.08, 0.04, 0.02):
        ball = case(
            bodies=bodies,
            contact=foundation(),
            grid=Grid((0.7e-3, 0.7e-3), (100, 100)),
            stepping=Implicit(pressure_tolerance=tolerance, depth_tolerance=0.1, settle=1.0),
        )
        last = Simulation(ball).run().saves()[-1]
        errors.append(last["centre_pressure_Pa"] / exact - 1)
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    # Backward Euler's error is positive, and in proportion to the increments.
    assert np.all(np.array(errors) > 0)
    assert np.all((orders > 0.8) & (orders < 1.25))
