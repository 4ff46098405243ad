"""The traction of a contact that is dragged, against closed forms."""

import numpy as np
import pytest
from fretting_problems import LOAD, MU, RADIUS, ball
from tribo import ContactProblem, ContactSystem, DcFft, Grid, Material

from tribo_fretting.cerruti import cerruti, tangential_compliances
from tribo_fretting.closed_forms import (
    force_ratio,
    loop_energy,
    shift,
    stick_radius,
    worn_load_share,
)
from tribo_fretting.jaeger import first_loading
from tribo_fretting.projected_cg import dragged

SLIDING = MU * LOAD
SOLVER = DcFft(tolerance=1e-11)


def test_closed_forms_give_the_numbers_of_mindlin_and_cattaneo():
    steel = ball(8)
    a, c = steel.contact_radius, steel.compliance
    assert a == pytest.approx(187.523e-6, rel=1e-5, abs=0)
    for ratio, moved, energy, stuck in (
        (0.5, 948.044e-9, 4.33087e-6, 0.79370),
        (0.9, 2010.04e-9, 49.3428e-6, 0.46416),
    ):
        assert shift(ratio, SLIDING, a, c) == pytest.approx(moved, rel=2e-5, abs=0)
        assert force_ratio(moved, SLIDING, a, c) == pytest.approx(ratio, rel=2e-5, abs=0)
        assert loop_energy(ratio, SLIDING, a, c) == pytest.approx(energy, rel=2e-5, abs=0)
        assert stick_radius(ratio, a) == pytest.approx(stuck * a, rel=2e-5, abs=0)
    # Where all sticks the ball bears its load.
    assert worn_load_share(1.0) == 1.0


@pytest.mark.parametrize("ratio", [0.5, 0.9])
def test_mindlins_loop_is_met_with_order_two(ratio):
    errors = []
    for cells in (32, 64, 128):
        steel = ball(cells)
        moved = shift(ratio, SLIDING, steel.contact_radius, steel.compliance)
        drag = steel.dragged(moved)
        energy = loop_energy(ratio, SLIDING, steel.contact_radius, steel.compliance)
        found = steel.force(drag) / (ratio * SLIDING), steel.energy(drag) / energy
        errors.append(np.abs(np.array(found) - 1))
        stuck = (drag.slip == 0) & (steel.pressure > 0)
        radius = np.sqrt(np.sum(stuck) * steel.grid.cell_area / np.pi)
        off = radius - stick_radius(ratio, steel.contact_radius)
        assert abs(off) <= 0.2 * steel.grid.spacing[0]
        assert drag.iterations <= 22
    coarse, middle, fine = errors
    assert np.all(middle <= [2e-4, 2e-3])
    assert np.all(np.log2(coarse / fine) / 2 >= [1.2, 1.8])
    assert fine[0] <= 1e-5


def test_with_both_components_points_slip_across_too():
    steel = ball(64)
    for ratio, force, energy in ((0.5, 3e-4, -0.004), (0.9, 3e-4, -0.003)):
        moved = shift(ratio, SLIDING, steel.contact_radius, steel.compliance)
        one, two = (steel.dragged(moved, components=components) for components in (1, 2))
        assert steel.force(two) / steel.force(one) - 1 == pytest.approx(force, abs=3e-4)
        assert steel.energy(two) / steel.energy(one) - 1 == pytest.approx(energy, abs=0.003)
        size = np.hypot.reduce(two.traction)
        assert np.all(size <= MU * steel.pressure * (1 + 1e-12))
        assert 0.02 <= np.max(np.abs(two.traction[1])) / size.max() <= 0.2
        assert two.iterations <= 42


def test_ciavarella_and_jaeger_are_met_without_poissons_ratio():
    cork = ball(64, poisson=0.0)
    moved, traction = first_loading(SOLVER, cork.problem, 0.5, MU, 1.0)
    drag = cork.dragged(moved)
    assert drag.traction[0] == pytest.approx(traction, abs=1e-5 * traction.max())
    slips = traction == MU * cork.pressure
    assert np.array_equal(drag.slip > 0, slips & (cork.pressure > 0))


def test_tractions_and_energy_go_on_from_partial_to_gross_slip():
    steel = ball(32)
    gross = shift(1.0, SLIDING, steel.contact_radius, steel.compliance)
    for components in (1, 2):
        parts = np.linspace(0.9, 1.1, 41)
        drags = [steel.dragged(part * gross, components=components) for part in parts]
        forces, energies = (np.array([f(d) for d in drags]) for f in (steel.force, steel.energy))
        assert forces[-1] == pytest.approx(SLIDING, rel=1e-3, abs=0)
        assert np.all(np.diff(forces) >= -1e-7 * SLIDING)
        assert np.max(np.diff(forces)) <= 0.005 * SLIDING
        steps = np.diff(energies)
        assert np.all(steps > 0)
        assert np.max(steps) <= 1.3 * 4 * SLIDING * 0.005 * gross
        assert max(drag.iterations for drag in drags) <= 42
        # In gross slip each further metre dissipates the whole force of friction.
        assert steps[-1] == pytest.approx(4 * SLIDING * 0.005 * gross, rel=2e-3, abs=0)


def test_a_long_cylinder_sticks_as_by_ciavarella_and_jaeger():
    material = Material(young="207 GPa", poisson=0.3)
    grid = Grid((0.4e-3, 6e-3), (96, 24))
    system = ContactSystem(grid, 0.5 * material.young / 0.91, 1200.0)
    gap = np.broadcast_to(grid.mesh[0] ** 2 / (2 * RADIUS), grid.cells)
    problem = ContactProblem(system, gap, 1200.0)
    limit = MU * SOLVER.solve(problem).pressure
    operator = cerruti(grid.cells, grid.spacing, tangential_compliances([material, material]), 1)
    middle = np.s_[:, grid.cells[1] // 2]
    drag = dragged(operator, 1.6e-6, limit)
    found = drag.traction[0][middle]
    ratio = np.sum(found) / np.sum(limit[middle])
    assert 0.3 <= ratio <= 0.8
    _, traction = first_loading(SOLVER, problem, ratio, MU, 1.0)
    assert np.sqrt(np.mean((found - traction[middle]) ** 2)) <= 0.02 * np.max(traction)
    # c/a = √(1 − Q/μP), after Cattaneo.
    pressed = np.count_nonzero(limit[middle])
    stuck = pressed - np.count_nonzero(drag.slip[middle])
    assert 0.5 * stuck == pytest.approx(0.5 * pressed * np.sqrt(1 - ratio), abs=0.6)
