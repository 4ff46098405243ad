"""A speed held in stages, rests among them."""

import numpy as np
import pytest
from paper_models import Faster, K, foundation, pair, small, states

from tribo import (
    CaseError,
    Explicit,
    FrequencyStage,
    Grid,
    Implicit,
    Reciprocating,
    Rotating,
    SpeedStage,
    Unidirectional,
)

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
    ("motion", "stepping"),
    [
        (track(), Explicit(time_step=0.3)),
        (Rotating(speed=STAGES, track_radius="1 m", duration=12), Implicit()),
        (strokes(), Implicit()),
    ],
)
def test_a_law_is_asked_at_the_speed_of_each_stage_by_itself(motion, stepping):
    bodies = pair(Faster())
    grid = Grid((0.7e-3, 0.7e-3), (24, 24))
    model = small(
        grid=grid, bodies=bodies, kinematics=motion, contact=foundation(), stepping=stepping
    )
    found = states(model)
    assert {4.0, 9.0, 12.0} < {state.time for state in found}
    volume = np.sum(found[-1].bodies["ball"].wear) * grid.cell_area
    # At 0.5 m/s it wears five times as much per metre.
    asked = K * 100 * (0.4 + 5 * 1.5)
    # Rows on a disk of 1 m slide by up to 0.04 % more or less.
    assert volume == pytest.approx(asked, rel=1e-6 if motion.type == "rotating" else 1e-10, abs=0)


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
