"""The size of a scar, against the worn ball in the rigid limit."""

import numpy as np
import pytest

from tribo.analysis.scar import crown, scar
from tribo.core.grid import Grid
from tribo.testing.reference.ball_on_track import ball_on_track, track_profile

R = 5e-3


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
    seen = scar(depth, grid)
    # A cell is 5 µm; the threshold hides 0.1 µm, and the edge cells round the extent.
    assert seen.along == pytest.approx(2 * worn.half_width_along[0], abs=5e-6)
    assert seen.across == pytest.approx(2 * worn.half_width_across[0], abs=5e-6)
    assert seen.mean_diameter == pytest.approx((seen.along + seen.across) / 2)
    # The four middle cells lie 3.5 µm off the centre.
    assert seen.centre_depth == pytest.approx(worn.ball_depth[0], rel=1e-4)
    assert seen.peak_depth == pytest.approx(worn.ball_depth[0], rel=1e-4)
    # Cells cut by the border: second order, (5/500)².
    assert seen.volume == pytest.approx(worn.ball_volume[0], rel=1e-4, abs=0)


def test_scar_shrinks_as_the_threshold_grows():
    depth, grid = worn_ball()
    top = scar(depth, grid, visible=0.75 * float(depth.max()))
    # Along x the depth is a parabola: a quarter of it high, half of it wide.
    assert top.along == pytest.approx(0.5 * scar(depth, grid).along, abs=10e-6)


def test_unworn_ball_has_no_scar():
    grid = Grid((1e-3, 1e-3), (5, 4))
    nothing = scar(np.zeros((5, 4)), grid)
    assert (nothing.along, nothing.across, nothing.volume) == (0.0, 0.0, 0.0)


def test_crown_is_the_depth_of_the_groove_across_and_nothing_along():
    depth, grid = worn_ball()
    x, y = grid.mesh
    height = -(x**2 + y**2) / (2 * R) - depth
    row, column = grid.cells[0] // 2, grid.cells[1] // 2
    worn = ball_on_track([360.0], **CASE)
    across = crown(height[row], depth[row])
    # The last worn cell lies up to 5 µm inside the edge, where the groove is 0.03 µm deep.
    assert across == pytest.approx(worn.flat_depth[0], abs=5e-8)
    assert crown(height[:, column], depth[:, column]) == pytest.approx(0.0, abs=1e-12)
    assert crown(height[row], np.zeros_like(depth[row])) == 0.0


def test_crown_does_not_see_a_tilt():
    x = np.linspace(-1.0, 1.0, 201) * 1e-3
    depth = np.where(np.abs(x) < 0.5e-3, 1e-6, 0.0)
    bulge = -(x**2) / (2 * R)
    assert crown(bulge + 0.01 * x, depth) == pytest.approx(crown(bulge, depth), rel=1e-9, abs=0)
