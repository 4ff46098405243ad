"""The section of a track from profiles; the formulas' shapes are summed up in `tribo verify`."""

import pytest

from tribo.lab import track


def test_planimetric_area_leaves_piled_up_material_out():
    assert track.planimetric_area([-1e-6, 2e-6, 3e-6, -1e-6], 1e-5) == pytest.approx(
        5e-11, rel=1e-6, abs=0
    )
    assert track.planimetric_volume(5e-11, 2e-3) == pytest.approx(1e-13, rel=1e-6, abs=0)


def test_planimetric_area_of_several_profiles_is_their_mean():
    profiles = [[1e-6, 2e-6], [3e-6, -4e-6]]
    assert track.planimetric_area(profiles, 1e-5) == pytest.approx(3e-11, rel=1e-6, abs=0)
