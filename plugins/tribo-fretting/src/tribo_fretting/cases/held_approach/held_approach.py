"""A ball that frets at its first approach until nothing slips: what sticks bears all load."""

from math import pi, sqrt

import numpy as np
import tribo

from tribo_fretting.motion import Fretting

LOAD, BALL = 100.0, 10e-3
CORK = tribo.Material(young="207 GPa", poisson=0.0)
MODULUS = 0.5 * CORK.young
RADIUS = (0.75 * LOAD * BALL / MODULUS) ** (1 / 3)
APPROACH = RADIUS**2 / BALL
AMPLITUDE = "1.685103017 um"
"""Sticks over half of the radius, by Mindlin."""


class HeldApproach(tribo.Effect):
    """A load that brings the bodies back to their first approach after each step."""

    type = "case.held_approach"

    def load_factor(self, snapshot: tribo.Snapshot) -> float:
        """Return the load that the stiffness of the contact asks for, over the first load."""
        now = snapshot.measures
        stiffness = 2 * MODULUS * sqrt(now.area / pi)
        return float(now.load - stiffness * (now.approach - APPROACH)) / LOAD


def found() -> dict[str, float]:
    """Return the last approach, load (N) and volume (m³), and the part of the load that sticks."""
    ball = tribo.Body(
        surface=tribo.Paraboloid(radius=BALL), material=CORK, wear=tribo.Archard(k=1e-15)
    )
    case = tribo.Case(
        grid=tribo.Grid(3.4 * RADIUS, 64),
        load=LOAD,
        friction=tribo.Friction(coefficient=0.6),
        bodies={"ball": ball, "flat": tribo.Body(surface=tribo.Flat(), material=CORK)},
        kinematics=Fretting(amplitude=AMPLITUDE, frequency=20.0, cycles=3e7),
        effects=[HeldApproach()],
        # The load follows by steps: long ones press too far meanwhile, and wear the stick zone.
        stepping=tribo.Implicit(depth_tolerance=0.01, pressure_tolerance=1.0),
    )
    with case.run() as result:
        (*_, last), pressure = result.saves(), result.field("pressure", -1)
        stuck = (pressure > 0) & (result.field("local_slip", -1, "ball") == 0)
    return {
        "approach over the first": last["approach_m"] / APPROACH,
        "load": last["load_N"],
        "wear volume": last["bodies"]["ball"]["wear_volume_m3"],
        "part of the load on what sticks": float(np.sum(pressure[stuck]) / np.sum(pressure)),
    }
