"""A law that follows the speed is averaged over the speeds of a cycle, whatever the step."""

import math

import numpy as np
import pytest
from paper_models import Faster, K, foundation, lost, motion, pair, small

from tribo import Effect, Field, Grid, Position
from tribo.core.errors import PluginError
from tribo.evolution.local_fields import effect_fields
from tribo.motion.closed_track import Rotating, Unidirectional
from tribo.motion.measured import Measured
from tribo.motion.reciprocating import Reciprocating
from tribo.simulation.march import begin
from tribo.stepping.explicit import Explicit

SINE = {"waveform": "sinusoidal"}
MEAN = 2 * 2e-3 * 25


def worn(kinematics, law=None, **changes):
    parts = {"grid": Grid((0.7e-3, 0.7e-3), (32, 32)), "contact": foundation(), **changes}
    return lost(small(bodies=pair(law or Faster()), kinematics=kinematics, **parts))


class Silent(Reciprocating):
    """A motion that states no speeds."""

    def cycle(self, grid):
        return [Position()]


def test_a_motion_that_states_no_speeds_has_the_mean_over_the_step():
    whole_cycles = motion(duration=0.4, **SINE)
    found = worn(Silent(**dict(whole_cycles)), stepping=Explicit(time_step="0.04 s"))
    assert found == pytest.approx(K * 100 * MEAN * 0.4, rel=1e-9, abs=0)


@pytest.mark.parametrize(
    ("speeds", "words"),
    [
        ([(0.1, 0.5)], "add up to 0.5, not to 1"),
        ([(-0.1, 1.0)], "'speeds'"),
        ([], "'speeds'"),
        ([("fast", 1.0)], "'speeds'"),
        (7, "TypeError"),
    ],
)
def test_speeds_that_cannot_be_are_refused(speeds, words):
    class Wrong(Reciprocating):
        def cycle(self, grid):
            return [Position(speeds=speeds)]

    with pytest.raises(PluginError, match=f"kinematics 'reciprocating'.*{words}"):
        worn(Wrong(**dict(motion(duration=2))))


class Met(Effect):
    type = "test.met"

    provides = (Field("track", "m", "Its track."), Field("turns", "1", "Whether it turns back."))

    def fields(self, contact):
        at = {"track": contact.track, "turns": contact.turns_back}
        return {
            k: dict.fromkeys(contact.materials, np.full((1, 1), float(v))) for k, v in at.items()
        }


ROUND = {"speed": "0.1 m/s", "track_radius": "16 mm", "distance": "1 mm"}
PATH = ((0.0, 0.0), (1.0, 2e-3), (2.0, 0.0))


@pytest.mark.parametrize(
    ("kinematics", "track", "turns"),
    [
        (motion(duration=0.01), 2e-3, 1),
        (motion(duration=0.01, positions=21), 2e-3, 1),
        (Measured(path=PATH, cycles=1), 2e-3, 1),
        (Unidirectional(**ROUND), 2e-3 * math.pi * 16, 0),
        (Rotating(**ROUND), 2e-3 * math.pi * 16, 0),
    ],
)
def test_an_effect_knows_the_track_and_whether_the_motion_turns_back(kinematics, track, turns):
    parts = {"grid": Grid((0.7e-3, 0.7e-3), (16, 16)), "contact": foundation(), "effects": [Met()]}
    model = small(bodies=pair(), kinematics=kinematics, **parts)
    fields = effect_fields(model, begin(model))
    assert fields["track"]["disk"][0, 0] == pytest.approx(track)
    assert fields["turns"]["disk"][0, 0] == turns
