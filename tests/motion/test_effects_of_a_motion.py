"""Effects that a motion brings along."""

import pytest
from paper_models import small

from tribo.core.errors import CaseError
from tribo.core.fields import LOCAL_SLIP
from tribo.effects.effect import Effect
from tribo.motion.reciprocating import Reciprocating


class Half(Effect):
    """Every point slips half of the motion."""

    type = "test.half"
    provides = (LOCAL_SLIP,)


class Shakes(Reciprocating):
    """A motion in which points slip half of it."""

    type = "test.shakes"

    def effects(self):
        return [Half()]


SHAKES = Shakes(stroke="2 mm", frequency=25, duration=200, positions="average")


def test_one_of_the_motion_and_one_of_the_case_may_not_provide_the_same():
    with pytest.raises(CaseError, match="local_slip"):
        small(kinematics=SHAKES, effects=[Half()])
