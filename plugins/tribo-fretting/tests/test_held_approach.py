"""The limit of wear in partial slip: a ball held at its first approach stands on what sticks."""

from math import asin, pi, sqrt

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from tribo import (
    Archard,
    Body,
    Case,
    ContactProblem,
    ContactSystem,
    DcFft,
    Effect,
    Flat,
    Friction,
    Grid,
    Implicit,
    Material,
    Paraboloid,
)

from tribo_fretting.closed_forms import shift, tangential_compliance, worn_load_share
from tribo_fretting.motion import Fretting

LOAD, MU, BALL, STUCK = 100.0, 0.6, 10e-3, 0.5
CORK = Material(young="207 GPa", poisson=0.0)
MODULUS = 0.5 * CORK.young
RADIUS = (0.75 * LOAD * BALL / MODULUS) ** (1 / 3)
APPROACH = RADIUS**2 / BALL


class HeldApproach(Effect):
    """A load that brings the bodies back to their first approach after each step."""

    type = "test.held_approach"

    def load_factor(self, snapshot):
        now = snapshot.measures
        stiffness = 2 * MODULUS * sqrt(now.area / pi)
        return (now.load - stiffness * (now.approach - APPROACH)) / LOAD


def depth(r, c):
    """The depth at a radius where a stick zone of radius c bears all of the load."""
    angle = asin(c / r)
    stood = APPROACH * angle - (r**2 * angle - c * sqrt(r**2 - c**2)) / (2 * BALL)
    return APPROACH - 2 / pi * stood - r**2 / (2 * BALL)


def punch_radius(cells, grid):
    """The radius of the round punch as stiff as one of these cells."""
    system = ContactSystem(grid, MODULUS, LOAD)
    problem = ContactProblem(system, np.where(cells, 0, 1e-3), LOAD)
    return LOAD / (2 * MODULUS * DcFft(tolerance=1e-10).solve(problem).approach)


@pytest.mark.slow
@pytest.mark.parametrize(("window", "off"), [(2.8, 0.01), (3.4, 2e-4)])
def test_a_ball_held_at_its_approach_wears_to_the_limit_of_dimensionality_reduction(window, off):
    # Popov, V. L. (2014), Sci. Rep. 4, 3749.
    moved = shift(1 - STUCK**3, MU * LOAD, RADIUS, tangential_compliance([CORK, CORK]))
    grid = Grid(window * RADIUS, 64)
    ball = Body(surface=Paraboloid(radius=BALL), material=CORK, wear=Archard(k=1e-15))
    case = Case(
        grid=grid,
        load=LOAD,
        friction=Friction(coefficient=MU),
        bodies={"ball": ball, "flat": Body(surface=Flat(), material=CORK)},
        kinematics=Fretting(amplitude=moved, frequency=20.0, cycles=3e7),
        effects=[HeldApproach()],
        # The load follows by steps: long ones press too far meanwhile, and wear the stick zone.
        stepping=Implicit(depth_tolerance=0.01, pressure_tolerance=1.0),
    )
    result = case.run()
    (*_, last), pressure = result.saves(), result.field("pressure", -1)
    stuck = (pressure > 0) & (result.field("local_slip", -1, "ball") == 0)
    assert last["approach_m"] == pytest.approx(APPROACH, rel=1e-6, abs=0)
    assert np.sum(pressure[stuck]) >= 0.9999 * np.sum(pressure)
    # Cells stick as a punch does whose radius is a part of a cell off; at 3.4 a it is a/2.
    c = punch_radius(stuck, grid)
    assert c == pytest.approx(STUCK * RADIUS, rel=off, abs=0)
    load = LOAD * worn_load_share(c / RADIUS)
    edge = brentq(depth, RADIUS, 2 * RADIUS, args=(c,))
    volume = quad(lambda r: 2 * pi * r * depth(r, c), c, edge)[0]
    assert last["load_N"] == pytest.approx(load, rel=1e-4, abs=0)
    assert last["bodies"]["ball"]["wear_volume_m3"] == pytest.approx(volume, rel=3e-4, abs=0)
