"""A cycle resolved into positions, against plain loops and the average that is its limit."""

import numpy as np
import pytest
import scipy.fft
from paper_models import (
    K,
    archard,
    flat,
    foundation,
    goes_on,
    half_space,
    last,
    motion,
    named,
    small,
    sphere,
    states,
    steel,
)
from stroke import GRID, STROKE, resolved

from tribo import CaseError, Grid, NumericalError, Passing, Pin, Waves
from tribo.core.contact import ContactProblem
from tribo.core.errors import PluginError
from tribo.motion.exposure import Stationary
from tribo.plotting.profiles import body_profiles
from tribo.stepping.contacts import undeformed


@pytest.mark.slow
def test_on_stiff_springs_every_pressure_belongs_to_its_gap():
    # A step wears many times as much as springs give way, and its passes leave a part of that.
    bodies = [
        named("pin", Pin(radius="0.25 mm", edge="0.15 mm"), steel(), archard(10 * K)),
        named("disk", flat(), steel(), archard()),
    ]
    model = resolved(duration=60, contact=foundation(modulus=3e15), bodies=bodies)
    for state in states(model)[1:]:
        again = [
            model.case.contact.solve(
                ContactProblem(model.contact.system, gap, model.contact.system.load)
            ).pressure
            for gap in undeformed(model, state)
        ]
        kept = [contact.pressure for contact in state.contacts]
        assert np.sum(np.abs(np.subtract(again, kept))) < 2e-3 * np.sum(kept)


@pytest.mark.slow
@pytest.mark.parametrize("soft", ["ball", "disk"])
def test_nothing_yields_twice_at_any_position(soft):
    kinematics = motion(stroke=STROKE, duration=5, positions=7)
    waves = Waves(amplitude=2e-7, wavelength=4 * GRID.spacing[0], along="x")
    steels = {name: steel(1.5e9 if name == soft else None) for name in ("ball", "disk")}
    bodies = [
        named("ball", sphere(), steels["ball"], archard()),
        named("disk", waves, steels["disk"], archard()),
    ]
    model = small(grid=GRID, contact=half_space(), kinematics=kinematics, bodies=bodies)
    state = last(model)
    deepest = state.bodies[soft].plastic.max()
    assert state.bodies["disk"].plastic.shape == (32 + 12, 20)
    assert deepest > 1e-8
    for position in range(7):
        gap = undeformed(model, state)[position]
        again = model.case.contact.solve(
            ContactProblem(model.contact.system, gap, model.contact.system.load)
        )
        assert again.overlap.max() <= 1e-5 * deepest
        assert again.pressure.max() <= 1.5e9 * (1 + 1e-9)


def test_a_contact_that_leaves_the_window_away_from_mid_stroke_ends_the_run():
    narrow = Grid((0.75e-3, 0.75e-3), (20, 20))
    kinematics = motion(stroke=10 * narrow.spacing[0], duration=2000, positions=9, swept="ball")
    with pytest.raises((CaseError, NumericalError), match="edge of the window"):
        last(small(grid=narrow, contact=foundation(), kinematics=kinematics))


class Scaled(Passing):
    """A body that passes, with an average that is not the rate."""

    def average(self, rate):
        return 0.5 * rate


class Turning(Stationary):
    """A body that stays, and pretends to pass."""

    swept = True


def from_starts(*starts):
    def made(grid, right):
        passing = Passing(grid, right, STROKE)
        passing.starts = starts
        return passing

    return made


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (from_starts(*range(12)), "starts"),
        (from_starts(13, *range(11, -1, -1)), "starts"),
        (from_starts(*range(11, -1, -1), -1), "starts"),
        (lambda grid, right: Scaled(grid, right, STROKE), "'average' for body"),
        (lambda grid, right: Turning(grid), "32 rows without starts"),
    ],
)
def test_a_body_that_passes_as_it_cannot_is_refused(made, words):
    class Odd(type(motion())):
        type = "test.odd"

        def exposures(self, grid, bodies):
            passing = made(grid, self._stroke(grid).starts)
            return {bodies[0]: Stationary(grid), bodies[1]: passing}

    with pytest.raises(PluginError, match=words):
        resolved(kinematics=Odd(stroke=STROKE, frequency=1.0, cycles=1, positions=13))


@pytest.mark.slow
@pytest.mark.parametrize("swept", ["ball", "disk"])
def test_two_workers_give_the_bits_of_one(swept):
    # Of both ways: with the ball moving nothing is mirrored.
    kinematics = motion(stroke=STROKE, duration=20, positions=7, swept=swept)
    ends = []
    for workers in (1, 2):
        with scipy.fft.set_workers(workers):
            ends.append(last(resolved(kinematics=kinematics, contact=half_space())))
    one, two = ends
    for name, body in one.bodies.items():
        np.testing.assert_array_equal(two.bodies[name].wear, body.wear)
    for first, second in zip(one.contacts, two.contacts, strict=True):
        np.testing.assert_array_equal(second.pressure, first.pressure)


@pytest.mark.slow
def test_a_stopped_run_goes_on_to_the_same_bits_with_the_groove_along_its_track(tmp_path):
    kinematics = motion(stroke=STROKE, duration=20, positions=7)
    with goes_on(resolved(kinematics=kinematics), tmp_path, 5) as whole:
        track = whole.field("track_depth", -1, "disk")
        assert len(track) == 44
        np.testing.assert_array_equal(track[6:-6], whole.body("disk").wear_depth[-1])
        assert np.all(np.isnan(whole.field("track_depth", -1, "ball")))
        line = body_profiles(whole, "disk", axis=0).figure().axes[0].lines[-1]
        depth = -1e9 * track[:, 9:11].mean(axis=1)
        np.testing.assert_allclose(line.get_ydata()[1:-1], depth, atol=1e-9 * np.ptp(depth))
