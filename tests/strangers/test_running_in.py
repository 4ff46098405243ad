"""A state per material point, against the integral of its law."""

import numpy as np
import pytest
from paper_models import named, small, states
from testing.conformance.honest_laws import RunningIn

from tribo import Grid
from tribo.contact.winkler import Winkler
from tribo.core.material import Material
from tribo.motion.closed_track import Unidirectional
from tribo.surfaces.forms import Flat

SIDE, LOAD, TRACK = 2e-3, 40.0, 8e-3
FIRST, LAST, LENGTH = 8e-15, 1e-15, 0.7
END = 2.0


@pytest.fixture(scope="module")
def pin():
    """A square pin on a turning disk: the pressure is the same everywhere, and stays so."""
    law = RunningIn(k_first=FIRST, k_last=LAST, length=LENGTH)
    steel = Material(young=207e9, poisson=0.3)
    motion = {"speed": 0.1, "track_length": TRACK, "distance": END}
    return small(
        grid=Grid((SIDE, SIDE), (8, 8)),
        load=LOAD,
        bodies=[named(name, Flat(), steel, law) for name in ("pin", "disk")],
        contact=Winkler(modulus=1e15),
        kinematics=Unidirectional(**motion),
        ends_at_window=True,
    )


def integral(slip):
    """Depth under unit pressure after `slip` metres under pressure, in closed form."""
    return LAST * slip + (FIRST - LAST) * LENGTH * (1 - np.exp(-slip / LENGTH))


# Each point of the disk is under the pin for SIDE of every TRACK metres.
SLIP = {"pin": END, "disk": END * SIDE / TRACK}


def test_each_body_wears_by_the_integral_over_its_own_slip(pin):
    last = states(pin)[-1]
    for name, slip in SLIP.items():
        exact = integral(slip) * LOAD / SIDE**2
        assert last.bodies[name].wear == pytest.approx(exact, rel=1e-4, abs=0)
        assert last.bodies[name].law["slid"] == pytest.approx(slip, rel=1e-12, abs=0)
    assert last.bodies["disk"].law["slid"].shape == (1, 8)
    assert last.steps < 20
