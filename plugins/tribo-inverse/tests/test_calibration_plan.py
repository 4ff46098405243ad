"""How many tests are enough: by closed forms, and as the calibration itself finds."""

import json
import warnings

import numpy as np
import pytest
from calibrations import cheap, problem
from scipy.stats import norm, t
from tribo.core.errors import CaseError

from tribo_inverse.calibration.calibrate import calibrate
from tribo_inverse.calibration.linearised import Linearised, Weights, root_covariance
from tribo_inverse.calibration.plan import Search, plan_tests

CASE = cheap(300)
MASS = {"body": "ball", "quantity": "mass", "uncertainty": "0.2 ug"}


def fewest(kinds, within, *, scatters=True):
    return Search(np.array(kinds, dtype=float), within, 0.95, scatters).fewest().tolist()


@pytest.mark.parametrize("within", [0.3, 0.15, 0.1])
def test_of_one_kind_it_is_the_formula_of_student(within):
    """The smallest n with t s/√n within what is wanted."""
    scatter = 0.2
    n = next(n for n in range(2, 99) if t.ppf(0.975, n - 1) * scatter / n**0.5 <= within)
    assert fewest([[[scatter**-2]]], within) == [n]
    known = int(np.ceil((norm.ppf(0.975) * scatter / within) ** 2))
    assert fewest([[[scatter**-2]]], within, scatters=False) == [known]


def test_tests_that_tell_more_are_chosen_and_each_parameter_has_its_own():
    ball, disk, less = np.diag([25.0, 0.0]), np.diag([0.0, 25.0]), np.diag([5.0, 5.0])
    counts = fewest([ball, disk, less], 0.2)
    assert counts[0] == counts[1]
    assert counts[2] == 0


def test_the_expected_interval_is_that_of_a_calibration():
    """Two loads, two parameters, several values a test that scatter together."""
    effects = np.array([[1.0, 0.1], [0.3, 0.8], [2.0, 0.2], [0.6, 1.6]])
    counts, sigma = np.array([3, 2]), np.array([0.1, 0.05, 0.1, 0.05])
    of = np.concatenate([np.tile(rows, n) for rows, n in zip([[0, 1], [2, 3]], counts)])  # noqa: B905
    n = len(of)
    made = problem(np.ones(n), sigma[of], specimen=np.arange(n) // 2, repeatability=None)
    here = Linearised(made, np.zeros(2), np.ones(n), effects[of], Weights.of(sigma[of]))
    here = here.weighed(np.zeros(2), 0.2)
    whole = here.jacobian()
    kinds = np.array([whole[:2].T @ whole[:2], whole[-2:].T @ whole[-2:]])
    halves, freedom = Search(kinds, 0.1, 0.95, True).expected(counts)
    assert freedom == pytest.approx([here.degrees_of_freedom(axis) for axis in np.eye(2)], rel=1e-6)
    # Satterthwaite's formula by the residuals of the scatter of each test.
    scatter, inverse = here.weights.weigh(made.by_test(effects[of])), np.linalg.pinv(whole)
    left = scatter.T @ (scatter - whole @ (inverse @ scatter))
    slopes = np.sum((inverse @ scatter) ** 2, axis=1)
    variances = np.diag(inverse @ inverse.T)
    assert freedom == pytest.approx((variances / slopes) ** 2 * np.sum(left**2), rel=1e-6)
    deviations = np.sqrt(np.sum(root_covariance(whole) ** 2, axis=1))
    assert halves == pytest.approx(t.ppf(0.975, freedom) * deviations, rel=1e-6)


@pytest.mark.slow
def test_a_case_is_planned_without_values():
    tests = [
        {"name": "short", "set": {"kinematics.duration": 30}, "measured": [MASS]},
        {"name": "long", "measured": [MASS]},
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = plan_tests(CASE, {"test": tests, "repeatability": 0.2}, 0.15)
    # The short test's loss is of the size of its uncertainty; the long one's scatter decides.
    assert list(found.tests["count"]) == [0, 10]
    assert found.runs == 4
    assert found.findings == ()
    keys = ["level", "within", "runs", "tests", "parameters", "readings", "findings"]
    assert list(json.loads(json.dumps(found.as_json()))) == keys


def test_a_loss_that_the_balance_does_not_resolve_is_reported():
    balance = {"body": "ball", "quantity": "mass", "resolution": "0.1 mg"}
    found = plan_tests(CASE, {"measured": [balance], "repeatability": 0.2}, 0.9)
    (finding,) = found.findings
    assert (finding.kind, finding.limit) == ("reading", 1e-7)
    assert finding.value == found.readings["computed"].item() < 1e-7


@pytest.mark.parametrize(
    ("changes", "within", "words"),
    [
        ({}, 0.1, "repeatability: give the scatter from test to test"),
        (
            {"repeatability": 0.2},
            10,
            "the half-width of the interval, 10, must lie between 0 and 1",
        ),
        ({"repeatability": 2.9}, 0.01, "1000 tests are not enough for ±1 %, but give ±18 %"),
    ],
)
def test_what_cannot_be_planned_is_told(changes, within, words):
    with pytest.raises(CaseError, match=words):
        plan_tests(CASE, {"measured": [MASS], **changes}, within)


def test_values_are_needed_to_calibrate():
    with pytest.raises(CaseError, match=r"^measured\.1: give value, or before .* only with --plan"):
        calibrate(CASE, {"measured": [MASS]})
