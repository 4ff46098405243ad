"""Points that slip less than the motion, as in partial slip."""

import numpy as np
import pytest
from paper_models import K, archard, case, foundation, last, motion, pair, pin, small

from tribo import Simulation
from tribo.core.errors import BadValues, CaseError
from tribo.core.fields import LOCAL_SLIP, Field, WearRate
from tribo.effects.effect import Effect
from tribo.motion.reciprocating import Reciprocating
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit
from tribo.wear.law import WearLaw

MU = 0.3
FEW_STEPS = {
    "friction_coefficient": MU,
    "stepping": Implicit(depth_tolerance=0.1, pressure_tolerance=0.5),
}


class Slips(Effect):
    """A slip that grows from the middle of the window outwards."""

    type = "test.slips"
    provides = (LOCAL_SLIP,)
    inside: float = 0.2
    uneven: bool = False

    def fields(self, contact):
        x, y = np.meshgrid(contact.grid.x, contact.grid.y, indexing="ij")
        slip = np.clip(self.inside + np.hypot(x, y) / 5e-4, 0.0, 1.0)
        bodies = enumerate(contact.materials)
        return {"local_slip": {name: slip / (1 + self.uneven * at) for at, name in bodies}}


class Tires(WearLaw):
    """A law that counts how far a point has slipped, and wears the less."""

    type = "test.tires"
    k: float = K
    state_fields = (Field("slipped", "m", "Path that a point has slipped.", at_least=0.0),)

    def rate(self, local):
        k = self.k * np.exp(-local.state["slipped"])
        return WearRate(k * local.pressure, k, {"slipped": 1.0 * (local.pressure > 0)})


class Counts(Tires):
    """One that counts alike, and wears as at first."""

    type = "test.counts"

    def rate(self, local):
        rate = super().rate(local)
        return WearRate(self.k * local.pressure, self.k, rate.state_rates)


class Eases(Slips):
    """A slip that grows with a state of the contact."""

    type = "test.eases"
    state_fields = (Field("eased", "1", "How far it has.", at_least=0.0),)

    def fields(self, contact):
        slip = -np.expm1(-0.2 - contact.state["eased"] - contact.pressure / 1e9)
        return {"local_slip": dict.fromkeys(contact.materials, slip)}

    def state_rates(self, contact):
        return {"eased": contact.speed * (contact.pressure > 0) * 0.1}


RAMP = [{"at": 0, "normal": 100.0}, {"at": 200, "normal": 40.0}]


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"load": RAMP},
        {"kinematics": motion(positions=17, stroke="0.5 mm", duration=20)},
        {"stepping": Explicit(time_step=5.0)},
        {"load": RAMP, "bodies": pair(Counts(), archard())},
        {"load": RAMP, "effects": [Eases()]},
    ],
    ids=[
        "averaged",
        "ramp",
        "resolved",
        "explicit",
        "law counts",
        "slip follows state",
    ],
)
def test_worn_volume_goes_with_the_work_of_friction(changes):
    of = case(**{"effects": [Slips()], **FEW_STEPS, **changes})
    with Simulation(of).run() as result:
        end = result.saves()[-1]
        work = float(result.dataset["friction_energy"][-1])
    for body in end["bodies"].values():
        assert body["wear_volume_m3"] == pytest.approx(K / MU * work, rel=1e-10, abs=0)


def test_the_state_of_a_law_follows_the_slip_of_its_point():
    # So soft that its pressure stays even.
    model = pin(Tires(k=1e-15), effects=[Slips()], contact=foundation(modulus=1e11))
    state = last(model)
    x, y = np.meshgrid(model.grid.x, model.grid.y, indexing="ij")
    slip = np.clip(0.2 + np.hypot(x, y) / 5e-4, 0.0, 1.0)
    body, slipped = state.bodies["pin"], slip * state.distance
    assert body.law["slipped"] == pytest.approx(slipped, rel=1e-9, abs=0)
    assert body.wear == pytest.approx(1e-15 * 1e7 * -np.expm1(-slipped), rel=1e-3, abs=0)


def test_a_slip_of_each_body_is_refused():
    with pytest.raises(BadValues, match="local_slip"):
        last(small(effects=[Slips(uneven=True)]))


class Shakes(Reciprocating):
    """A motion in which points slip less than it slides."""

    type = "test.shakes"

    def effects(self):
        return [Slips()]


def test_a_slip_of_the_motion_and_one_of_the_case_are_refused():
    with pytest.raises(CaseError, match="local_slip"):
        small(kinematics=Shakes(**dict(motion())), effects=[Slips()])
