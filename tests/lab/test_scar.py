"""The size of a scar, against the worn ball in the rigid limit."""

from itertools import product

import numpy as np
import pytest
from ball_on_track import ball_on_track
from rigid_track import EQUAL, R, half_lengths

from tribo.core.grid import Grid
from tribo.lab.scar import crown, diameter, scar


def worn_ball(cells=(240, 260), case=EQUAL):
    """Depth of the ball after 360 m, rigid limit, and its grid."""
    grid = Grid((1.2e-3, 1.3e-3), cells)
    half, _ = half_lengths(grid.y, 360.0, case)
    return np.maximum(half**2 - grid.x[:, None] ** 2, 0.0) / (2 * R), grid


@pytest.mark.parametrize("depth", [1e-9, 1e-7, 1e-4])
@pytest.mark.parametrize("per_cell", [5.1, 8.0, 8.5, 8.9])
def test_a_flat_scar_of_any_depth_is_as_wide_as_it_is(depth, per_cell):
    half = np.sqrt(depth * (2 * R - depth))
    cell = half / per_cell
    for cells, off_centre in product((24, 25), (0.0, 0.2, 0.4)):
        grid = Grid((cells * cell, cells * cell), (cells, cells))
        x, y = grid.mesh
        fallen = (x - off_centre * cell) ** 2 + y**2
        worn = np.maximum(depth - fallen / (R + np.sqrt(R**2 - fallen)), 0.0)
        # On even grids no line of cells runs through the middle.
        assert scar(worn, grid) == pytest.approx((2 * half, 2 * half), abs=0.06 * cell)


def test_an_even_wear_ends_between_worn_and_unworn_cells():
    depth = np.zeros((12, 12))
    depth[3:9, 0:5] = 1e-6
    assert diameter(depth, 0, 1.0) == pytest.approx(6.0)
    assert diameter(depth, 1, 1.0) == pytest.approx(5.0)


@pytest.mark.parametrize("cells", [(24, 24), (25, 25), (31, 30)])
def test_crown_on_a_coarse_grid_grows_as_the_groove_does(cells):
    """The edge of the scar lies anywhere between cells, some 20 of which it is wide."""
    row = (cells[0] - 1) // 2
    found, exact = [], []
    for more in np.exp(np.linspace(-0.5, 0.0, 26)):
        case = {**EQUAL, "flat_wear_coefficient": more * EQUAL["flat_wear_coefficient"]}
        depth, grid = worn_ball(cells, case)
        x, y = grid.mesh
        found.append(crown((-(x**2 + y**2) / (2 * R) - depth)[row], depth[row]))
        exact.append(ball_on_track([360.0], **case).flat_depth[0])
    assert found == pytest.approx(exact, rel=0.04, abs=0)
    slope = np.log(np.divide(found[10:], found[:-10])) / np.log(np.divide(exact[10:], exact[:-10]))
    assert slope == pytest.approx(1.0, abs=0.25)


@pytest.mark.parametrize(
    ("power", "off"), [(0.5, 1.1), (0.7, 0.7), (1, 1e-6), (1.2, 0.01), (1.5, 0.01)]
)
def test_a_diameter_grows_evenly_with_the_scar(power, off):
    """Also where the depth runs out more steeply, or in a toe, as it does under elastic bodies."""
    y = np.arange(40) - 19.5
    halves = np.arange(8.0, 11.0, 0.02)
    lines = [np.maximum(1 - (y / half) ** 2, 0.0) ** power for half in halves]
    found = [diameter(line[None, :], 1, 1.0) for line in lines]
    assert found == pytest.approx(2 * halves, abs=off)
    assert np.max(np.diff(found)) < 0.3
