import math

import numpy as np
import pytest
from paper_models import motion

from tribo import CaseError
from tribo.core.grid import Grid
from tribo.motion.exposure import Stationary, Track
from tribo.motion.reciprocating import Reciprocating
from tribo.motion.unidirectional import Unidirectional

GRID = Grid((1e-3, 1e-3), (10, 10))


def reciprocating(**values):
    return motion(**{"duration": "1 h", **values})


def test_the_papers_hour_is_360_metres():
    motion = reciprocating()
    assert motion.end_time == 3600
    assert motion.distance_at(3600) == pytest.approx(360)
    assert motion.distance_at(0.25) == pytest.approx(0.025)


def test_the_end_may_be_given_as_time_cycles_or_distance():
    for end in ({"cycles": 90000}, {"distance": "360 m"}):
        assert reciprocating(duration=None, **end).end_time == pytest.approx(3600)


@pytest.mark.parametrize("given", [{}, {"duration": 1, "cycles": 2}])
def test_the_end_is_given_once(given):
    with pytest.raises(CaseError, match="exactly one of duration, cycles and distance"):
        Reciprocating(stroke=1, frequency=1, **given)


def test_sinusoidal_path_is_the_integral_of_the_speed():
    motion = reciprocating(waveform="sinusoidal")
    omega, amplitude = 2 * math.pi * 25, 1e-3
    for end in (0.004, 0.0137, 0.033):
        t = np.linspace(0, end, 200_001)
        speed = np.abs(amplitude * omega * np.sin(omega * t))
        assert motion.distance_at(end) == pytest.approx(np.trapezoid(speed, t), rel=1e-7)


@pytest.mark.parametrize("waveform", ["constant_speed", "sinusoidal"])
def test_whole_cycles_slide_the_same_whatever_the_waveform(waveform):
    motion = reciprocating(waveform=waveform)
    assert motion.distance_at(40 / 25) == pytest.approx(40 * 2 * 2e-3, rel=1e-12, abs=0)


def test_the_last_body_is_swept_unless_named():
    exposures = reciprocating().exposures(GRID, ["ball", "disk"])
    assert isinstance(exposures["ball"], Stationary)
    assert isinstance(exposures["disk"], Track)
    assert exposures["disk"].length == 2e-3
    named = reciprocating(swept="ball").exposures(GRID, ["ball", "disk"])
    assert isinstance(named["ball"], Track)


def test_a_disk_track_is_a_circumference():
    motion = Unidirectional(speed="0.1 m/s", track_radius="16 mm", revolutions=10)
    assert motion.track_extent == pytest.approx(2 * math.pi * 16e-3)
    assert motion.distance_at(motion.end_time) == pytest.approx(10 * motion.track_extent)
