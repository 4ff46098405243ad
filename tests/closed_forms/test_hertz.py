"""Hertz's closed forms, and the solver against them."""

from __future__ import annotations

import numpy as np
import pytest
from contact_problems import HARDNESS, MODULUS, ONSET, RADIUS, ball, problem, solver

from tribo.closed_forms import hertz
from tribo.core.grid import Grid
from tribo.core.measures import contact_area


def test_ball_of_the_paper() -> None:
    contact = hertz.point(MODULUS, 100.0, 1 / RADIUS, 1 / RADIUS)
    assert contact.semi_axes == pytest.approx((148.837e-6, 148.837e-6), rel=3e-6)
    assert contact.peak_pressure == pytest.approx(2.15536e9, rel=3e-6)
    assert contact.approach == pytest.approx(4.43049e-6, rel=3e-6)


def test_circle_is_the_limit_of_ellipses() -> None:
    circle = hertz.point(MODULUS, 100.0, 200.0, 200.0)
    ellipse = hertz.point(MODULUS, 100.0, 200.0, 200.0 * (1 + 1e-9))
    assert ellipse.semi_axes == pytest.approx(circle.semi_axes, rel=1e-8)
    assert ellipse.approach == pytest.approx(circle.approach, rel=1e-8, abs=0)


def test_ellipse_is_longer_where_the_gap_is_flatter() -> None:
    along = hertz.point(MODULUS, 100.0, 1 / 10e-3, 1 / 5e-3)
    assert along.semi_axes == pytest.approx((209.000e-6, 131.795e-6), rel=5e-6)
    assert along.peak_pressure == pytest.approx(1.73338e9, rel=1e-5)
    assert along.approach == pytest.approx(3.92104e-6, rel=3e-6)
    across = hertz.point(MODULUS, 100.0, 1 / 5e-3, 1 / 10e-3)
    assert across.semi_axes == pytest.approx(along.semi_axes[::-1], rel=1e-12, abs=0)


def test_slender_ellipse_is_a_line_contact_in_its_middle() -> None:
    slender = hertz.point(MODULUS, 100.0, 1e-6, 200.0)
    a, b = slender.semi_axes
    middle = 2 * slender.peak_pressure * b * np.pi / 4
    line = hertz.line(MODULUS, middle, 200.0)
    assert b == pytest.approx(line.half_width, rel=1e-5)
    assert a > 1000 * b


def test_line_contact() -> None:
    contact = hertz.line(MODULUS, 1e5, 1 / RADIUS)
    assert contact.half_width == pytest.approx(74.8153e-6, rel=1e-6)
    assert contact.peak_pressure == pytest.approx(850.922e6, rel=1e-6)


def test_load_at_which_the_peak_reaches_the_hardness() -> None:
    load = hertz.load_at_peak(MODULUS, HARDNESS, 1 / RADIUS)
    assert load == pytest.approx(ONSET, rel=1e-12)
    assert load == pytest.approx(639.18, abs=0.01)
    assert hertz.point(MODULUS, load, 200, 200).peak_pressure == pytest.approx(HARDNESS, rel=1e-12)
    assert hertz.first_yield_pressure(HARDNESS) == pytest.approx(2.2857e9, rel=1e-4)


@pytest.mark.parametrize("curvature", [0.0, -1.0, float("nan")])
def test_point_contact_needs_convex_gaps(curvature: float) -> None:
    with pytest.raises(ValueError, match="curvature_y"):
        hertz.point(MODULUS, 100.0, 200.0, curvature)


def _l2_error(cells: int) -> float:
    case = ball(cells)
    exact = hertz.point(MODULUS, 100.0, 1 / RADIUS, 1 / RADIUS)
    x, y = case.system.grid.mesh
    inside = np.maximum(0.0, 1 - (x**2 + y**2) / exact.semi_axes[0] ** 2)
    field = exact.peak_pressure * np.sqrt(inside)
    error = solver().solve(case).pressure - field
    return float(np.sqrt((error**2).sum() / (field**2).sum()))


def test_pressure_of_a_ball_converges_at_first_order() -> None:
    # √(distance) at the edge of contact bounds the order in L2 by one.
    errors = [_l2_error(n) for n in (40, 80, 160, 320)]
    order = -np.polyfit(np.log([1, 2, 4, 8]), np.log(errors), 1)[0]
    assert order > 0.9
    assert errors[-1] < 3e-3


def test_ball_has_hertz_peak_approach_and_radius() -> None:
    exact = hertz.point(MODULUS, 100.0, 1 / RADIUS, 1 / RADIUS)
    case = ball(192)
    solution = solver().solve(case)
    radius = np.sqrt(contact_area(solution.pressure, case.system.grid) / np.pi)
    assert solution.pressure.max() == pytest.approx(exact.peak_pressure, rel=1e-3)
    assert solution.approach == pytest.approx(exact.approach, rel=2e-4)
    # Counted cells overestimate the area by about a third of the perimeter's cells.
    assert radius == pytest.approx(exact.semi_axes[0], rel=0.01)


def test_ellipse_has_hertz_peak_approach_and_axes() -> None:
    exact = hertz.point(MODULUS, 100.0, 1 / 10e-3, 1 / 5e-3)
    case = ball(192, radii=(10e-3, 5e-3))
    solution = solver().solve(case)
    touching = solution.pressure > 0
    extents = [0.5 * np.count_nonzero(touching.any(axis=k)) * 0.8e-3 / 192 for k in (1, 0)]
    assert solution.pressure.max() == pytest.approx(exact.peak_pressure, rel=1e-3)
    assert solution.approach == pytest.approx(exact.approach, rel=2e-4)
    assert extents == pytest.approx(exact.semi_axes, abs=0.8e-3 / 192)


def test_middle_of_a_long_cylinder_is_a_line_contact() -> None:
    # The window ends the cylinder, where pressure rises; the middle section, twenty
    # half-widths away, is judged by the line load it carries itself.
    size, cells = (0.3e-3, 3e-3), (96, 120)
    x, y = Grid(size, cells).mesh
    pressure = solver().solve(problem(x**2 / (2 * RADIUS) + 0 * y, size, 300.0)).pressure
    middle = pressure[:, 59]
    exact = hertz.line(MODULUS, middle.sum() * size[0] / cells[0], 1 / RADIUS)
    extent = 0.5 * np.count_nonzero(middle) * size[0] / cells[0]
    assert middle.max() == pytest.approx(exact.peak_pressure, rel=2e-3)
    assert extent == pytest.approx(exact.half_width, abs=size[0] / cells[0])


def _punch_error(cells: int) -> float:
    radius, load, width = 0.3e-3, 100.0, 0.8e-3
    x, y = Grid((width, width), (cells, cells)).mesh
    gap = np.where(x**2 + y**2 < radius**2, 0.0, 1e-3)
    case = problem(gap, (width, width), load)
    # The staircase stands for a disc of its own area, not quite of the nominal radius.
    drawn = np.sqrt(np.count_nonzero(gap == 0) * case.system.grid.cell_area / np.pi)
    return solver().solve(case).approach / (load / (2 * MODULUS * drawn)) - 1


def test_flat_punch_sinks_by_load_over_diameter_and_modulus() -> None:
    errors = [abs(_punch_error(n)) for n in (40, 80, 160, 320)]
    # First order, for the pressure is singular at the rim.
    assert errors[-1] < 1.5e-3
    assert -np.polyfit(np.log([1, 2, 4, 8]), np.log(errors), 1)[0] > 0.9


def test_cone() -> None:
    slope, width, cells = 0.02, 0.8e-3, 256
    radius = 0.2e-3
    load = 0.5 * np.pi * MODULUS * radius**2 * slope
    x, y = Grid((width, width), (cells, cells)).mesh
    case = problem(slope * np.hypot(x, y), (width, width), load)
    solution = solver().solve(case)
    found = np.sqrt(contact_area(solution.pressure, case.system.grid) / np.pi)
    assert solution.approach == pytest.approx(0.5 * np.pi * radius * slope, rel=2e-3)
    assert found == pytest.approx(radius, rel=0.01)
