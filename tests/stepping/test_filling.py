"""What fills the gap: a state in m that the bodies meet on."""

import numpy as np
import pytest
from paper_models import archard, foundation, motion, pair, pin, small, states
from strangers.debris import Filling

from tribo import Effect, Field, Grid
from tribo.stepping.explicit import Explicit

STIFFNESS, EVEN = 1e15, 10e6


class Grows(Effect):
    """A layer that grows by `rate` per metre on one half of the pin."""

    type = "test.grows"
    rate: float = 2e-9
    first: float = 0.0
    state_fields = (Field("layer", "m", "Height of a layer.", at_least=0, fills=True),)

    def initial_state(self):
        return {"layer": self.first}

    def state_rates(self, contact):
        return {"layer": self.rate * contact.speed * (contact.grid.mesh[0] > 0)}


@pytest.mark.parametrize("stepping", [{}, {"stepping": Explicit(time_step="2 s")}])
def test_a_layer_takes_the_load_that_its_height_asks_for(stepping):
    last = states(pin(effects=[Grows()], **stepping))[-1]
    # Winkler: p = c (approach − gap), under one load.
    shift = 0.5 * STIFFNESS * 2e-9
    expected = EVEN + np.where(np.arange(8) > 3, shift, -shift)[:, None]
    np.testing.assert_allclose(last.contact.pressure, expected + np.zeros(8), rtol=1e-8)


class Gathers(Grows):
    """A layer that grows the faster, the harder it is pressed, a little more on one half."""

    type = "test.gathers"

    def state_rates(self, contact):
        uneven = 1 + 0.1 * (contact.grid.mesh[0] > 0)
        return {"layer": self.rate / EVEN * contact.speed * contact.pressure * uneven}


def test_a_run_reports_at_its_end_that_the_load_has_gathered_on_few_cells():
    first, *_, last = states(pin(effects=[Gathers(rate=1e-7)]))
    assert first.findings == ()
    (found,) = last.findings
    assert (found.kind, found.limit, found.time) == ("resolution", 8, last.time)
    assert found.value == pytest.approx(4)


def ball(positions):
    """A ball that wears, on a disk that does not, with all its debris."""
    kinematics = motion(stroke="0.4 mm", duration=20, positions=positions)
    return small(
        grid=Grid((0.7e-3, 0.7e-3), (20, 20)),
        bodies=pair(archard()),
        contact=foundation(),
        kinematics=kinematics,
        effects=[Filling(length=1e9, on="ball")],
    )


@pytest.mark.parametrize("positions", ["average", 5])
def test_a_scar_that_its_own_debris_fills_stays_as_it_was(positions):
    first, *_, last = states(ball(positions))
    worn = last.bodies["ball"].wear
    np.testing.assert_allclose(last.remembered("ball", "debris_thickness"), worn, rtol=1e-6)
    assert np.max(worn) > 5 * first.reference_depth * 1e-3
    before, after = (state.contact.pressure for state in (first, last))
    np.testing.assert_allclose(after, before, atol=1e-5 * before.max())


@pytest.mark.parametrize("declared", [{"state_fields": "Pa"}, {"provides": "m"}])
def test_what_is_no_height_or_is_not_kept_cannot_fill(declared):
    ((where, unit),) = declared.items()
    field = Field("layer", unit, "A layer.", fills=True)
    with pytest.raises(TypeError, match=rf"{where}: 'layer' cannot fill the gap"):
        type("Wrong", (Effect,), {where: (field,), "__module__": __name__})
