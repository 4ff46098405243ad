"""Layers of a body: worn through at the distance that follows from their rates."""

from dataclasses import replace

import numpy as np
import pytest
from coated_pins import COATING, FAST, PRESSURE, SLOW, STEEL, THROUGH, K, coated, flat
from paper_models import goes_on
from scipy.optimize import brentq

from tribo import WORN_DEPTH, Archard, Case, CaseError, Simulation, WearLaw, WearRate

SHARE = 0.1
"""Of the track, what is under the pin."""
FACTOR = {"factor": 2, "law": SLOW}


def ended(case, **options):
    with Simulation(case).run(**options) as result:
        return result.saves()[-1], result.warnings, result.totals()


def passed(case):
    """Return the last save, and the distances at which layers were worn through, in m."""
    with Simulation(case).run() as result:
        return result.saves()[-1], [f.distance for f in result.findings if f.kind == "layer"]


EXPLICIT = {"type": "explicit", "time_step": "170 s"}
SHORTER = {"type": "explicit", "time_step": "75 s"}


@pytest.mark.parametrize("stepping", [{"type": "implicit"}, EXPLICIT])
@pytest.mark.parametrize(("name", "share"), [("pin", 1.0), ("disk", SHARE)])
def test_an_even_pressure_wears_through_at_the_exact_distance(stepping, name, share):
    distance = 1.5 * THROUGH / share
    last, notices, _ = ended(flat(**{name: coated()}, distance=distance, stepping=stepping))
    exact = COATING + 10 * K * PRESSURE * share * (distance - THROUGH / share)
    assert last["bodies"][name]["max_wear_depth_m"] == pytest.approx(exact, rel=1e-9, abs=0)
    (told,) = notices
    assert told.startswith(f"layer: at {10 * THROUGH / share:g} s ({THROUGH / share:g} m) layer 1 ")
    assert told.endswith(f"layer 1 of {name}, down to 2 µm, is worn through at its deepest point")


def test_the_hardness_of_a_layer_is_that_of_its_law():
    hard = coated(hardness="10 GPa")
    hard["material"] = {**STEEL, "hardness": "1 GPa"}
    hard["layers"][0]["wear"] = None
    hard["wear"] = {"type": "archard", "K": 10 * K * 1e9}
    last, _, _ = ended(flat(pin=hard, distance=2 * THROUGH))
    exact = COATING + 10 * K * PRESSURE * THROUGH
    assert last["bodies"]["pin"]["max_wear_depth_m"] == pytest.approx(exact, rel=1e-9, abs=0)


def ball(cells, distance):
    sphere = {**coated(), "surface": {"type": "sphere", "radius": "5 mm"}}
    case = flat(pin=sphere)
    return {
        **case,
        "grid": {"size": "0.7 mm", "cells": cells},
        "kinematics": {**case["kinematics"], "distance": distance},
        "load": "20 N",
        "contact": {"type": "dcfft", "plasticity": False},
    }


def test_the_elasticity_of_a_layer_reaches_the_contact():
    case = ball(40, "1 mm")
    peaks = []
    for young in ("207 GPa", "1000 GPa"):
        layer = {"thickness": "50 um", "young": young}
        case["bodies"]["pin"]["layers"] = [layer]
        with Simulation(case).run() as result:
            peaks.append(result.saves()[0]["max_pressure_Pa"])
            assert result.report().first_contact.hertz_peak_pressure_Pa is None
    assert 1.1 * peaks[0] < peaks[1] < 2 * peaks[0]


def test_a_run_resumed_has_the_same_bits(tmp_path):
    case = flat(pin=coated(), distance="250 m", output={"save_times": ["1500 s"]})
    with goes_on(case, tmp_path, 9) as whole:
        (passed,) = whole.findings
        assert whole.provenance["components"]["bodies.pin.layers.1.wear"]["type"] == "archard"
    assert passed.place == "bodies.pin.layers.1"
    assert passed.distance == pytest.approx(THROUGH, rel=1e-9)
    assert passed.time == pytest.approx(10 * THROUGH, rel=1e-9)


def test_a_run_that_ends_at_a_depth_tells_only_of_layers_passed_by_then():
    _, notices, _ = ended(flat(pin=coated(), stop={"depth": "1.9 um"}))
    assert [notice.split(":")[0] for notice in notices] == ["stop"]


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ({**coated(), "wear": None}, "pin: layers wear through to the body: give its wear"),
        (
            coated(wear={"type": "archard", "K": 1e-6}),
            r"pin\.layers\.1\.wear: K needs a hardness",
        ),
        (
            coated(wear={"type": "smoothing", "roughness": 1e-6, "depth": 1e-6, **FACTOR})
            | {"wear": {"type": "smoothing", "roughness": 2e-6, "depth": 1e-6, **FACTOR}},
            r"pin\.layers: laws of the layers begin with different values of 'roughness'",
        ),
        (coated(young="400 GPa", thickness=-1), r"pin\.layers\.1\.thickness: "),
        (
            {**coated(), "layers": [{"thickness": 1e-6, "young": young} for young in (1e11, 2e11)]},
            r"pin\.layers: layers may differ from the body in young and poisson, but not",
        ),
    ],
)
def test_layers_that_cannot_be_are_refused(body, words):
    with pytest.raises(CaseError, match=rf"^bodies\.{words}"):
        Simulation(flat(pin=body))


@pytest.mark.parametrize("stepping", [{"type": "implicit"}, SHORTER])
def test_what_laws_of_layers_remember_goes_on_from_one_to_the_next(stepping):
    over, factor, distance = 100e6, 4.0, 30.0
    slow, fast = ({"type": "running_in", "factor": 4, "over": over, "law": k} for k in (SLOW, FAST))
    pin = {**coated(thickness="0.35 um"), "wear": fast}
    pin["layers"][0]["wear"] = slow

    def depth(s):
        return K * PRESSURE * s + (factor - 1) * K * over * (1 - np.exp(-PRESSURE * s / over))

    through = brentq(lambda s: depth(s) - 0.35e-6, 0, distance)
    last, found = passed(flat(pin=pin, distance=distance, stepping=stepping))
    exact = 0.35e-6 + 10 * (depth(distance) - 0.35e-6)
    assert last["bodies"]["pin"]["max_wear_depth_m"] == pytest.approx(exact, rel=1e-4, abs=0)
    assert found == [pytest.approx(through, rel=1e-4)]


@pytest.mark.parametrize("over", [1e6, 100e6])
@pytest.mark.parametrize("part", [0.5, 0.9])
def test_what_is_under_a_layer_runs_in_however_late_in_a_step_that_is_passed(part, over):
    # By up to 67 %, as the state of what was passed to last counted for nothing.
    thick, factor = 0.35e-6, 4.0
    pin = coated(thickness=thick)
    pin |= {"wear": {"type": "running_in", "factor": factor, "over": over, "law": FAST}}
    through = thick / (K * PRESSURE)
    last, found = passed(flat(pin=pin, distance=through / part))
    left = through / part - through
    below = PRESSURE * left + (factor - 1) * over * (1 - np.exp(-PRESSURE * left / over))
    exact = thick + 10 * K * below
    assert last["bodies"]["pin"]["max_wear_depth_m"] == pytest.approx(exact, rel=3e-4, abs=0)
    assert found == [pytest.approx(through, rel=1e-9)]


class Coating(WearLaw):
    """A stranger's: one wear rate down to a depth, another below."""

    type = "stranger.coating"
    thickness: float

    @property
    def state_fields(self):
        return (replace(WORN_DEPTH, breaks=(self.thickness,)),)

    def rate(self, local):
        k = np.where(local.state["worn_depth"] < self.thickness, K, 10 * K)
        return WearRate(k * local.pressure, k, {"worn_depth": k * local.pressure})


@pytest.mark.filterwarnings("ignore:resolution:tribo.TriboWarning")
def test_a_law_that_is_told_the_depth_worn_does_what_a_layer_does():
    layered = Case.model_validate(ball(16, "3 m"))
    own = Coating(thickness=layered.bodies["pin"].layers[0].thickness)
    pin = layered.bodies["pin"].model_copy(update={"layers": (), "wear": own})
    alone = layered.model_copy(update={"bodies": {**layered.bodies, "pin": pin}})
    one, other = ended(layered), ended(alone)
    assert one[0]["bodies"] == other[0]["bodies"]
    for count in ("steps", "contact_solves", "solver_iterations"):
        assert one[2][count] == other[2][count]


def test_a_break_of_the_law_of_a_layer_is_passed_and_is_no_layer():
    case = Case.model_validate(flat(pin=coated(hardness="20 GPa"), distance=150))
    pin = case.bodies["pin"]
    layer = pin.layers[0].model_copy(update={"wear": Coating(thickness=1e-6)})
    pin = pin.model_copy(update={"layers": (layer,), "wear": Archard(k=10 * K)})
    last, found = passed(case.model_copy(update={"bodies": {**case.bodies, "pin": pin}}))
    through = (1e-6 + 0.1e-6) / (K * PRESSURE)
    assert found == [pytest.approx(through, rel=1e-9)]
    exact = COATING + 10 * K * PRESSURE * (150 - through)
    assert last["bodies"]["pin"]["max_wear_depth_m"] == pytest.approx(exact, rel=1e-9, abs=0)
