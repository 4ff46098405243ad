"""Layers of a body: worn through at the distance that follows from their rates."""

from dataclasses import replace

import numpy as np
import pytest
from coated_pins import COATING, PRESSURE, SLOW, THROUGH, K, coated, flat
from paper_models import goes_on

from tribo import WORN_DEPTH, Archard, Case, CaseError, Simulation, WearLaw, WearRate

FACTOR = {"factor": 2, "law": SLOW}


def ended(case, **options):
    with Simulation(case).run(**options) as result:
        return result.saves()[-1], result.warnings, result.totals()


def passed(case):
    """Return the last save, and the distances at which layers were worn through, in m."""
    with Simulation(case).run() as result:
        return result.saves()[-1], [f.distance for f in result.findings if f.kind == "layer"]


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
