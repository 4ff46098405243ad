"""Sliding while yielding: the cap holds, the groove is the envelope, nothing yields twice."""

import numpy as np
import pytest
from paper_models import archard, motion, pair, small, states

from tribo import Grid, Load, Measured, Stage
from tribo.core.contact import ContactProblem
from tribo.stepping.contacts import undeformed
from tribo.stepping.step import start_sliding

HARDNESS = 4e9


def yielding(load=1000.0, hardness=("4 GPa", "4 GPa"), **changes):
    parts = {
        "grid": Grid((1.2e-3, 1.2e-3), (60, 60)),
        "load": load,
        "bodies": pair(archard(), archard(), hardness=hardness),
        "kinematics": motion(duration=50),
    }
    return small(**{**parts, **changes})


@pytest.fixture(scope="module")
def run():
    model = yielding()
    return model, states(model)


def test_the_cap_holds_in_every_state(run):
    for state in run[1]:
        assert state.contact.pressure.max() <= HARDNESS * (1 + 1e-12)
        assert state.contact.residuals.force < 1e-12


@pytest.mark.parametrize("part", [0.25, 0.5])
def test_a_lighter_contact_on_the_groove_is_elastic(run, part):
    model, all_states = run
    settled = start_sliding(model, all_states[0])
    lighter = model.case.contact.solve(
        ContactProblem(
            model.contact.system, undeformed(model, settled)[0], part * model.contact.system.load
        )
    )
    assert lighter.pressure.max() < HARDNESS
    assert lighter.overlap.max() == 0


def test_wear_takes_the_pressure_below_the_cap_for_good(run):
    pressures = [state.contact.pressure.max() for state in run[1]]
    assert pressures[0] == pytest.approx(HARDNESS)
    assert pressures[-1] < 0.9 * HARDNESS
    depths = [state.bodies["disk"].plastic.max() for state in run[1]]
    assert depths[-1] == depths[1]


def test_every_pressure_belongs_to_the_geometry_saved_with_it(run):
    model, all_states = run
    for state in (all_states[0], all_states[1], all_states[-1]):
        again = model.case.contact.solve(
            ContactProblem(
                model.contact.system, undeformed(model, state)[0], model.contact.system.load
            )
        )
        np.testing.assert_allclose(
            again.pressure, state.contact.pressure, atol=1e-4 * state.contact.pressure.max()
        )
        assert again.overlap.max() <= 1e-5 * state.bodies["disk"].plastic.max()


@pytest.mark.slow
def test_a_load_that_rises_before_it_slides_presses_in_where_the_first_one_did():
    grid = Grid((0.8e-3, 0.6e-3), (24, 20))
    end = 6 * grid.spacing[0]
    path = [(0, -end), (5, -end), (6, end)]
    bodies = pair(hardness=(None, 1.2e9))

    def pressed(load):
        kinematics = Measured(path=path, positions=13)
        model = small(grid=grid, bodies=bodies, kinematics=kinematics, load=load, save_times=(3, 5))
        resting = [state for state in states(model) if state.distance == 0]
        return resting[-1].bodies["disk"].plastic

    rising = Load(normal=(Stage(until=1, normal=50), Stage(until=6, normal=100)))
    at_once, risen = pressed(100), pressed(rising)
    np.testing.assert_allclose(risen, at_once, atol=1e-6 * at_once.max())
