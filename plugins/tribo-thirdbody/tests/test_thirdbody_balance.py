"""The thickness of debris against its exact balance."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tribo import CaseError, Simulation
from tribo.config.load import validate_case
from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.simulation.predict import predict
from tribo.verification.refinement import refine

from tribo_thirdbody.debris import Debris

SIDE, LOAD, TRACK, END = 2e-3, 40.0, 8e-3, 3.0
K, COVER = 2e-14, 50e-9
P = LOAD / SIDE**2


def pin(length=50e-3, on=None, **given):
    """A square pin on a track, both of steel: its pressure is even, and stays so."""
    steel = {"young": "207 GPa", "poisson": 0.3}
    body = {"surface": "flat", "material": steel, "wear": {"type": "archard", "k": K}}
    debris = Debris(ejection_length=length, on=on, **{"cover": COVER} | given)
    return {
        "grid": {"size": SIDE, "cells": 8, "ends_at_window": True},
        "load": {"normal": LOAD},
        "bodies": {"pin": body, "disk": body},
        "contact": {"type": "winkler", "modulus": 1e15},
        "kinematics": {
            "type": "unidirectional",
            "speed": 0.1,
            "track_length": TRACK,
            "distance": END,
        },
        "effects": [debris.model_dump()],
    }


def balance(length, caught=1.0, under=1.0):
    """Thickness, and depth worn off both bodies, by the exact balance."""

    def rates(_, y):
        worn = 2 * K * P * math.exp(-y[0] / COVER)
        return [under * (caught * worn - y[0] / length), worn]

    given = {"rtol": 1e-10, "atol": 1e-20, "method": "LSODA"}
    return solve_ivp(rates, (0, END), [0.0, 0.0], **given).y[:, -1]


@pytest.mark.parametrize(
    ("length", "caught", "on"),
    # The last is carried away before what is uneven can grow.
    [(1e9, 1.0, "disk"), (0.5, 0.4, None), (5e-3, 1.0, None)],
)
def test_flat_bodies_meet_on_debris_that_fills(length, caught, on):
    case = pin(length=length, caught=caught, on=on, fills=True)
    with Simulation(case).run() as result:
        first, *_, last = result.saves()
        thickness = result.field("debris_thickness", -1, on)
        bodies = last["bodies"].values()
        worn = sum(body["max_wear_depth_m"] for body in bodies)
        volume = sum(body["wear_volume_m3"] for body in bodies)
    under = SIDE / TRACK if on else 1.0
    exact = balance(length, caught, under)[0]
    assert thickness == pytest.approx(exact, rel=1e-4, abs=0)
    sunk = last["approach_m"] - first["approach_m"]
    np.testing.assert_allclose(sunk, worn - thickness, rtol=1e-9, atol=1e-9 * worn)
    # Nothing leaves: all that the pin and the track lost lies on the track.
    assert length < 1e9 or thickness == pytest.approx(volume / (SIDE * TRACK), rel=3e-5, abs=0)


@pytest.mark.parametrize("on", [None, "pin"])
def test_a_gap_that_fills_faster_than_it_opens_is_refused(on):
    refused = r"^effects: debris_thickness.* fills .* body that passes \('disk'\), let less"
    with pytest.raises(CaseError, match=refused):
        Simulation(pin(length=1e9, on=on, fills=True, cover=1e-3)).run()


@pytest.mark.slow
def test_a_check_and_a_study_of_errors_say_what_a_run_gives():
    # A state that is left out of their runs gives the dry depth, without an error.
    case = pin()
    case["grid"]["cells"], case["kinematics"]["distance"] = 20, 0.5
    simulation = Simulation(case)
    with simulation.run() as result:
        worn = result.saves()[-1]["bodies"]["pin"]["max_wear_depth_m"]
    quoted = {each.name: each for each in refine(simulation.model).estimates}
    depth = quoted["pin: largest depth"]
    assert depth.value == pytest.approx(worn, rel=1e-12, abs=0)
    assert depth.uncertainty <= 1e-4 * worn
    foreseen = predict(simulation.model).last.bodies["pin"].max_wear_depth
    assert foreseen == pytest.approx(worn, rel=1e-3, abs=0)
    assert worn < 0.8 * K * P * 0.5


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::tribo.TriboWarning")
def test_under_a_ball_it_leaves_without_coming_and_going_where_it_just_touches():
    steel = {"young": "210 GPa", "poisson": 0.3}
    wear = {"type": "archard", "k": 1e-15}
    surfaces = {"ball": {"type": "sphere", "radius": "3 mm"}, "disk": "flat"}
    case = pin(length=0.5, cover=1e-6, fills=True) | {
        "grid": {"size": "0.8 mm", "cells": 18},
        "load": "10 N",
        "contact": "dcfft",
        "bodies": {
            name: {"surface": surface, "material": steel, "wear": wear}
            for name, surface in surfaces.items()
        },
    }
    model = assemble(validate_case(case | {"kinematics": {**case["kinematics"], "distance": 1.9}}))
    for taken, _ in enumerate(march(model, begin(model))):
        assert taken < 100
