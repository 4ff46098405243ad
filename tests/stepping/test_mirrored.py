"""A cycle of which one half mirrors the other, solved by half."""

import numpy as np
import pytest
from paper_models import last, small

from tribo import Grid, Implicit, Measured
from tribo.stepping import contacts

GRID = Grid((1.2e-3, 0.75e-3), (32, 20))
END = 6 * GRID.spacing[0]
EVEN = [(0, -END), (1, END), (2, -END)]
UNEVEN = [(0, -END), (1, END), (2, 0), (3, END), (4, -END)]
"""One half of the stroke is slid twice as often as the other."""


@pytest.mark.parametrize("path", [EVEN, UNEVEN])
def test_a_cycle_that_is_solved_by_half_is_the_one_that_is_solved_whole(path, monkeypatch):
    kinematics = Measured(path=path, cycles=2000, positions=9)
    stepping = Implicit(depth_tolerance=0.1, pressure_tolerance=0.5)
    model = small(grid=GRID, kinematics=kinematics, stepping=stepping)
    by_half = last(model)
    monkeypatch.setattr(contacts, "_all_mirror", lambda *_: False)
    whole = last(model)
    for contact in by_half.contacts:
        # Each observer is given them.
        assert not contact.pressure.flags.writeable
        assert not contact.overlap.flags.writeable
    assert (by_half.contact_solves < whole.contact_solves) == (path is EVEN)
    for name, body in whole.bodies.items():
        off = np.abs(by_half.bodies[name].wear - body.wear)
        assert np.max(off) < 1e-6 * np.max(body.wear), name
