"""Elastic-perfectly-plastic contact: pressure capped at the hardness."""

from __future__ import annotations

import numpy as np
import pytest
from contact_problems import HARDNESS, MODULUS, ONSET, RADIUS, ball, solver

from tribo.closed_forms import hertz
from tribo.core.contact import ContactProblem, ContactSolution
from tribo.core.errors import CaseError


def _solved(factor: float) -> tuple[ContactProblem, ContactSolution]:
    load = factor * ONSET
    radius = hertz.point(MODULUS, load, 1 / RADIUS, 1 / RADIUS).semi_axes[0]
    # An odd count, so that a cell lies on the axis, where the indent is deepest.
    case = ball(129, load, HARDNESS, width=4 * radius)
    return case, solver().solve(case)


@pytest.mark.parametrize(
    ("factor", "area", "approach", "depth"),
    [(1.5, 1.329, 1.003, 0.843e-6), (2, 1.225, 1.011, 2.164e-6), (5, 1.051, 1.076, 12.548e-6)],
)
def test_capped_ball_has_the_area_approach_and_depth_of_an_independent_solver(
    factor: float, area: float, approach: float, depth: float
) -> None:
    case, solution = _solved(factor)
    elastic = hertz.point(MODULUS, case.load, 1 / RADIUS, 1 / RADIUS).approach
    cells = np.count_nonzero(solution.pressure) * case.system.grid.cell_area
    # The reference is one grid of 128 cells: its counted area depends on where the rim
    # falls between cells, and its deepest cell lies half a cell off the axis.
    assert cells * HARDNESS / case.load == pytest.approx(area, rel=5e-3)
    assert solution.approach / elastic == pytest.approx(approach, abs=6e-4)
    assert solution.overlap.max() == pytest.approx(depth, rel=1.5e-3)
    assert solution.pressure.max() == HARDNESS


@pytest.mark.parametrize("room", [1.0, 1.0001, 1.02])
def test_window_that_just_bears_the_load_is_nearly_all_at_the_cap(room: float) -> None:
    width = np.sqrt(room * ONSET / HARDNESS)
    case = ball(48, ONSET, HARDNESS, width=float(width) * (1 + 1e-12))
    solution = solver().solve(case)
    full = np.count_nonzero(solution.pressure == HARDNESS) / case.gap.size
    # With a fiftieth to spare, the corners may bear a little less than the cap.
    assert full > (0.99 if room < 1.01 else 0.8)
    assert solution.residuals.worst <= 1e-8


def test_window_too_small_for_the_load_is_an_error_that_says_so() -> None:
    case = ball(48, ONSET, HARDNESS, width=0.9 * float(np.sqrt(ONSET / HARDNESS)))
    with pytest.raises(CaseError, match=r"bears no more than .* Enlarge the window"):
        solver().solve(case)
    with pytest.raises(CaseError, match="Enlarge the window"):
        solver().check(case.system)
