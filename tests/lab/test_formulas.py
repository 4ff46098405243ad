"""A lab's formulas; `tribo verify` sums up the shapes that they stand for."""

import pytest

from tribo.lab import formulas


def test_a_section_is_the_mean_of_its_profiles_and_leaves_piled_up_material_out():
    profiles = [[-1e-6, 2e-6, 1e-6], [-9e-6, 3e-6, 0.0]]
    assert formulas.planimetric_area(profiles, 1e-5) == pytest.approx(3e-11, rel=1e-6, abs=0)
