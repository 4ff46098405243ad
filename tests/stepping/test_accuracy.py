"""At default tolerances the wear is right for laws of every kind."""

import numpy as np
import pytest
from paper_models import K, flat, foundation, lost, motion, named, pair, power, small, steel
from strangers.running_in import RunningIn

from tribo import Field, Grid, Simulation, WearLaw, WearRate
from tribo.core.fields import LocalConditions
from tribo.simulation.guards import GuardedLaw
from tribo.stepping.implicit import Implicit
from tribo.wear.power import Power

FINE = Implicit(depth_tolerance=2e-4, pressure_tolerance=0.02)


class Threshold(WearLaw):
    """dh/ds = k max(p − 300 MPa, 0)."""

    type = "test.threshold"

    def rate(self, local):
        excess = np.maximum(local.pressure - 3e8, 0.0)
        return WearRate(K * excess, K * (excess > 0))


class Fading(WearLaw):
    """dh/ds = k (0.1 + 0.9 m) p, with dm/ds = −m/(5 m): it keeps what `RunningIn` works out."""

    type = "test.fading"

    state_fields = (Field("fresh", "1", "Part that has not yet run in."),)

    def initial_state(self):
        return {"fresh": 1.0}

    def rate(self, local):
        fresh = local.state["fresh"]
        k = K * (0.1 + 0.9 * fresh)
        return WearRate(k * local.pressure, k, {"fresh": -fresh / 5.0})


def running_in(length):
    return RunningIn(k_first=K, k_last=0.1 * K, length=length)


def volume(law, stepping):
    grid = Grid((0.7e-3, 0.7e-3), (32, 32))
    return lost(small(grid=grid, bodies=pair(law), contact=foundation(), stepping=stepping))


@pytest.mark.slow
@pytest.mark.parametrize("law", [power(2), Threshold()], ids=["p^2", "threshold"])
def test_a_law_not_linear_in_pressure_is_right_to_0_3_percent(law):
    default, fine = volume(law, Implicit()), volume(law, FINE)
    assert default == pytest.approx(fine, rel=3e-3, abs=0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("law", "length"),
    [(running_in(20.0), 20.0), (running_in(5.0), 5.0), (Fading(), 5.0)],
    ids=["over 20 m", "over 5 m", "its own memory"],
)
def test_a_law_that_runs_in_under_even_pressure_follows_its_integral(law, length):
    side, duration = 0.4e-3, 1000.0
    case = small(
        grid=Grid((side, side), (8, 8)),
        bodies=[named("pin", flat(), steel(), law), named("disk", flat(), steel())],
        contact=foundation(),
        kinematics=motion(duration=duration),
        ends_at_window=True,
    )
    path = 0.1 * duration
    needed = K * (0.1 * path + 0.9 * length * (1 - np.exp(-path / length))) * 100 / side**2
    with Simulation(case).run() as result:
        found = result.saves()[-1]["bodies"]["pin"]["max_wear_depth_m"]
    assert found == pytest.approx(needed, rel=5e-3, abs=0)


class Steepless(Power):
    """A law that leaves its slope out."""

    type = "test.steepless"

    def rate(self, local):
        return WearRate(super().rate(local).depth_rate)


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [1, 1.5, 3])
def test_a_slope_that_a_law_leaves_out_is_found(exponent):
    ours = Steepless(k=K, p_exponent=exponent, reference_pressure="1 GPa")
    pressure = np.array([[0.0, 1e6, 1e8, 2e9]])
    guarded = GuardedLaw(ours, "ball", steel())
    found = guarded.rate(LocalConditions(pressure, 0.1, steel())).depth_slope
    needed = power(exponent).rate(LocalConditions(pressure, 0.1, steel())).depth_slope
    np.testing.assert_allclose(found, needed, rtol=2e-3, atol=2e-3 * needed.max())
    default = Implicit()
    assert volume(ours, default) == pytest.approx(volume(power(exponent), default), rel=1e-6, abs=0)
