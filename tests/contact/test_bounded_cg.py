"""Conjugate gradients with bounds: conditions of contact, iterations, failure."""

from dataclasses import replace

import numpy as np
import pytest
from contact_problems import HARDNESS, MODULUS, ONSET, ball, dense

from tribo.contact.bounded_cg import solve_bounded
from tribo.contact.padded_half_space import HalfSpace
from tribo.contact.residuals import residuals
from tribo.core.contact import WearCompliance
from tribo.core.errors import CaseError, NumericalError

SHAPE, SPACING = (14, 11), (2e-6, 3e-6)


def _on_window(case, start=None):
    grid = case.system.grid
    operator = HalfSpace(grid.cells, grid.spacing, MODULUS)
    return solve_bounded(operator, case.gap, case.load, case.system.cap, start=start)


def _rough(seed, shape):
    return 1e-7 * np.random.default_rng(seed).standard_normal(shape)


VARIED = 0.8 + 2 * np.random.default_rng(4).random(SHAPE)


@pytest.mark.parametrize("cap", [None, 2.0, 1.05, VARIED], ids=["none", "high", "low", "varied"])
@pytest.mark.parametrize("worn", [False, True])
def test_conditions_hold_with_the_dense_matrix(cap, worn):
    gap, load = _rough(3, SHAPE), 0.3
    area = SPACING[0] * SPACING[1]
    limit = None if cap is None else cap * load / (area * gap.size)
    matrix = dense(SHAPE, SPACING)
    wear = None
    if worn:
        rng = np.random.default_rng(5)
        wear = WearCompliance(matrix[0, 0] * rng.random(SHAPE), matrix[0, 0] * 1e5 * np.ones(11))
        j = np.indices(SHAPE)[1].ravel()
        same_row = j[:, None] == j
        matrix = matrix + np.diag(wear.local.ravel()) + wear.swept[j] * SPACING[0] * same_row
    solution = solve_bounded(
        HalfSpace(SHAPE, SPACING, MODULUS), gap, load, limit, wear, tolerance=1e-12
    )
    p = solution.pressure.ravel()
    g = gap.ravel() + matrix @ p - solution.approach
    deep = 1e-11 * np.max(matrix @ p)
    full = np.zeros(p.shape, dtype=bool) if limit is None else p == np.ravel(limit)
    assert p.sum() * area == pytest.approx(load, rel=1e-14, abs=0)
    assert p.min() >= 0
    assert (g[p == 0] > -deep).all()
    assert (np.abs(g[(p > 0) & ~full]) < 1e3 * deep).all()
    assert (g[full] < deep).all()
    assert solution.overlap.ravel()[full] == pytest.approx(-g[full], abs=deep)
    assert not solution.overlap.ravel()[~full].any()


@pytest.mark.parametrize(("load", "cap"), [(100.0, None), (2 * ONSET, HARDNESS)])
def test_iterations_hardly_grow_with_the_grid(load, cap):
    iterations = {}
    for cells in (64, 128, 256):
        case = ball(cells, load, cap, width=2e-3)
        iterations[cells] = _on_window(case).iterations
    # Cold and on the whole window: without preconditioner, fourfold cells cost 1.7 times.
    assert iterations[256] <= 20
    assert iterations[256] <= 1.5 * iterations[64]


def test_a_similar_problem_starts_warm():
    case = ball(128)
    first = _on_window(case)
    worn = case.gap + 1e-9 * first.pressure / first.pressure.max()
    operator = HalfSpace((128, 128), case.system.grid.spacing, MODULUS)
    warm = solve_bounded(operator, worn, case.load, start=first.pressure)
    cold = solve_bounded(operator, worn, case.load)
    assert warm.iterations <= 6 < cold.iterations
    assert warm.pressure == pytest.approx(cold.pressure, abs=1e-5 * cold.pressure.max())
    assert warm.approach == pytest.approx(cold.approach, rel=1e-8, abs=0)


@pytest.mark.parametrize("cap", [1.02, 1.3, 3.0])
@pytest.mark.parametrize("load", [1e-6, 1e-2, 10.0])
def test_rough_surfaces_near_full_plasticity_converge(load, cap):
    shape = (96, 96)
    operator = HalfSpace(shape, (1e-6, 1e-6), MODULUS)
    solution = solve_bounded(operator, _rough(0, shape), load, cap * load / 96**2 / 1e-12)
    assert solution.residuals.worst <= 1e-8
    assert solution.residuals.force <= 1e-14
    # They trade cells between the bounds.
    assert solution.iterations < 110


class _Counted(HalfSpace):
    calls = 0

    def apply(self, pressure):
        self.calls += 1
        return super().apply(pressure)


@pytest.mark.parametrize(("seed", "cap"), [(18, 1.5), (0, None), (0, 1.05)])
def test_an_iteration_costs_one_call_of_the_operator(seed, cap):
    gap, load = _rough(seed, (8, 8)), 2 / 15
    limit = None if cap is None else cap * load / 64e-12
    operator = _Counted((8, 8), (1e-6, 1e-6), MODULUS)
    first = solve_bounded(operator, gap, load, limit)
    assert operator.calls == first.iterations + 1
    # With seed 18 the projected conjugate direction points uphill once.
    other = gap + 0.3 * _rough(seed + 1, (8, 8))
    again = solve_bounded(operator, other, load, limit, start=first.pressure)
    assert operator.calls == first.iterations + again.iterations + 2


def test_an_open_gap_at_the_cap_is_a_residual():
    p, gap = np.array([[2.0, 1.0]]), np.array([[1e-6, 0.0]])
    at_cap = residuals(p, gap, np.full((1, 2), 1e-5), 1e-5, 3.0, 2.0)
    assert at_cap.complementarity == pytest.approx(2.0 * 1e-6 / (3.0 * 1e-5))
    overlapping = residuals(p, -gap, np.full((1, 2), 1e-5), 1e-5, 3.0, 2.0)
    assert overlapping.complementarity == 0.0


def test_not_converging_says_how_far_it_came_and_what_to_do():
    case = ball(64)
    operator = HalfSpace((64, 64), case.system.grid.spacing, MODULUS)
    with pytest.raises(NumericalError, match=r"3 iterations.*residual is .*Raise max_iterations"):
        solve_bounded(operator, case.gap, case.load, max_iterations=3)


@pytest.mark.parametrize(
    ("gap", "load", "error", "match"),
    [
        (0.0, 0.0, CaseError, "the load is 0 N"),
        (np.nan, 1.0, NumericalError, "not finite"),
    ],
)
def test_gap_and_load_are_checked(gap, load, error, match):
    operator = HalfSpace((4, 4), (1e-6, 1e-6), MODULUS)
    with pytest.raises(error, match=match):
        solve_bounded(operator, np.full((4, 4), gap), load)


def test_a_load_that_no_cell_bears_in_rounding_is_said_to_be_too_small():
    case = ball(32)
    with pytest.raises(NumericalError, match="no cell is in contact: the load is so small"):
        _on_window(replace(case, load=1e-50))
