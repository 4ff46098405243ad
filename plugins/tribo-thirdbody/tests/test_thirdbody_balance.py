"""The thickness of debris against its exact balance."""

from importlib.resources import files

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tribo import load_case
from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.simulation.predict import predict
from tribo.verification.refinement import refine

CASE = files("tribo_thirdbody") / "cases" / "debris_lifts" / "case.toml"
QUICK = ["grid.cells=8", "output.save_times=[]", "contact.modulus=4e16"]
SIDE, TRACK, END = 0.1e-3, 1e-3, 5.0
K, COVER, P = 2e-16, 50e-9, 4 / SIDE**2


def pin(*changes, **debris):
    """A flat pin on a track, both of which wear: its pressure is even, and stays so."""
    law = f"bodies.flat.wear={{ type = 'archard', k = {K} }}"
    given = [f"effects.1.{key}={value}" for key, value in debris.items()]
    return load_case(CASE, overrides=[*QUICK, law, *given, *changes])


def balance(length, caught=1.0, under=1.0):
    """Thickness by the exact balance."""

    def rate(_, y):
        return under * (caught * 2 * K * P * np.exp(-y / COVER) - y / length)

    given = {"rtol": 1e-10, "atol": 1e-20, "method": "LSODA"}
    return solve_ivp(rate, (0, END), [0.0], **given).y[0, -1]


@pytest.mark.parametrize(
    ("length", "caught", "on"),
    # The last is carried away before what is uneven can grow.
    [(1e9, 1.0, "flat"), (0.5, 0.4, None), (5e-3, 1.0, None)],
)
def test_flat_bodies_meet_on_debris_that_fills(length, caught, on):
    place = {} if on is None else {"on": on}
    with pin(ejection_length=length, caught=caught, **place).run() as result:
        first, *_, last = result.saves()
        thickness = result.field("debris_thickness", -1, on)
        bodies = last["bodies"].values()
        worn = sum(body["max_wear_depth_m"] for body in bodies)
        volume = sum(body["wear_volume_m3"] for body in bodies)
    under = SIDE / TRACK if on else 1.0
    exact = balance(length, caught, under)
    assert thickness == pytest.approx(exact, rel=1e-4, abs=0)
    sunk = last["approach_m"] - first["approach_m"]
    np.testing.assert_allclose(sunk, worn - thickness, rtol=0, atol=1e-8 * worn)
    # Nothing leaves: all that the pin and the track lost lies on the track.
    assert length < 1e9 or thickness == pytest.approx(volume / (SIDE * TRACK), rel=3e-5, abs=0)


@pytest.mark.slow
def test_a_check_and_a_study_of_errors_say_what_a_run_gives():
    # A state that is left out of their runs gives the dry depth, without an error.
    case = pin("grid.cells=20", "kinematics.distance=1", fills="false")
    with case.run() as result:
        worn = result.saves()[-1]["bodies"]["pin"]["max_wear_depth_m"]
    quoted = {each.name: each for each in refine(assemble(case)).estimates}
    depth = quoted["pin: largest depth"]
    assert depth.value == pytest.approx(worn, rel=1e-12, abs=0)
    assert depth.uncertainty <= 1e-4 * worn
    foreseen = predict(assemble(case)).last.bodies["pin"].max_wear_depth
    assert foreseen == pytest.approx(worn, rel=1e-3, abs=0)
    assert worn < 0.8 * K * P


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::tribo.TriboWarning")
def test_under_a_ball_it_leaves_without_coming_and_going_where_it_just_touches():
    sphere, law = "{ type = 'sphere', radius = '3 mm' }", "{ type = 'archard', k = 1e-15 }"
    case = pin(
        *("grid.size=0.8 mm", "grid.cells=18", "load.normal=10", "contact={type='dcfft'}"),
        *(f"bodies.pin.surface={sphere}", f"bodies.pin.wear={law}", f"bodies.flat.wear={law}"),
        *("kinematics.track_length=8 mm", "kinematics.distance=1.9"),
        cover=1e-6,
    )
    model = assemble(case)
    for taken, _ in enumerate(march(model, begin(model))):
        assert taken < 100
