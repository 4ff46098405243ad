"""The `dcfft` solver: active window, first guess, symmetry."""

from dataclasses import replace

import numpy as np
import pytest
from contact_problems import HARDNESS, MODULUS, ONSET, RADIUS, ball, problem, solver

from tribo.contact.bounded_cg import solve_bounded
from tribo.contact.padded_half_space import HalfSpace
from tribo.core.contact import WearCompliance
from tribo.core.errors import CaseError
from tribo.core.grid import Grid


def _on_window(case, tolerance):
    grid = case.system.grid
    operator = HalfSpace(grid.cells, grid.spacing, case.system.modulus)
    return solve_bounded(
        operator, case.gap, case.load, case.system.cap, case.wear, tolerance=tolerance
    )


def _worn(case):
    unit = case.system.grid.spacing[0] / MODULUS
    nx, ny = case.system.grid.cells
    wear = WearCompliance(np.full((nx, ny), 5 * unit), np.full(ny, unit / 1e-4))
    return replace(case, wear=wear)


@pytest.mark.parametrize(
    "case",
    [
        ball(128, width=2e-3),
        ball(97, width=2e-3),
        ball(128, 1.5 * ONSET, HARDNESS, width=2e-3),
        _worn(ball(128, width=2e-3)),
    ],
    ids=["elastic", "odd", "capped", "worn"],
)
def test_active_window_gives_the_pressure_of_the_whole_window(case):
    boxed, whole = solver(1e-11).solve(case), _on_window(case, 1e-11)
    assert boxed.pressure == pytest.approx(whole.pressure, abs=1e-7 * whole.pressure.max())
    assert boxed.overlap == pytest.approx(whole.overlap, abs=1e-7 * whole.approach)
    assert boxed.approach == pytest.approx(whole.approach, rel=1e-10, abs=0)


def test_contact_far_from_the_start_is_found():
    size, cells = (2e-3, 1e-3), (128, 64)
    x, y = Grid(size, cells).mesh
    left = ((x + 0.6e-3) ** 2 + y**2) / (2 * RADIUS)
    right = ((x - 0.6e-3) ** 2 + y**2) / (2 * RADIUS) + 0.5e-6
    gap = np.minimum(left, right)
    alone = solver().solve(problem(gap, size, 1.0))
    assert not alone.pressure[64:].any()
    both = problem(gap, size, 60.0)
    found = solver(1e-11).solve(both, alone)
    assert found.pressure[64:].any()
    whole = _on_window(both, 1e-11)
    assert found.pressure == pytest.approx(whole.pressure, abs=1e-7 * whole.pressure.max())


def test_same_problem_and_start_give_the_same_bits_whatever_came_between():
    case = ball(96, width=1.2e-3)
    one = solver()
    first = one.solve(case)
    again = one.solve(case, first)
    for cells in range(20, 60, 4):
        one.solve(ball(cells))
    assert np.array_equal(solver().solve(case).pressure, first.pressure)
    assert np.array_equal(one.solve(case, first).pressure, again.pressure)


def test_window_too_small_for_the_load_is_an_error_that_says_so():
    case = ball(48, ONSET, HARDNESS, width=0.9 * float(np.sqrt(ONSET / HARDNESS)))
    for refused in (solver().solve, lambda case: solver().check(case.system)):
        with pytest.raises(CaseError, match=r"bears no more than .* enlarge grid\.size"):
            refused(case)
