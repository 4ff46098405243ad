"""A round, flat-ended pin."""

import numpy as np
import pytest

from tribo import CaseError, Grid, Pin

RADIUS, EDGE = 0.5e-3, 0.15e-3
PIN = Pin(radius=RADIUS, edge=EDGE)


def test_the_end_is_flat_and_its_edge_round():
    grid = Grid((1.2e-3, 1.2e-3), (120, 120))
    z = PIN.height(grid)
    r = np.hypot(*grid.mesh)
    np.testing.assert_array_equal(z, z[::-1].T)
    assert not z[r <= RADIUS - EDGE].any()
    edge = (r > RADIUS - EDGE) & (r < RADIUS)
    t = r[edge] - (RADIUS - EDGE)
    np.testing.assert_allclose((z[edge] + EDGE) ** 2 + t**2, EDGE**2, rtol=1e-12)
    assert np.all(z[r > RADIUS] < -EDGE)


def test_an_edge_that_cells_do_not_show_is_refused():
    with pytest.raises(CaseError, match=r"150 µm are 3 cells of 50 µm.*give a longer edge"):
        PIN.height(Grid((1.2e-3, 1.2e-3), (24, 24)))
    with pytest.raises(CaseError, match="edge must be at most radius"):
        Pin(radius=1e-3, edge=2e-3)
