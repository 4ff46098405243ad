"""The traction of a contact that is dragged, against closed forms."""

import numpy as np
import pytest
from fretting_problems import LOAD, MU, ball
from tribo import DcFft

from tribo_fretting.closed_forms import (
    force_ratio,
    loop_energy,
    shift,
    stick_radius,
    worn_load_share,
)
from tribo_fretting.jaeger import first_loading

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
    assert [worn_load_share(stuck) for stuck in (0.5, 1.0)] == [0.6875, 1.0]


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
