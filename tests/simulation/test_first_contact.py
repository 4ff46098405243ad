"""The contact before any sliding, as a result reports it."""

import pytest
from paper_models import motion, small

from tribo import Grid, Simulation

HERTZ = 4.43049e-6


@pytest.mark.parametrize("cells", [(48, 48), (49, 49), (64, 64), (65, 65), (64, 49)])
def test_the_approach_is_hertzs_wherever_the_apex_lies_between_cells(cells):
    """On even grids the lowest cells are half a cell off the apex, Δ²/4R below it."""
    model = small(grid=Grid((0.7e-3, 0.7e-3), cells), kinematics=motion(duration=0.01))
    first = Simulation(model.case).run().saves()[0]
    # The contact is 20 cells wide: its pressures are good to a few parts in 10⁴.
    assert first["approach_m"] == pytest.approx(HERTZ, rel=6e-4, abs=0)
