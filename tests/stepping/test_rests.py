"""A motion may stand still for a while, and a save may fall into that."""

import numpy as np
import pytest
from paper_models import K, archard, foundation, motion, pin, small, states

from tribo import Effect, Field, Load, Simulation, Stage
from tribo.motion.closed_track import Unidirectional
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit


def pauses(begin=4.0, end=9.0, duration=15.0):
    """A motion that rests from `begin` to `end`, in s."""
    stages = [(begin, 0.1), (end, 0.0), (99.0, 0.1)]
    speed = [{"until": until, "speed": speed} for until, speed in stages if until > 0]
    return Unidirectional(speed=speed, track_length="2 mm", duration=duration)


STEPPINGS = [Implicit(), Explicit(time_step="1.5 s")]


@pytest.mark.parametrize("stepping", STEPPINGS, ids=["implicit", "explicit"])
def test_a_save_in_a_rest_is_made_and_the_run_goes_on(stepping):
    case = small(kinematics=pauses(), save_times=(4, 5, 7.5), stepping=stepping)
    with Simulation(case).run() as result:
        assert list(result.times) == [0, 4, 5, 7.5, 15]
        np.testing.assert_allclose(result.distances, [0, 0.4, 0.4, 0.4, 1.0], rtol=1e-12)
        wear = result.body("ball").wear_depth
        np.testing.assert_array_equal(wear[1], wear[2])
        np.testing.assert_array_equal(wear[1], wear[3])
        assert wear[4].max() > wear[3].max()


@pytest.mark.parametrize("stepping", STEPPINGS, ids=["implicit", "explicit"])
@pytest.mark.parametrize("rest", [(0.0, 5.0), (10.0, 30.0)], ids=["first", "last"])
def test_a_motion_may_begin_or_end_at_rest(rest, stepping):
    begin, end = rest
    case = small(kinematics=pauses(begin, end), save_times=(2, 12), stepping=stepping)
    plain = small(kinematics=motion(stroke="2 mm", frequency=25, duration=10), stepping=stepping)
    with Simulation(case).run() as rested, Simulation(plain).run() as steady:
        worn = [r.saves()[-1]["bodies"]["ball"]["wear_volume_m3"] for r in (rested, steady)]
        assert rested.times[-1] == 15
    assert worn[0] == pytest.approx(worn[1], rel=1e-9, abs=0)


@pytest.mark.parametrize("ramp", [(2.0, 11.0), (4.0, 9.0), (5.0, 11.0), (2.0, 7.0)])
def test_a_load_may_rise_as_the_motion_comes_to_rest_and_goes_on(ramp):
    up, there = ramp
    stages = Stage(until=up, normal=50), Stage(at=there, normal=100), Stage(until=15, normal=100)
    model = small(contact=foundation(), kinematics=pauses(), load=Load(normal=stages))
    last = states(model)[-1]
    times = np.linspace(0, 15, 150_001)
    slides = 0.1 * ((times < 4) | (times > 9))
    load_distance = np.trapezoid(slides * np.interp(times, ramp, (50, 100)), times)
    assert last.load_distance == pytest.approx(load_distance, rel=1e-4)
    for name, body in last.bodies.items():
        volume = model.cycle.maps[name].volume(body.wear)
        assert volume == pytest.approx(K * last.load_distance, rel=1e-9, abs=0)


class Grows(Effect):
    """A layer on one half of the pin that grows under pressure, at rest too: dt/dt = r p."""

    type = "test.grows_in_time"
    state_fields = (Field("grown", "m", "Height of a layer.", at_least=0, fills=True),)
    carrying: bool = False

    def state_rates(self, contact):
        side = 1.0 if self.carrying else contact.grid.mesh[0] > 0
        return {"grown": 1e-18 * side * contact.pressure}


def test_what_grows_at_rest_follows_the_load_of_each_moment():
    ramp = Stage(until=4, normal=40), Stage(at=9, normal=80), Stage(until=15, normal=80)
    case = pin(
        law=archard(1e-18),
        effects=[Grows(carrying=True)],
        kinematics=pauses(),
        load=Load(normal=ramp),
    )
    last = states(case)[-1]
    # 10 MPa for 4 s, up to 20 MPa in 5 s, and for 6 s more.
    assert last.between["grown"] == pytest.approx(1e-18 * 1e6 * (40 + 75 + 120), rel=1e-6, abs=0)


def test_bodies_meet_at_rest_on_what_has_grown_there():
    case = pin(law=archard(1e-20), effects=[Grows()], kinematics=pauses(), save_times=(4, 9))
    with Simulation(case).run() as result:
        pressures = [result.field("pressure", save) for save in (1, 2)]
        heights = [result.field("grown", save) for save in (1, 2)]
    for pressure, height in zip(pressures, heights, strict=True):
        bearing = 1e15 * (height - np.mean(height))
        np.testing.assert_allclose(pressure - np.mean(pressure), bearing, rtol=1e-3, atol=10.0)
