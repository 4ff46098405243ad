"""At default tolerances the wear is right for laws of every kind."""

import numpy as np
import pytest
from paper_models import K, foundation, lost, motion, pair, power, small, steel

from tribo import Grid, WearLaw, WearRate
from tribo.core.fields import LocalConditions
from tribo.guards.parts import GuardedLaw
from tribo.stepping.implicit import Implicit
from tribo.wear.archard import Power

FINE = Implicit(depth_tolerance=2e-4, pressure_tolerance=0.02)


class Threshold(WearLaw):
    """dh/ds = k max(p − 300 MPa, 0)."""

    type = "test.threshold"

    def rate(self, local):
        excess = np.maximum(local.pressure - 3e8, 0.0)
        return WearRate(K * excess, K * (excess > 0))


def volume(law, stepping, duration):
    parts = {"grid": Grid((0.7e-3, 0.7e-3), (24, 24)), "kinematics": motion(duration=duration)}
    return lost(small(bodies=pair(law), contact=foundation(), stepping=stepping, **parts))


@pytest.mark.slow
@pytest.mark.parametrize("law", [power(2), Threshold()], ids=["p^2", "threshold"])
def test_a_law_not_linear_in_pressure_is_right_to_0_3_percent(law):
    default, fine = (volume(law, stepping, 50) for stepping in (Implicit(), FINE))
    assert default == pytest.approx(fine, rel=3e-3, abs=0)


class Steepless(Power):
    """A law that leaves its slope out."""

    type = "test.steepless"

    def rate(self, local):
        return WearRate(super().rate(local).depth_rate)


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [1, 3])
def test_a_slope_that_a_law_leaves_out_is_found(exponent):
    ours = Steepless(k=K, p_exponent=exponent, reference_pressure="1 GPa")
    pressure = np.array([[0.0, 1e6, 1e8, 2e9]])
    guarded = GuardedLaw(ours, "ball", steel())
    found = guarded.rate(LocalConditions(pressure, 0.1, steel())).depth_slope
    needed = power(exponent).rate(LocalConditions(pressure, 0.1, steel())).depth_slope
    np.testing.assert_allclose(found, needed, rtol=2e-3, atol=2e-3 * needed.max())
    own, known = (volume(law, Implicit(), 10) for law in (ours, power(exponent)))
    assert own == pytest.approx(known, rel=1e-6, abs=0)
