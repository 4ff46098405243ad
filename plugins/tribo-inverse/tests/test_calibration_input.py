"""Wrong measured values are refused by their place, before anything runs."""

import tomllib

import numpy as np
import pytest
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError, NumericalError
from tribo.templates import template

from tribo_inverse.calibration.calibrate import calibrate
from tribo_inverse.calibration.experiment import check_sizes
from tribo_inverse.calibration.measured import read_measurements
from tribo_inverse.calibration.parameters import Parameter

CASE = apply_settings(
    tomllib.loads(template("ball_on_disk")), {"grid.cells": 16, "grid.size": "2 mm"}
)
GOOD = {"body": "ball", "quantity": "mass", "value": "2 mg", "uncertainty": "0.1 mg"}
SCAR = {"quantity": "scar_along", "uncertainty": "1 um"}
K = "bodies.ball.wear.k"
POWER = {"type": "power", "k": 3e-16, "p_exponent": 1.5, "reference_pressure": "1 GPa"}


def refused(*measured, fit=(), case=CASE):
    with pytest.raises(CaseError) as caught:
        calibrate(case, {"measured": list(measured), "fit": list(fit)}, on_run=unreached)
    assert len(str(caught.value).splitlines()) == 1
    return str(caught.value)


def unreached(run, misfit):
    raise AssertionError("a run was made")


def changed(**changes):
    """The good value with changes; None leaves a key out."""
    return {key: value for key, value in {**GOOD, **changes}.items() if value is not None}


@pytest.mark.parametrize(
    ("changes", "place", "words"),
    [
        ({"value": "2 mm"}, ".1.value", "[kg]"),
        ({"value": "-2 mg"}, ".1.value", "half the limit of detection"),
        ({"value": "< 2 mg"}, ".1.value", "'< 2 mg'"),
        ({"value": ["1 mg", "nan mg"]}, ".1.value", "nan mg"),
        ({"value": []}, ".1", "empty"),
        ({"value": None}, ".1", "give value"),
        ({"value": None, "before": "27 g"}, ".1", "give value"),
        ({"value": None, "before": "27.1 g", "after": "27.2 g"}, ".1", "no loss"),
        ({"uncertainty": "0.1 mm"}, ".1.uncertainty", "[m]"),
        ({"uncertainty": "0 %"}, ".1.uncertainty", "100 %"),
        ({"uncertainty": "few %"}, ".1.uncertainty", "'5 %'"),
        ({"uncertainty": "5 %", "value": None}, ".1.uncertainty", "to plan"),
        ({"uncertainty": None}, ".1", "uncertainty"),
        ({"quantity": "mas"}, ".1.quantity", "'mass'"),
        ({"body": "bal"}, ".1.body", "'bal'"),
        ({"time": "2 h"}, ".1.time", "3600 s"),
        (SCAR | {"body": "disk", "value": "1 mm"}, ".1.quantity", "'disk'"),
        (SCAR | {"quantity": "scar_across", "value": "3 mm"}, ".1.value", "2 mm"),
        (
            {"quantity": "section", "value": "1 mm^2", "uncertainty": "1 mm^2"},
            ".1.quantity",
            "'ball'",
        ),
        (SCAR | {"value": "1 mm", "before": "27 g"}, ".1", "scar_along has no before"),
    ],
)
def test_a_wrong_value_is_told(changes, place, words):
    text = refused(changed(**changes))
    assert text.startswith(f"measured{place}")
    assert words in text


@pytest.mark.parametrize(
    ("fit", "place", "words"),
    [
        ({"path": "bodies.bal.wear.k"}, ".1.path", f"did you mean '{K}'?"),
        ({"path": "grid.cells.1"}, ".1.path", "is 16 in this case"),
        ({"path": "load"}, ".1.path", "load is no physical number in this case"),
        ({"path": "a..b"}, ".1.path", "'a..b' is not a path"),
        ({"path": K, "start": "1 Pa"}, ".1.start", "an inverse pressure [1/Pa] is needed"),
        ({"path": K, "start": -1}, ".1.start", "must be greater than 0"),
        ({"path": K, "lower": 1e-15}, ".1", "3.11e-16, must lie between lower, 1e-15, and upper"),
        ({"path": "bodies.ball.material.poisson", "upper": 0.6}, ".1.upper", "less than 0.5"),
        ({"path": "bodies.disk.wear.p_exponent", "lower": 0.8}, ".1.lower", "must be at least 1"),
    ],
)
def test_a_wrong_parameter_is_told(fit, place, words):
    text = refused(GOOD, fit=[fit], case=apply_settings(CASE, {"bodies.disk.wear": POWER}))
    assert text.startswith(f"fit{place}: ")
    assert words in text


@pytest.mark.parametrize(
    ("changes", "remedy"),
    [
        ({"bodies.ball.wear": None}, "give it a wear law, bodies.ball.wear"),
        ({"bodies.ball.material.density": None}, "add bodies.ball.material.density"),
        ({K: 0}, "fit.start: "),
        ({"bodies.ball.wear": {"type": "archard", "K": 1e-6}}, "fit: "),
    ],
)
def test_a_case_that_lacks_what_is_needed_is_told(changes, remedy):
    case = apply_settings(CASE, changes)
    ball = case["bodies"]["ball"]
    for table, key in ((ball, "wear"), (ball["material"], "density")):
        if table[key] is None:
            del table[key]
    text = refused(GOOD, case=case)
    assert remedy in text if remedy.endswith(("wear", "density")) else text.startswith(remedy)


def test_a_level_is_a_probability():
    with pytest.raises(CaseError, match="the level, 95, must lie between 0 and 1"):
        calibrate(CASE, {"measured": [GOOD]}, level=95)


def one_test(**changes):
    return {"test": [{"measured": [GOOD], **changes}], "fit": [{"path": K}]}


LOADS = [{"name": "a", "set": {"load.normal": load}, "measured": [GOOD]} for load in (50, 70)]
TWICE = [{"path": "load.normal"}, {"path": 'load."normal"'}]
PAIR = [{"path": K}, {"path": "bodies.disk.wear.k"}]


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ({"measured": [GOOD, GOOD], "fit": TWICE}, "fit.2.path: "),
        ({"measured": [GOOD], "fit": PAIR}, "2 parameters cannot be fitted to 1 measured value:"),
        ({"measured": []}, "nothing is measured; give each value, as {"),
        (one_test(measured=GOOD), "test.1.measured: a list is needed, a table was given"),
        ({"test": LOADS}, "test: two tests that differ are called 'a'"),
        (one_test(set={"load.normal": "-5 N"}), "test.1.set: load.normal: "),
        (one_test(set={"bodies": {"bal": {"wear": {"k": 1}}}}), "test.1.set: bodies: "),
        (one_test(set={K: 1e-15}), f"test.1.set: {K} is given, and {K} is fitted"),
        (one_test(set={"bodies.ball.wear": {"type": "archard", "k": 1}}), "test.1.set: bodies."),
        (one_test(measured=[changed(time="2 h")]), "test.1.measured.1.time: 7200 s is not"),
    ],
)
def test_tests_and_parameters_that_do_not_go_together_are_told(data, words):
    with pytest.raises(CaseError) as caught:
        calibrate(CASE, data, on_run=unreached)
    assert str(caught.value).startswith(words)


@pytest.mark.parametrize(
    ("changes", "sigma"),
    [
        ({"uncertainty": "1 mg"}, [1e-6]),
        # Two readings of a balance.
        ({"uncertainty": "3 mg", "resolution": "4 mg"}, [1e-6 * (9 + 16 / 6) ** 0.5]),
        ({"value": ["2 mg", "3 mg"], "uncertainty": "5 % "}, [1e-7, 1.5e-7]),
        ({"value": None, "before": "2.5 g", "after": "2.498 g", "uncertainty": "5 %"}, [1e-7]),
        # One reading of a length.
        (SCAR | {"value": "1 mm", "uncertainty": None, "resolution": "4 um"}, [4e-6 / 12**0.5]),
    ],
)
def test_the_standard_deviation_of_a_value(changes, sigma):
    table = read_measurements({"measured": [changed(**changes)]}).table()
    assert table["sigma"].to_list() == pytest.approx(sigma, rel=1e-6, abs=0)


def test_a_start_at_which_the_scar_outgrows_the_window_is_told():
    far = {"measured": [GOOD], "fit": [{"path": K, "start": 1e-11}]}
    words = rf"^give a start of {K} in fit that is nearer; run 1, .* reached the edge"
    with pytest.raises(NumericalError, match=words):
        calibrate(CASE, far)


@pytest.mark.parametrize(
    ("value", "sigma", "computed"),
    [
        # One is 300 times the other at most.
        (299e-6, 1e-9, 1e-6),
        (1e-6, 1e-9, 299e-6),
        # Of a loss below its uncertainty that counts.
        (1e-12, 1e-9, 299e-9),
    ],
)
def test_what_is_far_off_may_be_meant(value, sigma, computed):
    entry = {"body": "disk", "quantity": "mass", "value": value, "uncertainty": sigma}
    data = read_measurements({"measured": [entry]}).table()
    fitted = [Parameter("bodies.disk.wear.k", "1/Pa", 1.5e-16, 0.0, np.inf)]
    check_sizes(data, np.array([computed]), fitted)
    further = computed * 1.01 if computed > value else computed / 1.01
    with pytest.raises(CaseError, match=r"^measured\.1 was read as "):
        check_sizes(data, np.array([further]), fitted)
