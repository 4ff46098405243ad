"""The positions of a cycle solved as one contact problem."""

import numpy as np
import pytest
from contact_problems import ball

from tribo import DcFft, Grid, HalfSpace, Periodic
from tribo.contact.operator import WornOperator
from tribo.contact.preconditioner import Preconditioner
from tribo.core.contact import ContactProblem, ContactSystem, CycleCompliance

CELLS = (24, 20)
GRID = Grid((0.96e-3, 0.8e-3), CELLS)
SHARES = np.array([0.15, 0.5, 0.35])
PLACES = ((6, 0), (4, 3), (0, -2))
MODULUS, LOADS = 1.1e11, (20.0, 35.0, 26.0)


def rough_gaps(seed=0):
    x, y = GRID.mesh
    waves = np.random.default_rng(seed).standard_normal((3, *CELLS))
    return (x**2 + y**2) / 10e-3 + 2e-8 * waves


def coupling(size, rows=30):
    rng = np.random.default_rng(1)
    stays, passes = (size * (0.5 + rng.random((n, CELLS[1]))) for n in (CELLS[0], rows))
    return CycleCompliance(SHARES, [(stays, ((0, 0),) * 3), (passes, PLACES)], slice(0, CELLS[0]))


def problems(gaps, cap=None):
    system = ContactSystem(GRID, MODULUS, max(LOADS), cap)
    return [ContactProblem(system, gap, load) for gap, load in zip(gaps, LOADS, strict=True)]


def solved(solver, given, wear=None):
    return solver.solve_cycle(given, [solver.solve(each) for each in given], wear)


def pressures(contacts):
    return np.stack([contact.pressure for contact in contacts])


def test_the_coupling_is_symmetric_in_the_shares():
    wear = coupling(1e-15)
    p, q = np.random.default_rng(2).random((2, 3, *CELLS))
    weights = SHARES[:, None, None]
    there, back = (np.sum(weights * a * wear.depth(b, 1.0)) for a, b in ((p, q), (q, p)))
    assert there == pytest.approx(back, rel=1e-12, abs=0)
    assert np.sum(weights * p * wear.depth(p, 1.0)) > 0


@pytest.mark.parametrize(("least", "most", "wears"), [(0.5, 3.0, True), (0.5, 15.0, False)])
def test_its_preconditioner_nearly_inverts_it_within_a_box(least, most, wears):
    worn = WornOperator(HalfSpace(CELLS, GRID.spacing, MODULUS), coupling(1e-15))
    estimate = Preconditioner(worn)
    estimate.wears = wears
    inside = np.zeros((3, *CELLS), dtype=bool)
    # A box leaves a margin around the contact.
    inside[:, 2:-2, 2:-2] = True
    product, inverse = [], []
    for cell in np.flatnonzero(inside):
        one = np.zeros((3, *CELLS))
        one.flat[cell] = 1.0
        product.append(worn.apply(one)[inside])
        inverse.append(estimate(one)[inside])
    weights = np.broadcast_to(SHARES[:, None, None], inside.shape)[inside, None]
    symmetric = weights * np.transpose(inverse)
    assert np.max(np.abs(symmetric - symmetric.T)) <= 1e-12 * np.max(np.abs(symmetric))
    values = np.linalg.eigvals(np.transpose(inverse) @ np.transpose(product)).real
    assert least < values.min()
    assert 0.7 * most < values.max() < most


def test_its_depth_is_what_each_body_has_lost_under_the_window():
    wear, p = coupling(1e-15), np.random.default_rng(3).random((3, *CELLS))
    (stays, _), (passes, _) = wear.bodies
    lost = np.zeros((30, CELLS[1]))
    # Columns are counted round.
    for share, (row, column), each in zip(SHARES, PLACES, p, strict=True):
        lost[row : row + CELLS[0]] += share * np.roll(each, column, axis=1)
    lost *= passes
    stayed = stays * np.tensordot(SHARES, p, axes=1)
    needed = [stayed + np.roll(lost[r : r + CELLS[0]], -c, axis=1) for r, c in PLACES]
    np.testing.assert_allclose(wear.depth(p, 1.0), needed, rtol=1e-12)


@pytest.mark.parametrize("solver", [DcFft(tolerance=1e-11), Periodic(tolerance=1e-11)])
@pytest.mark.parametrize("cap", [None, 1.2e9])
def test_each_position_is_in_contact_with_what_all_of_them_wear(solver, cap):
    given = problems(rough_gaps(), cap)
    if solver.periodic:
        wear = coupling(5e-16, rows=CELLS[0])
        wear = CycleCompliance(
            SHARES, [(c, ((0, 0), (3, 1), (-5, 0))) for c, _ in wear.bodies], wear.rows
        )
    else:
        wear = coupling(5e-16)
    contacts = solved(solver, given, wear)
    worn = wear.depth(pressures(contacts), GRID.spacing[0])
    again = [
        solver.solve(ContactProblem(each.system, each.gap + depth, each.load))
        for each, depth in zip(given, worn, strict=True)
    ]
    found, needed = pressures(contacts), pressures(again)
    assert np.max(np.abs(found - needed)) <= 1e-6 * np.max(needed)
    for one, other in zip(contacts, again, strict=True):
        assert one.approach == pytest.approx(other.approach, rel=1e-7, abs=1e-14)
        np.testing.assert_allclose(one.overlap, other.overlap, atol=1e-7 * abs(other.approach))


def test_a_box_grows_to_what_any_position_touches():
    solver, x = DcFft(tolerance=1e-11), GRID.mesh[0]
    given = problems([ball(24, 1.0, width=0.96e-3).gap[:, 2:-2]] * 3)
    apart = [
        ContactProblem(each.system, each.gap + slope * x, each.load)
        for each, slope in zip(given, (-0.05, 0.0, 0.05), strict=True)
    ]
    start = [solver.solve(given[1])] * 3
    found = pressures(solver.solve_cycle(apart, start))
    needed = pressures(map(solver.solve, apart))
    assert np.max(np.abs(found - needed)) <= 1e-7 * np.max(needed)


def test_a_solver_of_ones_own_takes_them_one_by_one():
    class Own(DcFft):
        type = "test.own"

        def solve(self, problem, start=None):
            return DcFft.solve(self, problem, start)

    assert DcFft.couples
    assert not Own.couples
    assert Own.solve_cycle is not DcFft.solve_cycle
