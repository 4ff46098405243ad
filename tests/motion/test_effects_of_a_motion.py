"""Effects that a motion brings along, and what an effect is told of the contact."""

import pytest
from paper_models import foundation, last, small

from tribo.core.errors import CaseError
from tribo.core.fields import LOCAL_SLIP
from tribo.effects.effect import Effect
from tribo.motion.reciprocating import Reciprocating


class Half(Effect):
    """Every point slips half of the motion; on half-spaces alone."""

    type = "test.half"
    provides = (LOCAL_SLIP,)

    def check(self, system, swept, solver):
        if solver != "dcfft" or system.coatings:
            raise CaseError(f"{solver!r} on {system.grid.cells} has no half-space")

    def fields(self, contact):
        slip = 0.5 + 0.0 * contact.pressure
        return {"local_slip": dict.fromkeys(contact.system.materials, slip)}


class Shakes(Reciprocating):
    """A motion in which points slip half of it."""

    type = "test.shakes"

    def effects(self):
        return [Half()]


SHAKES = Shakes(stroke="2 mm", frequency=25, duration=200, positions="average")


def test_an_effect_of_the_motion_acts_as_one_of_the_case():
    brought = last(small(kinematics=SHAKES))
    given = last(small(effects=[Half()]))
    for name, body in given.bodies.items():
        assert brought.bodies[name].wear.tobytes() == body.wear.tobytes()


def test_one_of_the_motion_and_one_of_the_case_may_not_provide_the_same():
    with pytest.raises(CaseError, match="local_slip"):
        small(kinematics=SHAKES, effects=[Half()])


def test_an_effect_refuses_a_contact_that_it_cannot_serve():
    with pytest.raises(CaseError, match="winkler"):
        small(effects=[Half()], contact=foundation())
