"""Roughness parameters against closed forms and SurfaceTopography."""

import numpy as np
import pytest
from tribo import Cylinder, Grid, Rough, Sphere
from tribo.kernel_api import without_form

from tribo_topography.roughness import (
    is_rough,
    material_ratio,
    profile_parameters,
    roughness,
)

GRID = Grid("1 mm", 100)
A = 50e-9
WAVES = A * np.sin(2 * np.pi * (np.arange(100) + 0.5) / 25)


def random_waves():
    return Rough(sq=A, cut_off="50 um", roll_off="0.2 mm", seed=3).height(GRID)


def test_short_lines_at_the_rim_of_a_mask_do_not_count():
    masked = np.tile(WAVES, (40, 1))
    masked[0, 30:] = np.nan
    assert profile_parameters(masked, 1) == profile_parameters(masked[1:], 1)


@pytest.mark.parametrize("masked", [False, True])
def test_a_parabola_is_removed_exactly(masked):
    x, y = GRID.mesh
    height = 3e-6 - 40 * x**2 - 90 * y**2 + 30 * x * y + 1e-3 * x + 2e-3 * y
    if masked:
        height[x**2 + y**2 > 0.3e-3**2] = np.nan
    relief = without_form(height)
    np.testing.assert_array_equal(np.isnan(relief), np.isnan(height))
    assert np.nanmax(np.abs(relief)) == 0


def test_a_map_with_fewer_cells_than_the_form_has_terms_has_no_roughness():
    height = np.full((5, 5), np.nan)
    height[2] = 1e-6
    assert all(np.isnan(roughness(height)))


def test_the_material_ratio_of_a_ramp_is_straight():
    ramp = np.linspace(0, 1e-6, 200).reshape(10, 20)
    ratio, height = material_ratio(np.where(ramp > 0, ramp, np.nan))
    assert ratio[0] == pytest.approx(0.5 / 199, rel=1e-12, abs=0)
    np.testing.assert_allclose(np.diff(ratio, 2), 0, atol=1e-12)
    np.testing.assert_allclose(np.diff(height, 2), 0, atol=1e-18)
    assert np.all(np.diff(height) < 0)


@pytest.mark.parametrize("form", [Sphere(radius="5 mm"), Cylinder(radius="5 mm"), None])
def test_a_body_is_rough_where_it_is_more_than_its_form(form):
    height = np.zeros(GRID.cells) if form is None else form.height(GRID)
    assert not is_rough(height)
    assert is_rough(height + 0.1 * random_waves())
