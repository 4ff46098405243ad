"""What lies on a body that passes changes along its whole track, in the window and beyond."""

import numpy as np
import pytest
from paper_models import foundation, last, motion, small

from tribo import CaseError, Effect, Field, Grid


class Oxide(Effect):
    """Oxide grows in air, and a pressure scrapes it off."""

    type = "test.oxide"
    state_fields = (Field("oxide", "m", "Height of oxide.", at_least=0),)

    def carrier(self):
        return "disk"

    def state_rates(self, contact):
        scraped = np.where(contact.pressure > 0, contact.speed, 0.0)
        return {"oxide": 1e-9 - scraped * contact.state["oxide"]}


def oxide(size, **motions):
    cells = round(size / 2e-5)
    changes = {"kinematics": motion(duration=100, **motions), "contact": foundation()}
    model = small(grid=Grid((size, size), (cells, cells)), effects=[Oxide()], **changes)
    return np.ravel(last(model).remembered("disk", "oxide"))


def test_what_air_does_beside_what_pressure_does_is_the_mean_over_the_track():
    found = [oxide(size) for size in (0.72e-3, 1.44e-3)]
    middles = [each[each.size // 2] for each in found]
    assert middles[0] == pytest.approx(middles[1], rel=1e-3)
    assert middles[0] < 0.5 * np.max(found[0])


def test_positions_that_do_not_tell_are_refused():
    with pytest.raises(CaseError, match="changes on 'disk' under no pressure"):
        oxide(0.72e-3, positions=33)
