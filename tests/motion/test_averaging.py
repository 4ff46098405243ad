"""Where an average over a track does not hold."""

import pytest
from paper_models import motion, small

from tribo.core.errors import CaseError
from tribo.motion.closed_track import Unidirectional
from tribo.simulation.march import begin


@pytest.mark.parametrize(
    "kinematics",
    [
        motion(stroke="0.1 mm", positions="average"),
        Unidirectional(speed=0.1, distance=1, track_length="0.1 mm"),
    ],
)
def test_a_track_under_one_half_width_is_not_averaged(kinematics):
    with pytest.raises(CaseError, match=r"0\.1 mm, less than the half-width") as refused:
        begin(small(kinematics=kinematics))
    assert refused.value.path == "kinematics"
