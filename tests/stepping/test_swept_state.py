"""What lies on a body that passes changes along its whole track."""

import pytest
from paper_models import last, motion, small

from tribo import CaseError, Effect, Field


class Oxide(Effect):
    """Oxide grows in air."""

    type = "test.oxide"
    state_fields = (Field("oxide", "m", "Height of oxide.", at_least=0),)

    def carrier(self):
        return "disk"

    def state_rates(self, contact):
        return {"oxide": 1e-9}


def test_positions_that_do_not_tell_are_refused():
    with pytest.raises(CaseError, match="changes on 'disk' under no pressure"):
        last(small(effects=[Oxide()], kinematics=motion(positions=33)))
