import numpy as np
import pytest

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.surfaces.forms import Cylinder, Flat, Paraboloid, Sphere

GRID = Grid((2e-3, 3e-3), (40, 61))
SURFACES = [
    Sphere(radius="5 mm"),
    Paraboloid(radius_x="5 mm", radius_y="10 mm"),
    Cylinder(radius="5 mm"),
    Cylinder(radius="5 mm", axis="x"),
    Flat(),
]


@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: type(s).__name__)
def test_heights_are_symmetric_to_the_last_bit(surface):
    z = surface.height(GRID)
    assert z.shape == GRID.cells
    np.testing.assert_array_equal(z, z[::-1])
    np.testing.assert_array_equal(z, z[:, ::-1])


def test_a_sphere_is_the_exact_cap():
    z = Sphere(radius="5 mm").height(GRID)
    x, y = GRID.mesh
    np.testing.assert_allclose((z + 5e-3) ** 2 + x**2 + y**2, 25e-6, rtol=1e-13)


@pytest.mark.parametrize("surface", [Sphere(radius="1 mm"), Cylinder(radius="0.9 mm")])
def test_a_body_smaller_than_the_window_is_refused(surface):
    with pytest.raises(CaseError, match=r"does not reach over .*window.* make grid\.size smaller"):
        surface.height(GRID)
