"""Lab formulas against integrals of the shapes they stand for."""

import numpy as np
import pytest
from scipy.integrate import quad

from tribo.analysis import lab
from tribo.core.grid import Grid
from tribo.testing.reference.ball_on_track import ball_on_track, track_profile

R = 5e-3


def test_wear_rate_of_the_weighed_volume():
    volume = lab.volume_from_mass(2.2e-6, 7850.0)
    assert volume == pytest.approx(2.80255e-10, rel=1e-5)
    k = lab.specific_wear_rate(volume, 100.0, 9000.0)
    assert k == pytest.approx(3.1139e-16, rel=1e-4)
    assert lab.in_mm3_per_newton_metre(k) == pytest.approx(3.1139e-7, rel=1e-4)
    assert lab.mass_from_volume(volume, 7850.0) == pytest.approx(2.2e-6, rel=1e-12)


@pytest.mark.parametrize("d", [1e-6, 1e-3, 2e-3, 9e-3])
def test_cap_volume_is_that_of_a_body_of_revolution(d):
    h = lab.ball_cap_depth(d, R)
    # z runs down from the pole; the section there has radius² z(2R − z).
    volume, _ = quad(lambda z: np.pi * z * (2 * R - z), 0.0, h)
    assert h * (2 * R - h) == pytest.approx(d**2 / 4, rel=1e-12)
    assert lab.ball_cap_volume(d, R) == pytest.approx(volume, rel=1e-10)
    assert lab.cap_diameter(volume, R) == pytest.approx(d, rel=1e-9)


def test_shallow_form_falls_short_by_its_next_term():
    for d, part in ((1e-3, 0.0033), (2e-3, 0.0133)):
        shortfall = 1 - lab.shallow_cap_volume(d, R) / lab.ball_cap_volume(d, R)
        assert shortfall == pytest.approx(part, abs=2e-4)


def test_groove_radius_and_area_belong_to_a_parabola():
    curved, width = 8e-3, 1e-3
    area, _ = quad(lambda y: (width**2 / 4 - y**2) / (2 * curved), -width / 2, width / 2)
    assert lab.groove_radius(width, area) == pytest.approx(curved, rel=1e-10)


def test_conforming_volume_by_how_much_the_flat_cap_overstates():
    d = 1e-3
    for curved, times in ((6e-3, 6.0), (8e-3, 8 / 3)):
        ratio = lab.shallow_cap_volume(d, R) / lab.conforming_ball_volume(d, d, R, curved)
        assert ratio == pytest.approx(times, rel=1e-9)


def test_conforming_volume_of_a_scar_flat_along_the_track():
    """The paraboloid between ball and parabolic groove, integrated: d⊥/d∥ times the formula."""
    curved, across = 20e-3, 1e-3
    along = across * np.sqrt(1 - R / curved)
    n = 1000
    x = (np.arange(n) + 0.5) / n * along / 2
    y = (np.arange(n) + 0.5) / n * across / 2
    depth = along**2 / 8 / R - x[:, None] ** 2 / 2 / R - y**2 / 2 * (1 / R - 1 / curved)
    volume = 4 * np.sum(np.maximum(depth, 0)) * (x[1] - x[0]) * (y[1] - y[0])
    formula = lab.conforming_ball_volume(along, across, R, curved)
    # A midpoint sum of a thousand cells a side errs by about 1e-6.
    assert volume == pytest.approx(formula * across / along, rel=1e-5)


def test_circular_groove_area_is_the_integral_of_its_section():
    d = 2e-3
    bottom = np.sqrt(R**2 - d**2 / 4)
    area, _ = quad(lambda y: np.sqrt(R**2 - y**2) - bottom, -d / 2, d / 2)
    assert lab.circular_groove_area(d, R) == pytest.approx(area, rel=1e-9)
    assert lab.disk_track_volume(d, R, 0.02) == pytest.approx(2 * np.pi * 0.02 * area, rel=1e-9)
    whole = 0.01 * area + lab.ball_cap_volume(d, R)
    assert lab.reciprocating_track_volume(d, R, 0.01) == pytest.approx(whole, rel=1e-9)


def test_block_volume_is_the_integral_of_a_circular_segment():
    D, t, b = 35e-3, 6.35e-3, 3e-3
    bottom = np.sqrt(D**2 - b**2) / 2
    area, _ = quad(lambda y: np.sqrt(D**2 / 4 - y**2) - bottom, -b / 2, b / 2)
    assert lab.block_on_ring_volume(b, D, t) == pytest.approx(area * t, rel=1e-8)


def test_planimetric_area_leaves_piled_up_material_out():
    assert lab.planimetric_area([-1e-6, 2e-6, 3e-6, -1e-6], 1e-5) == pytest.approx(5e-11)
    assert lab.planimetric_volume(5e-11, 2e-3) == pytest.approx(1e-13)


CASE = {
    "load": 100.0,
    "radius": R,
    "track_length": 2e-3,
    "ball_wear_coefficient": 3.11e-16,
    "flat_wear_coefficient": 3.11e-16,
}


def worn_ball(cells=(240, 260)):
    """Depth of the ball after 360 m, rigid limit, and its grid."""
    grid = Grid((1.2e-3, 1.3e-3), cells)
    half = track_profile(grid.y, 360.0, **CASE).half_length
    return np.maximum(half**2 - grid.x[:, None] ** 2, 0.0) / (2 * R), grid


def test_scar_of_a_worn_ball():
    depth, grid = worn_ball()
    worn = ball_on_track([360.0], **CASE)
    seen = lab.scar(depth, grid)
    # A cell is 5 µm; the threshold hides 0.1 µm, and the edge cells round the extent.
    assert seen.along == pytest.approx(2 * worn.half_width_along[0], abs=5e-6)
    assert seen.across == pytest.approx(2 * worn.half_width_across[0], abs=5e-6)
    assert seen.mean_diameter == pytest.approx((seen.along + seen.across) / 2)
    # The four middle cells lie 3.5 µm off the centre.
    assert seen.centre_depth == pytest.approx(worn.ball_depth[0], rel=1e-4)
    assert seen.peak_depth == pytest.approx(worn.ball_depth[0], rel=1e-4)
    # Cells cut by the border: second order, (5/500)².
    assert seen.volume == pytest.approx(worn.ball_volume[0], rel=1e-4)


def test_scar_shrinks_as_the_threshold_grows():
    depth, grid = worn_ball()
    top = lab.scar(depth, grid, visible=0.75 * float(depth.max()))
    # Along x the depth is a parabola: a quarter of it high, half of it wide.
    assert top.along == pytest.approx(0.5 * lab.scar(depth, grid).along, abs=10e-6)


def test_unworn_ball_has_no_scar():
    grid = Grid((1e-3, 1e-3), (5, 4))
    nothing = lab.scar(np.zeros((5, 4)), grid)
    assert (nothing.along, nothing.across, nothing.volume) == (0.0, 0.0, 0.0)


def test_crown_is_the_depth_of_the_groove_across_and_nothing_along():
    depth, grid = worn_ball()
    x, y = grid.mesh
    height = -(x**2 + y**2) / (2 * R) - depth
    row, column = grid.cells[0] // 2, grid.cells[1] // 2
    worn = ball_on_track([360.0], **CASE)
    across = lab.crown(height[row], depth[row])
    # The last worn cell lies up to 5 µm inside the edge, where the groove is 0.03 µm deep.
    assert across == pytest.approx(worn.flat_depth[0], abs=5e-8)
    assert lab.crown(height[:, column], depth[:, column]) == pytest.approx(0.0, abs=1e-12)
    assert lab.crown(height[row], np.zeros_like(depth[row])) == 0.0


def test_crown_does_not_see_a_tilt():
    x = np.linspace(-1.0, 1.0, 201) * 1e-3
    depth = np.where(np.abs(x) < 0.5e-3, 1e-6, 0.0)
    bulge = -(x**2) / (2 * R)
    assert lab.crown(bulge + 0.01 * x, depth) == pytest.approx(lab.crown(bulge, depth), rel=1e-9)
