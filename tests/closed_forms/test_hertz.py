"""Hertz's closed forms against known figures; rows of `tribo verify` hold the solver to them."""

import numpy as np
import pytest
from contact_problems import HARDNESS, MODULUS, RADIUS

from tribo.closed_forms import hertz


def test_ball_of_the_paper():
    contact = hertz.point(MODULUS, 100.0, 1 / RADIUS, 1 / RADIUS)
    assert contact.semi_axes == pytest.approx((148.837e-6, 148.837e-6), rel=3e-6)
    assert contact.peak_pressure == pytest.approx(2.15536e9, rel=3e-6)
    assert contact.approach == pytest.approx(4.43049e-6, rel=3e-6)


def test_ellipse_is_longer_where_the_gap_is_flatter():
    along = hertz.point(MODULUS, 100.0, 1 / 10e-3, 1 / 5e-3)
    assert along.semi_axes == pytest.approx((209.000e-6, 131.795e-6), rel=5e-6)
    assert along.peak_pressure == pytest.approx(1.73338e9, rel=1e-5)
    assert along.approach == pytest.approx(3.92104e-6, rel=3e-6)
    across = hertz.point(MODULUS, 100.0, 1 / 5e-3, 1 / 10e-3)
    assert across.semi_axes == pytest.approx(along.semi_axes[::-1], rel=1e-12, abs=0)


def test_slender_ellipse_is_a_line_contact_in_its_middle():
    slender = hertz.point(MODULUS, 100.0, 1e-6, 200.0)
    a, b = slender.semi_axes
    middle = 2 * slender.peak_pressure * b * np.pi / 4
    line = hertz.line(MODULUS, middle, 200.0)
    assert b == pytest.approx(line.half_width, rel=1e-5)
    assert a > 1000 * b


def test_line_contact():
    contact = hertz.line(MODULUS, 1e5, 1 / RADIUS)
    assert contact.half_width == pytest.approx(74.8153e-6, rel=1e-6)
    assert contact.peak_pressure == pytest.approx(850.922e6, rel=1e-6)


def test_the_peak_reaches_the_hardness_at_the_known_load():
    contact = hertz.point(MODULUS, 639.18, 1 / RADIUS, 1 / RADIUS)
    assert contact.peak_pressure == pytest.approx(HARDNESS, rel=1e-5)
    assert hertz.first_yield_pressure(HARDNESS) == pytest.approx(2.2857e9, rel=1e-4)


@pytest.mark.parametrize("curvature", [0.0, float("nan")])
def test_point_contact_needs_convex_gaps(curvature):
    with pytest.raises(ValueError, match="curvature_y"):
        hertz.point(MODULUS, 100.0, 200.0, curvature)
