"""A law that knows the place of each point on its own body."""

import numpy as np
import pytest
from paper_models import K, foundation, last, motion, pair, small

from tribo import CaseError, Grid, LocalConditions, WearLaw, WearRate

GRID = Grid((1.2e-3, 0.75e-3), (32, 20))


class HalfHard(WearLaw):
    """Archard's law where x > 0, and no wear elsewhere."""

    type = "test.half_hard"
    requires = ("place_x", "place_y")

    def rate(self, local: LocalConditions) -> WearRate:
        k = np.where(local.fields["place_x"] > 0, K, 0.0)
        return WearRate(k * local.pressure, k)


def sliding(positions):
    kinematics = motion(stroke=12 * GRID.spacing[0], duration=60, positions=positions)
    bodies = pair(HalfHard(), HalfHard())
    return small(grid=GRID, contact=foundation(), kinematics=kinematics, bodies=bodies)


def test_the_same_points_of_a_body_wear_wherever_they_pass():
    model = sliding("cells")
    state = last(model)
    for name, rows in (("ball", 32), ("disk", 44)):
        wear = state.bodies[name].wear
        assert wear.shape == (rows, 20)
        assert not wear[: rows // 2].any()
        assert wear[rows // 2].max() > 0


def test_an_averaged_body_has_no_places_for_a_law():
    with pytest.raises(CaseError, match=r"bodies\.disk\.wear: 'test\.half_hard' wears places"):
        sliding("average")
