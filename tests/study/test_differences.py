"""Fields of two grids differ by what the grids resolve, not by where their cells end."""

import tomllib

import numpy as np
import pytest

from tribo import compare
from tribo.core.grid import Grid
from tribo.study.differences import differences
from tribo.templates import template

DATA = tomllib.loads(template("ball_on_disk")) | {"output": {}}
DATA["grid"] = {"size": "0.9 mm", "cells": 26}
DATA["kinematics"]["duration"] = 300


@pytest.mark.parametrize("varied", [{"grid.cells": (52, 26)}, {"grid.size": ("0.9 mm", "0.7 mm")}])
@pytest.mark.slow
def test_a_groove_does_not_end_with_the_cells(varied):
    with compare(DATA, varied) as comparison:
        first, other = comparison.results.values()
        for result, reference in ((first, other), (other, first)):
            found = {each.field: each for each in differences(result, reference, 300.0)}
            # Twice the cells change a smooth depth by (cell over scar)², (35/270)²; cells of
            # other sizes by their own errors, too.
            assert 0 < found["bodies.disk.wear_depth"].largest < 0.02


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


@pytest.mark.parametrize("cells", [5, 12, 60, 61])
@pytest.mark.parametrize("size", [0.7, 1.0, 1.3])
def test_a_plane_is_the_same_on_every_grid(size, cells):
    def plane(x, y):
        return 2 + x - 0.5 * y

    (found,) = differences(Made(size, cells, plane), Made(1.0, 30, plane), 0.0)
    assert (found.l2, found.largest) == pytest.approx((0, 0), abs=1e-14)


def test_a_single_row_of_cells_is_even():
    (found,) = differences(Made(1.0, 1, lambda x, y: 2.0), Made(1.0, 4, lambda x, y: 2.0), 0.0)
    assert found.largest == 0


def test_small_depths_are_compared_as_large_ones():
    (found,) = differences(
        Made(1.0, 4, lambda x, y: 1.5e-200), Made(1.0, 4, lambda x, y: 1e-200), 0.0
    )
    assert (found.l2, found.largest) == pytest.approx((0.5, 0.5))
