import math

import pytest
from paper_models import motion, small

from tribo import CaseError
from tribo.core.grid import Grid
from tribo.guards.motion import GuardedMotion
from tribo.motion.closed_track import Unidirectional
from tribo.motion.exposure import Stationary, Track
from tribo.motion.measured import Measured
from tribo.motion.reciprocating import Reciprocating

GRID = Grid((1e-3, 1e-3), (10, 10))


def reciprocating(**values):
    return motion(**{"duration": "1 h", **values})


def test_the_end_may_be_given_as_time_cycles_or_distance():
    for end in ({"cycles": 90000}, {"distance": "360 m"}):
        assert reciprocating(duration=None, **end).end_time == pytest.approx(3600)


@pytest.mark.parametrize("given", [{}, {"duration": 1, "cycles": 2}])
def test_the_end_is_given_once(given):
    with pytest.raises(CaseError, match="exactly one of duration, cycles and distance"):
        Reciprocating(stroke=1, frequency=1, **given)


def test_the_last_body_is_swept_unless_named():
    exposures = reciprocating().exposures(GRID, ["ball", "disk"])
    assert isinstance(exposures["ball"], Stationary)
    assert isinstance(exposures["disk"], Track)
    assert exposures["disk"].length == 2e-3
    named = reciprocating(swept="ball").exposures(GRID, ["ball", "disk"])
    assert isinstance(named["ball"], Track)


DISK = Unidirectional(speed="60 rpm", track_radius="16 mm", distance="500 laps")
STROKE = Reciprocating(stroke="1 mm", frequency="25 Hz", distance="500 cycles")
PATH = Measured(path=[[0, 0], [2, 1e-3], [3, 0]], cycles="500 cycles")


@pytest.mark.parametrize(("motion", "seconds"), [(DISK, 500), (STROKE, 20), (PATH, 1500)])
def test_a_path_is_counted_in_laps(motion, seconds):
    assert motion.end_time == pytest.approx(seconds, rel=1e-12, abs=0)
    half = GuardedMotion(motion).moment("250 laps")
    assert half == pytest.approx(0.5 * seconds, rel=1e-12, abs=0)
    assert motion.distance_at(half) == pytest.approx(250 * motion.lap, rel=1e-12, abs=0)


def test_a_motion_whose_track_is_unknown_has_no_laps():
    class Endless(Unidirectional):
        type = "my.endless"

        @property
        def track_extent(self):
            return math.inf

    endless = Endless(speed=1.0, track_radius=1.0, distance=1.0)
    with pytest.raises(CaseError, match="5 laps"):
        GuardedMotion(endless).moment("5 laps")


def test_saves_lie_where_the_path_says():
    model = small(save_times=("1 s", "1 m", "500 cycles"))
    assert model.save_times == pytest.approx((1.0, 10.0, 20.0), rel=1e-12, abs=0)
