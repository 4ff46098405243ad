"""A round, flat-ended pin against Sneddon's integrals."""

import numpy as np
import pytest
from paper_models import flat, half_space, named, small, steel
from scipy.integrate import quad

from tribo import CaseError, Grid, Pin
from tribo.simulation.march import begin

RADIUS, EDGE = 0.5e-3, 0.15e-3
PIN = Pin(radius=RADIUS, edge=EDGE)
MODULUS = 207e9 / (2 * (1 - 0.3**2))


def sneddon(a):
    """Return approach (m) and load (N) of a rigid shape pressed to a contact of radius a."""
    flat_end = RADIUS - EDGE

    def over_circle(power):
        # r = a sin(u) takes the root out of the denominator.
        def each(u):
            r = a * np.sin(u)
            t = max(r - flat_end, 0.0)
            return r**power * t / np.sqrt(EDGE**2 - t**2)

        return quad(each, np.arcsin(flat_end / a), np.pi / 2)[0]

    return a * over_circle(0), 2 * MODULUS * over_circle(2)


def test_approach_and_area_are_those_of_sneddon():
    a = 0.40e-3
    approach, load = sneddon(a)
    bodies = [named("pin", PIN, steel()), named("disk", flat(), steel())]
    grid = Grid((1e-3, 1e-3), (96, 96))
    state = begin(small(grid=grid, load=load, contact=half_space(), bodies=bodies))
    assert state.contact.approach == pytest.approx(approach, rel=5e-3, abs=0)
    area = np.count_nonzero(state.contact.pressure > 0) * grid.cell_area
    assert area == pytest.approx(np.pi * a**2, rel=0.02, abs=0)


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
