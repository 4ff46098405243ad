"""What lies on a body that passes changes along its whole track, in the window and beyond."""

import numpy as np
import pytest
from paper_models import case, foundation, last, motion

from tribo import CaseError, Effect, Field, Grid, Simulation
from tribo.simulation.assembly import assemble


class Oxide(Effect):
    """dh/dt = grown, less what a pressure scrapes off."""

    type = "test.oxide"
    grown: float = 1e-9
    """Growth in air, in m/s."""
    scraped: float = 0.0
    """Part that a metre of sliding under pressure takes, in 1/m."""

    state_fields = (Field("oxide", "m", "Height of oxide.", at_least=0),)

    def carrier(self):
        return "disk"

    def state_rates(self, contact):
        taken = np.where(contact.pressure > 0, self.scraped * contact.speed, 0.0)
        return {"oxide": self.grown - taken * contact.state["oxide"]}


def run(size, effect, **motions):
    cells = round(size / 2e-5)
    changes = {"kinematics": motion(duration=100, **motions), "contact": foundation()}
    return case(grid=Grid((size, size), (cells, cells)), effects=[effect], **changes)


def test_what_air_does_beside_what_pressure_does_is_the_mean_over_the_track():
    found = [
        last(assemble(run(size, Oxide(scraped=1.0)))).remembered("disk", "oxide")
        for size in (0.72e-3, 1.44e-3)
    ]
    middles = [np.ravel(oxide)[oxide.size // 2] for oxide in found]
    assert middles[0] == pytest.approx(middles[1], rel=1e-3)
    assert middles[0] < 0.5 * np.max(found[0])


def test_positions_that_do_not_tell_are_refused():
    told = "changes on 'disk' under no pressure"
    with (
        pytest.raises(CaseError, match=told),
        Simulation(run(0.72e-3, Oxide(), positions=33)).run(),
    ):
        pass
