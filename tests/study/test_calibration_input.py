"""What is wrong with measured values is said in one clear message, before anything runs."""

import tomllib
from typing import get_args

import pytest

from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError
from tribo.study import calibrate
from tribo.study.calibration.measured import Measured, read_measurements
from tribo.study.calibration.quantities import PROFILES, QUANTITIES
from tribo.templates import template

CASE = apply_settings(
    tomllib.loads(template("ball_on_disk")), {"grid.cells": 16, "grid.size": "2 mm"}
)
GOOD = {"body": "ball", "quantity": "mass", "value": "2 mg", "uncertainty": "0.1 mg"}


def refused(*measured, fit=(), case=CASE):
    with pytest.raises(CaseError) as caught:
        calibrate(case, {"measured": list(measured), "fit": list(fit)}, on_run=unreached)
    return str(caught.value)


def unreached(run, misfit):
    raise AssertionError("a run was made")


def changed(**changes):
    """The good value with changes; None leaves a key out."""
    return {key: value for key, value in {**GOOD, **changes}.items() if value is not None}


def test_every_quantity_can_be_asked_for():
    names = get_args(Measured.model_fields["quantity"].annotation)
    assert set(names) == {*QUANTITIES, *PROFILES}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"value": "2 mm"},
            "measured[0].value: '2 mm' is a length [m]; a mass [kg] is needed, as in '2 g'",
        ),
        (
            {"quantity": "scar_along", "uncertainty": "1 um"},
            "measured[0].value: '2 mg' is a mass [kg]; a length [m] is needed",
        ),
        (
            {"quantity": "section", "value": "1 mm", "uncertainty": "1 mm^2"},
            "measured[0].value: '1 mm' is a length [m]; an area [m^2] is needed",
        ),
        ({"uncertainty": "0.1 mm"}, "measured[0].uncertainty: '0.1 mm' is a length [m]"),
        ({"uncertainty": "-0.1 mg"}, "measured[0].uncertainty: -0.1 mg: must be greater than 0"),
        ({"uncertainty": 0}, "measured[0].uncertainty: 0 kg: must be greater than 0"),
        ({"value": "-2 mg"}, "measured[0].value: -2 mg: must be greater than 0"),
        ({"value": "some"}, "measured[0].value: 'some' is not a quantity; a mass [kg] is needed"),
        ({"quantity": "mas"}, "is needed, 'mas' was given; did you mean 'mass'?"),
        ({"quantity": None}, "measured[0].quantity: missing"),
        ({"boddy": "ball"}, "measured[0].boddy: unknown key 'boddy'; did you mean 'body'?"),
        ({"body": "bal"}, "measured[0].body: there is no body 'bal'; did you mean 'ball'?"),
        ({"uncertainty": None}, "measured[0]: say how well it was measured: uncertainty"),
        ({"value": None}, "measured[0]: give value, or before and after"),
        ({"before": "27 g"}, "measured[0]: give value, or before and after"),
        ({"value": None, "before": "27 g"}, "measured[0]: give value, or before and after"),
        (
            {"value": None, "before": "27.1 g", "after": "27.2 g"},
            "measured[0]: before, 27.1 g, is not more than after, 27.2 g: no loss was weighed",
        ),
        ({"value": ["1 mg", "2 mg"]}, "measured[0]: mass is one value, without position"),
        ({"time": "2 h"}, "measured[0].time: 7200 s is not reached: the run ends at 3600 s"),
        ({"time": "2 m"}, "measured[0].time: '2 m' is a length [m]; a time [s] is needed"),
        (
            {"body": "disk", "quantity": "scar_along", "value": "1 mm", "uncertainty": "1 um"},
            "measured[0].quantity: body 'disk' is swept: its scar is a track, the same all along",
        ),
        (
            {"quantity": "section", "value": "1 mm^2", "uncertainty": "1 mm^2"},
            "measured[0].quantity: body 'ball' stays in the contact: it has no track",
        ),
        (
            {
                "quantity": "profile_along",
                "value": ["1 um"],
                "uncertainty": "1 um",
                "position": ["1 mm", "2 mm"],
            },
            "measured[0]: profile_along needs value and position, two lists of the same length, "
            "not 1 and 2 long",
        ),
        (
            {
                "quantity": "profile_along",
                "value": ["1 um"],
                "uncertainty": "1 um",
                "position": ["1.1 mm"],
            },
            "measured[0].position: 1.1 mm lies outside the window, which reaches 1 mm from",
        ),
        (
            {
                "quantity": "profile_along",
                "value": ["-80 um", "-104 um", "2 um"],
                "uncertainty": "5 um",
                "position": ["-0.3 mm", "0 mm", "0.9 mm"],
            },
            "measured[0]: the depths are negative, -60.7 µm in the mean; depths count downwards "
            "from the unworn surface, positive where it is worn: turn the sign round",
        ),
    ],
)
def test_a_wrong_value_is_told(changes, message):
    text = refused(changed(**changes))
    assert message in text
    assert len(text.splitlines()) == 1


@pytest.mark.parametrize(
    ("fit", "message"),
    [
        (
            {"path": "bodies.bal.wear.k"},
            "fit[0].path: bodies.bal.wear.k: unknown key 'bal'; did you mean 'ball'? Allowed: ball",
        ),
        (
            {"path": "bodies.ball.wear.kk"},
            "unknown key 'kk'; did you mean 'k'? Allowed: k, K, hardness",
        ),
        ({"path": "load.normal.x"}, "fit[0].path: load.normal is 100.0 in this case, no table"),
        ({"path": "bodies.ball.wear"}, "fit[0].path: bodies.ball.wear is a table in this case"),
        ({"path": "bodies.ball.wear.K"}, "bodies.ball.wear.K is not given in this case"),
        ({"path": "grid.cells.0"}, "grid.cells.0 is 16 in this case; only a number with decimals"),
        ({"path": "a..b"}, "fit[0].path: 'a..b' is not a path"),
        (
            {"path": "bodies.ball.wear.k", "start": "1 Pa"},
            "fit[0].start: '1 Pa' is a pressure [Pa]; an inverse pressure [1/Pa] is needed",
        ),
        (
            {"path": "bodies.ball.wear.k", "start": -1},
            "fit[0].start: -1 1/Pa: must be greater than 0",
        ),
        (
            {"path": "bodies.ball.wear.k", "lower": 1e-15},
            "fit[0]: the start, 3.11e-16, must lie between lower, 1e-15, and upper",
        ),
        (
            {"path": "bodies.ball.material.poisson", "upper": 0.6},
            "fit[0].upper: 0.6: must be less than 0.5",
        ),
        (
            {"path": "bodies.ball.wear.k", "begin": 1},
            "fit[0].begin: unknown key 'begin'. Allowed: path, start, lower, upper",
        ),
        ({}, "fit[0].path: missing"),
    ],
)
def test_a_wrong_parameter_is_told(fit, message):
    text = refused(GOOD, fit=[fit])
    assert message in text
    assert len(text.splitlines()) == 1


def test_a_parameter_given_twice_is_told():
    fit = [{"path": "load.normal"}, {"path": 'load."normal"'}]
    assert refused(GOOD, GOOD, fit=fit) == "fit[1].path: 'load.\"normal\"' is given twice"


def test_fewer_data_than_parameters_are_told():
    fit = [{"path": "bodies.ball.wear.k"}, {"path": "bodies.disk.wear.k"}]
    assert refused(GOOD, fit=fit) == (
        "2 parameters cannot be fitted to 1 measured value: measure more, or leave parameters out "
        "of fit"
    )


def test_a_case_in_the_place_of_measured_values_is_told():
    with pytest.raises(CaseError, match="this is a case, not measured values"):
        calibrate(CASE, CASE)


def test_nothing_measured_is_told():
    assert refused() == "measured: nothing is measured; give each value as [[measured]]"


def test_a_body_that_does_not_wear_has_no_scar():
    case = apply_settings(CASE, {})
    del case["bodies"]["ball"]["wear"]
    entry = changed(quantity="scar_along", value="1 mm", uncertainty="1 um")
    assert refused(entry, case=case) == (
        "measured[0].quantity: body 'ball' does not wear in this case; give it a wear law, "
        "bodies.ball.wear"
    )


def test_a_mass_needs_a_density():
    case = apply_settings(CASE, {})
    del case["bodies"]["ball"]["material"]["density"]
    assert "add bodies.ball.material.density to the case" in refused(GOOD, case=case)


def test_a_coefficient_of_zero_needs_a_start():
    case = apply_settings(CASE, {"bodies.ball.wear.k": 0})
    assert refused(GOOD, case=case).startswith("fit.start: bodies.ball.wear.k is 0 in this case")


def test_without_a_coefficient_fit_must_be_given():
    case = apply_settings(CASE, {"bodies.ball.wear": {"type": "archard", "K": 1e-6}})
    assert refused(GOOD, case=case).startswith("fit: no measured body has a wear coefficient k")


def test_a_level_is_a_probability():
    with pytest.raises(CaseError, match="the level, 95, must lie between 0 and 1"):
        calibrate(CASE, {"measured": [GOOD]}, level=95)


def test_a_parameter_that_changes_nothing_is_told():
    """How stiff a body is does not change how much it loses."""
    loss = changed(value="0.5 ug", uncertainty="0.05 ug")
    data = {"measured": [loss], "fit": [{"path": "bodies.ball.material.young"}]}
    case = apply_settings(CASE, {"kinematics.duration": 20, "output": {}})
    with pytest.raises(
        CaseError, match=r"^bodies.ball.material.young changes none of the measured"
    ):
        calibrate(case, data)


def test_a_profile_that_noise_makes_negative_is_taken():
    entry = {
        "body": "ball",
        "quantity": "profile_along",
        "value": ["-2 um", "1 um"],
        "uncertainty": "1 um",
        "position": ["0 mm", "0.5 mm"],
    }
    (read,) = read_measurements({"measured": [entry]}).measured
    assert read.values == pytest.approx([-2e-6, 1e-6])


@pytest.mark.parametrize(
    ("changes", "sigma"),
    [
        ({"uncertainty": "1 mg"}, 1e-6),
        # Two readings of a balance.
        ({"uncertainty": None, "resolution": "0.1 mg"}, 1e-7 / 6**0.5),
        ({"uncertainty": "3 mg", "resolution": "4 mg"}, 1e-6 * (9 + 16 / 6) ** 0.5),
    ],
)
def test_the_uncertainty_of_a_mass(changes, sigma):
    (entry,) = read_measurements({"measured": [changed(**changes)]}).measured
    assert entry.sigma == pytest.approx(sigma, rel=1e-6, abs=0)


def test_the_uncertainty_of_one_reading():
    entry = {"body": "ball", "quantity": "depth", "value": 1e-6, "resolution": "0.1 um"}
    (entry,) = read_measurements({"measured": [entry]}).measured
    assert entry.sigma == pytest.approx(1e-7 / 12**0.5, rel=1e-6, abs=0)
    assert entry.from_resolution[1] == pytest.approx(0.5e-7, rel=1e-6, abs=0)
