"""The size of a scar, on few cells."""

import numpy as np
import pytest

from tribo.lab.scar import crown, diameter


def test_an_even_wear_ends_between_worn_and_unworn_cells():
    depth = np.zeros((12, 12))
    depth[3:9, 0:5] = 1e-6
    assert diameter(depth, 0, 1.0) == pytest.approx(6.0)
    assert diameter(depth, 1, 1.0) == pytest.approx(5.0)
    # Nor does it reach beyond the window.
    ramp = np.arange(3.0, 15.0)[None]
    assert diameter(ramp, 1, 1.0) == diameter(ramp[:, ::-1], 1, 1.0) == 12.0


@pytest.mark.parametrize("cells", [24, 25])
def test_a_crown_on_a_coarse_grid_is_the_depth_of_the_groove(cells):
    """The edge of the scar lies anywhere between cells, some 20 of which it is wide."""
    y = np.arange(cells) - (cells - 1) / 2
    for half in np.arange(8.0, 11.0, 0.02):
        # Of a ball of radius 1 in a groove of radius 1/0.6.
        depth = np.maximum(half**2 - y**2, 0.0) * (1 - 0.6) / 2
        assert crown(-(y**2) / 2 - depth, depth) == pytest.approx(0.6 * half**2 / 2, rel=0.02)


@pytest.mark.parametrize(
    ("power", "off"), [(0.5, 1.1), (0.7, 0.7), (1, 1e-6), (1.2, 0.01), (1.5, 0.01), (2.5, 0.6)]
)
def test_a_diameter_grows_evenly_with_the_scar(power, off):
    """Also where the depth runs out more steeply, or in a toe, as it does under elastic bodies."""
    # Off the centre of the cells.
    y = np.arange(40) - 19.3
    halves = np.arange(8.0, 11.0, 0.02)
    lines = [np.maximum(1 - (y / half) ** 2, 0.0) ** power for half in halves]
    found = [diameter(line[None, :], 1, 1.0) for line in lines]
    assert found == pytest.approx(2 * halves, abs=off)
    assert np.max(np.diff(found)) < 0.3
