"""Data of one law speak for it where they can, and are said not to where they cannot."""

import json

import numpy as np
import pytest
from calibrations import cheap, problem
from scipy.stats import multivariate_normal
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError

from tribo_inverse.calibration.choice import choose_case
from tribo_inverse.calibration.fit import fit

ARCHARD = cheap(100)
POWER = {"type": "power", "k": 3.11e-16, "p_exponent": 2.0, "reference_pressure": "1 GPa"}
CASES = {"archard": ARCHARD, "power": apply_settings(ARCHARD, {"bodies.ball.wear": POWER})}
PER_LOAD = 3.11e-16 * 10.0 * 7850.0
"""What Archard's law takes off per newton, in kg."""


def weighed(load, part):
    mass = PER_LOAD * load
    entry = {"body": "ball", "quantity": "mass", "value": mass, "uncertainty": part * mass}
    return {"name": f"{load} N", "set": {"load.normal": load}, "measured": [entry]}


@pytest.mark.slow
def test_the_law_that_made_the_data_is_chosen_where_they_are_exact():
    """A pressure falls as the scar grows, so that losses of other laws are not as the load."""
    exact = {"test": [weighed(load, 0.02) for load in (40, 100)]}
    found = choose_case(CASES, exact)
    assert list(found.cases["case"]) == ["archard", "power"]
    assert (found.finding.kind, found.finding.place) == ("chosen", "archard")
    assert found.finding.value == np.diff(found.cases["bic"]).item()
    assert found.cases["weight"][0] > 0.95
    rough = {"test": [weighed(load, 0.5) for load in (40, 100)]}
    told = choose_case(CASES, rough).finding
    assert (told.kind, told.place) == ("undecided", "archard, power")
    assert told.value < told.limit
    assert json.dumps(found.as_json())


def test_what_is_wrong_with_one_case_is_told_before_another_is_run():
    fit = [{"path": "bodies.ball.wear.k"}, {"path": "bodies.ball.wear.p_exponent", "lower": 0.5}]
    runs = []
    with pytest.raises(CaseError, match=r"power: .*must be at least 1"):
        choose_case(
            CASES,
            {"test": [weighed(40, 0.02), weighed(100, 0.02)], "fit": fit},
            on_run=lambda *run: runs.append(run),
        )
    assert not runs


def test_the_deviance_is_that_of_the_normal_distribution():
    values = np.array([0.9, 1.05, 1.1])
    made = problem(values, np.full(3, 0.01), names=("k",))
    found = fit(lambda k: np.repeat(k, 4), lambda k: made, np.ones(1))
    whole = multivariate_normal.logpdf(values, np.full(3, np.mean(values)), 0.01**2)
    assert found.deviance(found.point) == pytest.approx(-2 * whole, rel=1e-4)


@pytest.mark.parametrize(
    ("cases", "fit", "words"),
    [
        (["archard"], [], "give two cases or more"),
        (["archard", "power"], ["bodies.ball.wear.b"], r"fit\.1\.path: bodies.ball.wear.b is a "),
        (["archard", "power"], ["bodies.ball.wear.p_exponent"], "archard has none of the numbers"),
    ],
)
def test_what_cannot_be_compared_is_told(cases, fit, words):
    measured = {"test": [weighed(50, 0.1)], "fit": [{"path": path} for path in fit]}
    with pytest.raises(CaseError, match=words):
        choose_case({name: CASES[name] for name in cases}, measured)
