"""Fields of two grids differ by what the grids resolve, not by where their cells end."""

import numpy as np
import pytest
from made_results import GRID, made

from tribo.core.grid import Grid
from tribo.study.differences import differences


class Made:
    """What `differences` asks of a result: a pressure from a function of the position."""

    body_names = ()

    def __init__(self, size, cells, pressure):
        self.grid = Grid((size, size), (cells, cells))
        self._pressure = np.broadcast_to(pressure(*self.grid.mesh), self.grid.cells)

    def save_at(self, time):
        return 0

    def field(self, name, save):
        return {"pressure": self._pressure}[name]


def difference(one, other):
    (found,) = differences(one, other, 0.0).values()
    return found


@pytest.mark.parametrize("cells", [5, 12, 60, 61])
@pytest.mark.parametrize("size", [0.7, 1.0, 1.3])
def test_a_plane_is_the_same_on_every_grid(size, cells):
    def plane(x, y):
        return 2 + x - 0.5 * y

    found = difference(Made(size, cells, plane), Made(1.0, 30, plane))
    assert found == pytest.approx((0, 0), abs=1e-14)


def test_a_groove_does_not_end_with_the_cells():
    fine = Grid(GRID.size, tuple(2 * n for n in GRID.cells))
    with made(times=(0.0, 3600.0)) as coarse, made(times=(0.0, 3600.0), grid=fine) as other:
        for pair in ((coarse, other), (other, coarse)):
            # A smooth depth changes by (cell over scar)², (40/1,000)².
            assert 0 < differences(*pair, 3600.0)["bodies.disk.wear_depth"].largest < 0.01


def test_norms_are_over_all_cells_and_relative_to_the_reference():
    def tilted(x, y):
        return 2 + x + y * y

    def even(x, y):
        return 2.0

    p, q = (Made(1.0, 6, shape).field("pressure", 0) for shape in (tilted, even))
    l2, largest = difference(Made(1.0, 6, tilted), Made(1.0, 6, even))
    assert l2 == pytest.approx(np.linalg.norm(p - q) / np.linalg.norm(q))
    assert largest == pytest.approx(np.max(np.abs(p - q)) / 2)


def test_small_depths_are_compared_as_large_ones():
    found = difference(Made(1.0, 4, lambda x, y: 1.5e-200), Made(1.0, 4, lambda x, y: 1e-200))
    assert found == pytest.approx((0.5, 0.5))
