"""A speed held in stages, rests among them."""

import numpy as np
import pytest
from paper_models import foundation, small

from tribo import CaseError, FrequencyStage, Reciprocating, SpeedStage, Unidirectional

STAGES = [
    SpeedStage(until=4, speed=0.1),
    SpeedStage(until=9, speed=0),
    SpeedStage(until=20, speed=0.5),
]

FREQUENCIES = [FrequencyStage(until=s.until, frequency=s.speed / 0.04) for s in STAGES]


def track(**values):
    return Unidirectional(**{"speed": STAGES, "track_length": "20 mm", "duration": 12, **values})


def strokes(**values):
    given = {"frequency": FREQUENCIES, "stroke": "20 mm", "duration": 12, "positions": "average"}
    return Reciprocating(**{**given, **values})


@pytest.mark.parametrize("motion", [track(), strokes()], ids=lambda m: m.type)
def test_distance_is_the_integral_of_the_speed_and_time_its_first_inverse(motion):
    times = [0, 2, 4, 6, 9, 10, 12]
    found = [motion.distance_at(time) for time in times]
    np.testing.assert_allclose(found, [0, 0.2, 0.4, 0.4, 0.4, 0.9, 1.9], rtol=1e-14)
    assert [motion.time_at(distance) for distance in (0.2, 0.4, 0.9)] == pytest.approx([2, 4, 10])
    assert track(duration=None, distance=0.9).end_time == pytest.approx(10)
    assert track(duration=None, revolutions=45).end_time == pytest.approx(10)
    assert strokes(duration=None, distance=0.9).end_time == pytest.approx(10)
    assert strokes(duration=None, cycles=22.5).end_time == pytest.approx(10)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"speed": []}, "the list is empty; give a number, or the stages of the speed up to"),
        ({"speed": [{"until": 9, "speed": 0}]}, "every stage is a rest"),
        ({"speed": [STAGES[1], STAGES[0]]}, "9 s is followed by 4 s"),
        ({"speed": {"until": 9, "speed": 1}}, "write a list"),
        ({"speed": 0}, "must be greater than 0"),
        ({"speed": [{"until": 9, "speed": -1}]}, "must be at least 0"),
    ],
)
def test_stages_that_make_no_sense_are_refused(values, words):
    with pytest.raises(ValueError, match=words):
        track(**values)


def test_a_sinusoidal_motion_has_one_frequency():
    with pytest.raises(ValueError, match=r"a frequency in stages is .*leave waveform out"):
        strokes(waveform="sinusoidal")


@pytest.mark.parametrize(
    ("motion", "place", "words"),
    [
        (track(duration=21), "speed", "after 5.9 m, before the run does at 21 s"),
        (track(duration=None, distance=6), "speed", "before the run does at 6 m"),
        (track(duration=None, revolutions=300), "speed", "before the run does at 6 m"),
        (strokes(duration=21), "frequency", "after 147.5 cycles, before the run does at 21 s"),
    ],
)
def test_stages_that_end_before_the_run_are_refused(motion, place, words):
    with pytest.raises(CaseError, match=rf"kinematics\.{place}: .*ends at 20 s, .*{words}"):
        small(kinematics=motion, contact=foundation())
