"""Effects that carry load or set the friction, and the work of friction."""

import numpy as np
import pytest
from paper_models import K, archard, case, motion, pair, pin

from tribo import (
    FRICTION_COEFFICIENT,
    LOAD_SHARE,
    CaseError,
    Effect,
    Field,
    Grid,
    Simulation,
    WearLaw,
    WearRate,
)
from tribo.core.errors import PluginError
from tribo.motion.closed_track import Unidirectional


class Film(Effect):
    """A film that carries a given part of the load."""

    type = "test.film"
    share: float
    provides = (LOAD_SHARE,)

    def fields(self, contact):
        share = np.full((1, 1), self.share)
        return {"load_share": dict.fromkeys(contact.materials, share)}


class Rubs(Effect):
    """A coefficient of friction that a function of the contact gives, on each body if it does."""

    type = "test.rubs"
    provides = (FRICTION_COEFFICIENT,)
    _function: object = None

    def fields(self, contact):
        values = np.broadcast_to(self._function(contact), (2, 1, 1))
        return {"friction_coefficient": dict(zip(contact.materials, values, strict=True))}


def rubs(function):
    effect = Rubs()
    effect._function = function
    return effect


def run(law=None, **changes):
    parts = {"grid": Grid((0.7e-3, 0.7e-3), (24, 24)), "kinematics": motion(duration=20)}
    return Simulation(case(bodies=pair(law or archard()), **{**parts, **changes})).run()


class NoSlope(WearLaw):
    """Archard's law, its slope left to be found."""

    type = "test.no_slope"

    def rate(self, local):
        return WearRate(K * local.pressure)


@pytest.mark.parametrize("law", [archard(), NoSlope()])
def test_a_film_that_carries_all_leaves_no_wear(law):
    with run(law, effects=[Film(share=1.0)]) as result:
        assert result.saves()[-1]["bodies"]["ball"]["wear_volume_m3"] == 0
        assert result.body("disk").effects["load_share"][-1].min() == 1


class Above(Effect):
    """A film on all others: it carries as much as these do."""

    type = "test.above"
    requires = ("load_share",)
    provides = (LOAD_SHARE,)

    def fields(self, contact):
        return {"load_share": contact.fields["load_share"]}


def test_each_of_several_takes_its_part_of_what_the_others_leave():
    effects = [Above(), Film(share=0.5), Film(share=0.2)]
    with Simulation(pin(archard(), effects=effects)).run() as wet:
        lost = wet.saves()[-1]["bodies"]["pin"]["wear_volume_m3"]
        share = wet.body("pin").effects["load_share"][-1]
    left = 0.5 * 0.8 * (1 - 0.6)
    assert lost == pytest.approx(left * K * 40, rel=1e-9, abs=0)
    np.testing.assert_allclose(share, 1 - left, rtol=1e-12)
    with pytest.raises(CaseError, match=r"test.above, test.above needs .* wait for one"):
        run(effects=[Above(), Above()])


def test_more_than_the_load_is_refused():
    with pytest.raises(PluginError, match=r"'load_share' for body 'ball' that is 1\.5 somewhere"):
        run(effects=[Film(share=1.5)])


def test_friction_may_follow_the_speed():
    stages = [{"until": 10, "speed": "0.1 m/s"}, {"until": 20, "speed": "0.2 m/s"}]
    motion = Unidirectional(speed=stages, track_length="2 mm", duration=20)
    with run(
        effects=[rubs(lambda contact: 2 * contact.speed)], kinematics=motion, save_times=(10,)
    ) as result:
        begin, first, last = result.saves()
    assert begin["friction_force_N"] == pytest.approx(20.0, rel=1e-9)
    assert first["friction_force_N"] == pytest.approx(20.0, rel=1e-9)
    assert last["friction_force_N"] == pytest.approx(40.0, rel=1e-9)
    assert first["friction_energy_J"] == pytest.approx(20.0, rel=1e-9)
    assert last["friction_energy_J"] == pytest.approx(20.0 + 80.0, rel=1e-9)


def test_the_work_of_friction_that_follows_the_time_is_that_of_its_integral():
    follows = rubs(lambda contact: 0.1 * (1 + np.sin(contact.time)))
    with Simulation(pin(archard(), effects=[follows])).run() as result:
        work = result.saves()[-1]["friction_energy_J"]
    assert work == pytest.approx(0.1 * (1 - np.cos(10) + 10) * 40 * 0.1, rel=3e-5)


def test_friction_that_is_not_alike_on_both_bodies_is_refused():
    with pytest.raises(PluginError, match="friction_coefficient"):
        run(effects=[rubs(lambda _: [[[0.1]], [[0.2]]])])


class Fading(Effect):
    """A coefficient of friction of 0.1 + 0.4 exp(-s / length), by what it remembers."""

    type = "test.fading"
    length: float = 0.5
    provides = (FRICTION_COEFFICIENT,)
    state_fields = (Field("left", "1", "What is left.", uniform=True, at_least=0),)

    def initial_state(self):
        return {"left": 1.0}

    def state_rates(self, contact):
        return {"left": -contact.state["left"] * contact.speed / self.length}

    def fields(self, contact):
        friction = 0.1 + 0.4 * contact.state["left"]
        return {"friction_coefficient": dict.fromkeys(contact.materials, friction)}


@pytest.mark.parametrize("law", [archard(), archard(k=0.0)], ids=["worn", "unworn"])
def test_the_work_of_friction_that_follows_a_state_is_that_of_its_course(law):
    with Simulation(pin(law, effects=[Fading()])).run() as result:
        work = result.saves()[-1]["friction_energy_J"]
    exact = 40 * (0.1 + 0.4 * 0.5 * -np.expm1(-1 / 0.5))
    assert work == pytest.approx(exact, rel=1e-5)


def test_at_rest_there_is_no_force_of_friction():
    stages = [(2, 0), (12, "0.1 m/s"), (20, 0)]
    speed = [{"until": until, "speed": speed} for until, speed in stages]
    motion = Unidirectional(speed=speed, track_length="2 mm", duration=20)
    with run(friction_coefficient=0.3, kinematics=motion, save_times=(12,)) as result:
        forces = [save["friction_force_N"] for save in result.saves()]
    assert forces[1] == pytest.approx(30)
    assert forces[::2] == [0, 0]


def test_without_friction_its_columns_are_empty():
    with run() as result:
        assert np.isnan(result.table("history")["friction_energy_J"]).all()
