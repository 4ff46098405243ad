"""A lab's formulas; `tribo verify` sums up the shapes that they stand for."""

import numpy as np
import pytest

from tribo.closed_forms.ball_on_track import ball_on_track
from tribo.lab import formulas

R = 5e-3


@pytest.mark.parametrize(
    ("k_flat", "low", "within"),
    [(0.0, 0.0, 1e-9), (3.11e-16, 0.03, 5e-3), (1e-10, 1 - 9 * np.pi / 32, 1e-3)],
)
def test_volume_of_a_scar_flat_along_the_track_in_the_rigid_limit(k_flat, low, within):
    coefficients = {"ball_wear_coefficient": 3.11e-16, "flat_wear_coefficient": k_flat}
    worn = ball_on_track([360.0], load=100.0, radius=R, track_length=2e-3, **coefficients)
    along, across = 2 * worn.half_width_along[0], 2 * worn.half_width_across[0]
    volume = formulas.flat_along_ball_volume(along, across, R)
    assert 1 - volume / worn.ball_volume[0] == pytest.approx(low, abs=within)


def test_a_section_is_the_mean_of_its_profiles_and_leaves_piled_up_material_out():
    profiles = [[-1e-6, 2e-6, 1e-6], [-9e-6, 3e-6, 0.0]]
    assert formulas.planimetric_area(profiles, 1e-5) == pytest.approx(3e-11, rel=1e-6, abs=0)
