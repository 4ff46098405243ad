"""Sliding while yielding: nothing yields twice, and a load that rises at rest yields at once."""

import numpy as np
import pytest
from paper_models import archard, motion, pair, small, states

from tribo import Grid, Load, Measured, Stage
from tribo.core.contact import ContactProblem
from tribo.stepping.contacts import undeformed


def test_every_pressure_belongs_to_the_geometry_saved_with_it():
    model = small(
        grid=Grid((1.2e-3, 1.2e-3), (60, 60)),
        load=1000.0,
        bodies=pair(archard(), archard(), hardness=("4 GPa", "4 GPa")),
        kinematics=motion(duration=50),
    )
    all_states = states(model)
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
