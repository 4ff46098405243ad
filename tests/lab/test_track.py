"""What a track has lost, against integrals of the shapes the formulas stand for."""

import numpy as np
import pytest
from scipy.integrate import quad

from tribo.lab import track
from tribo.lab.ball import ball_cap_volume

R = 5e-3


def test_groove_radius_and_area_belong_to_a_parabola():
    curved, width = 8e-3, 1e-3
    area, _ = quad(lambda y: (width**2 / 4 - y**2) / (2 * curved), -width / 2, width / 2)
    assert track.groove_radius(width, area) == pytest.approx(curved, rel=1e-10, abs=0)


def test_circular_groove_area_is_the_integral_of_its_section():
    d = 2e-3
    bottom = np.sqrt(R**2 - d**2 / 4)
    area, _ = quad(lambda y: np.sqrt(R**2 - y**2) - bottom, -d / 2, d / 2)
    assert track.circular_groove_area(d, R) == pytest.approx(area, rel=1e-9, abs=0)
    assert track.disk_track_volume(d, R, 0.02) == pytest.approx(
        2 * np.pi * 0.02 * area, rel=1e-9, abs=0
    )
    whole = 0.01 * area + ball_cap_volume(d, R)
    assert track.reciprocating_track_volume(d, R, 0.01) == pytest.approx(whole, rel=1e-9, abs=0)


def test_block_volume_is_the_integral_of_a_circular_segment():
    D, t, b = 35e-3, 6.35e-3, 3e-3
    bottom = np.sqrt(D**2 - b**2) / 2
    area, _ = quad(lambda y: np.sqrt(D**2 / 4 - y**2) - bottom, -b / 2, b / 2)
    assert track.block_on_ring_volume(b, D, t) == pytest.approx(area * t, rel=1e-8, abs=0)


def test_planimetric_area_leaves_piled_up_material_out():
    assert track.planimetric_area([-1e-6, 2e-6, 3e-6, -1e-6], 1e-5) == pytest.approx(
        5e-11, rel=1e-6, abs=0
    )
    assert track.planimetric_volume(5e-11, 2e-3) == pytest.approx(1e-13, rel=1e-6, abs=0)


def test_planimetric_area_of_several_profiles_is_their_mean():
    profiles = [[1e-6, 2e-6], [3e-6, -4e-6]]
    assert track.planimetric_area(profiles, 1e-5) == pytest.approx(3e-11, rel=1e-6, abs=0)
