"""What lies between the bodies and remembers, against its exact balance."""

import numpy as np
import pytest
from paper_models import flat, foundation, named, small, states, steel
from scipy.integrate import solve_ivp
from scipy.special import lambertw
from strangers.debris import Covered, Debris

from tribo import Grid
from tribo.motion.unidirectional import Unidirectional

SIDE, LOAD, TRACK, END = 2e-3, 40.0, 8e-3, 6.0
K, COVER, LENGTH = 2e-14, 50e-9, 50e-3
LAW = Covered(k=K, cover=COVER)
P = LOAD / SIDE**2


def pin(on, length=LENGTH, end=END):
    """A square pin on a track: the pressure is the same everywhere, and stays so."""
    return small(
        grid=Grid((SIDE, SIDE), (6, 6)),
        load=LOAD,
        bodies=[named(name, flat(), steel(), LAW) for name in ("pin", "disk")],
        contact=foundation(modulus=1e15),
        kinematics=Unidirectional(speed=0.1, track_length=TRACK, distance=end),
        effects=[Debris(length=length, on=on)],
        ends_at_window=True,
    )


@pytest.mark.parametrize("on", [None, "pin", "disk"])
def test_the_thickness_is_that_of_the_balance(on):
    last = states(pin(on))[-1]
    thickness = last.between["debris_thickness"]
    # Debris on the disk is under the pin for part of its way.
    under = SIDE / TRACK if on == "disk" else 1.0
    source = 2 * K * P
    assert thickness == pytest.approx(COVER * lambertw(source * LENGTH / COVER).real, rel=1e-4)
    balance = solve_ivp(
        lambda _, y: (
            under * np.array([source * np.exp(-y[0] / COVER) - y[0] / LENGTH, y[0] / LENGTH])
        ),
        (0, END),
        [0.0, 0.0],
        rtol=1e-9,
        atol=1e-18,
        method="LSODA",
    ).y[:, -1]
    assert thickness == pytest.approx(balance[0], rel=1e-4)
    worn = sum(
        float(np.mean(body.wear)) * (1.0 if name == "pin" else TRACK / SIDE)
        for name, body in last.bodies.items()
    )
    assert worn == pytest.approx(balance[0] / under + balance[1] / under, rel=1e-4)
