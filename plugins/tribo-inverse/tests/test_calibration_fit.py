"""The intervals cover the truth as often as they say, for a model that is a closed form."""

import numpy as np
import pytest
from ball_on_track import ball_on_track
from calibrations import problem
from scipy.stats import norm, t
from tribo.core.errors import CaseError, NumericalError, OutOfWindow

from tribo_inverse.calibration import fit as fitting
from tribo_inverse.calibration.fit import interval
from tribo_inverse.calibration.linearised import Weights, root_covariance

TRUE = np.array([7.08e-15, 7.08e-16])


def fit(model, made, start):
    """The fit of a problem whose weights are the same at each run."""
    return fitting.fit(model, lambda values: made, start)


def worn(k):
    """Scar along and across, depth of the ball and of the groove, volume of the ball."""
    end = ball_on_track(
        distance=[360.0],
        load=100.0,
        radius=5e-3,
        track_length=2e-3,
        ball_wear_coefficient=k[0],
        flat_wear_coefficient=k[1],
    )
    return np.array(
        [
            2 * end.half_width_along[0],
            2 * end.half_width_across[0],
            end.ball_depth[0],
            end.flat_depth[0],
            end.ball_volume[0],
        ]
    )


class Counted:
    def __init__(self, model):
        self.model, self.runs = model, 0

    def __call__(self, values):
        self.runs += 1
        return self.model(values)


def test_a_power_law_is_met_in_four_runs_from_anywhere_near():
    powers = np.array([[1.0, 0.0], [0.2, 0.7]])
    model = Counted(lambda k: np.exp(powers @ np.log(k / TRUE)))
    near = 1.5 * TRUE
    found = fit(model, problem(np.ones(2), np.full(2, 0.01), start=near), near)
    assert np.exp(found.point) == pytest.approx(TRUE, rel=1e-9, abs=0)
    # The start, a difference for each parameter, and the estimate.
    assert model.runs == 4


def test_far_from_the_start_slopes_are_taken_anew():
    model = Counted(worn)
    start = TRUE / 20
    found = fit(model, problem(worn(TRUE), 0.01 * worn(TRUE), start=start), start)
    assert np.exp(found.point) == pytest.approx(TRUE, rel=1e-3, abs=0)
    assert model.runs <= 8


def depths(values):
    """Depths at two loads and many pressures, whose law has an exponent, relative to its scale."""
    k, exponent = values
    return k * np.concatenate([load * np.linspace(0.1, 2, 50) ** exponent for load in (0.4, 1)])


def test_a_fit_that_errors_of_its_steps_shake_settles():
    """As those of adaptive steps, each a little of a depth's uncertainty, but of all alike."""
    truth, sigma, off = np.array([5.0, 1.35]), 0.01, []
    for seed in range(20):
        random = np.random.default_rng(seed)

        def shaken(values, random=random):
            tilt = np.linspace(-1, 1, 100)
            return depths(values) * (1 + 3e-5 * (random.normal() + random.normal() * tilt))

        observed = depths(truth) + sigma * random.standard_normal(100)
        model, near = Counted(shaken), truth * [0.9, 0.96]
        given = problem(observed, np.full(100, sigma), names=("k", "n"), start=near)
        found = fit(model, given, near)
        assert model.runs <= 20
        deviations = np.sqrt(np.sum(root_covariance(found.jacobian()) ** 2, axis=1))
        off.append((found.point - np.log(truth)) / deviations)
    assert np.std(off) < 1.2


def in_window(k):
    """A diameter that at first follows the load alone, which must stay in a window."""
    if k[0] > 150:
        raise OutOfWindow(f"k of {k[0]:.0f}")
    return (1 + k) ** 0.25


def test_a_step_that_outgrows_the_window_is_halved():
    start, diameter = np.array([0.2]), in_window(np.array([100.0]))
    made = problem(diameter, 0.01 * diameter, names=("k",), start=start)
    found = fit(in_window, made, start)
    assert np.exp(found.point) == pytest.approx(100.0, rel=1e-2)


def test_a_scar_larger_than_the_window_is_told():
    start, diameter = np.array([0.2]), np.array([5.0])
    made = problem(diameter, 0.01 * diameter, names=("k",), start=start)
    with pytest.raises(OutOfWindow, match="k of 1"):
        fit(in_window, made, start)


def test_the_interval_of_a_volume_is_that_of_the_weighing():
    """A volume is k F s: its interval, and that of k, is the measured one, though wide."""
    observed, sigma = np.array([2.0]), np.array([0.5])
    found = fit(lambda k: k, problem(observed, sigma, names=("k",), start=np.ones(1)), np.ones(1))
    low, high = interval(found, np.ones(1), 0.9)
    z = norm.ppf(0.95)
    assert 2 * np.exp(low) == pytest.approx(2 - 0.5 * z, rel=1e-3)
    assert 2 * np.exp(high) == pytest.approx(2 + 0.5 * z, rel=1e-3)


def test_a_loss_of_the_size_of_its_uncertainty_bounds_from_above_only():
    made = problem(np.array([1.0]), np.array([0.8]), names=("k",), start=np.ones(1))
    found = fit(lambda k: k, made, np.ones(1))
    low, high = interval(found, np.ones(1), 0.95)
    assert low == -np.inf
    assert np.exp(high) == pytest.approx(1 + 0.8 * norm.ppf(0.975), rel=1e-3)
    # And so for a diameter that goes as the fourth root.
    low, high = interval(found, np.array([0.25]), 0.95)
    assert low == -np.inf
    assert np.exp(high) == pytest.approx((1 + 0.8 * norm.ppf(0.975)) ** 0.25, rel=1e-3)


@pytest.mark.parametrize("spread", [0.02, 0.3])
def test_repeated_tests_give_the_interval_of_student(spread):
    """Mean ± t s/√n, however exact each was measured; their scatter is s over the mean."""
    values = 1 + spread * np.array([-1.2, -0.3, 0.1, 0.2, 1.4])
    made = problem(values, np.full(5, 1e-4), names=("k",), start=np.ones(1), repeatability=None)
    found = fit(lambda k: np.repeat(k, 5), made, np.array([0.8]))
    mean, error = np.mean(values), np.std(values, ddof=1)
    assert np.exp(found.point) == pytest.approx(mean, rel=1e-4)
    assert found.repeatability == pytest.approx(error / mean, rel=1e-2)
    low, high = mean * (np.exp(interval(found, np.ones(1), 0.95)) - 1)
    half = t.ppf(0.975, 4) * error / 5**0.5
    assert (low, high) == pytest.approx((-half, half), rel=2e-2)


def test_values_of_one_test_scatter_together():
    """Ten readings of each of two tests know the mean no better than the two tests do."""
    one = {"specimen": np.repeat([0, 1], 10), "repeatability": 0.2}
    made = problem(np.ones(20), np.full(20, 1e-3), names=("k",), start=np.ones(1), **one)
    low, high = interval(fit(lambda k: np.repeat(k, 20), made, np.ones(1)), np.ones(1), 0.95)
    half = norm.ppf(0.975) * 0.2 / 2**0.5
    assert (np.exp(low), np.exp(high)) == pytest.approx((1 - half, 1 + half), rel=1e-2)


def test_the_weights_are_the_root_of_the_inverse_covariance():
    """Of three tests."""
    random, n = np.random.default_rng(2), 9
    made = problem(np.ones(n), random.uniform(0.1, 1, n), specimen=np.arange(n) % 3)
    effects = random.standard_normal((n, 2))
    together = made.by_test(effects)
    weights = Weights.of(made.sigma, 0.3 * together)
    alike = np.arange(n)[:, None] % 3 == np.arange(n) % 3
    covariance = np.diag(made.sigma**2) + 0.09 * np.where(alike, effects @ effects.T, 0)
    root = weights.weigh(np.eye(n))
    assert root.T @ root @ covariance == pytest.approx(np.eye(n), abs=1e-12)
    assert weights.weigh_transposed(np.eye(n)) == pytest.approx(root.T, abs=1e-12)
    assert weights.weigh(effects[:, 0]) == pytest.approx(root @ effects[:, 0], abs=1e-12)
    size = -0.5 * np.linalg.slogdet(covariance)[1]
    assert weights.log_determinant == pytest.approx(size, abs=1e-12)


def test_scatter_that_the_instrument_explains_is_none():
    values = 1 + 0.01 * np.array([-1.0, 1.0, -1.0, 1.0])
    made = problem(values, np.full(4, 0.05), names=("k",), start=np.ones(1), repeatability=None)
    assert fit(lambda k: np.repeat(k, 4), made, np.ones(1)).repeatability == 0


def test_an_interval_ends_at_the_bound():
    made = problem(np.array([1.0]), np.array([0.3]), names=("k",), start=np.ones(1), reach=0.1)
    low, high = interval(fit(lambda k: k, made, np.ones(1)), np.ones(1), 0.95)
    assert (low, high) == pytest.approx((-0.1, 0.1), rel=0.01)


def test_what_only_a_product_tells_is_left_open():
    made = problem(np.array([1.0, 2.0]), np.full(2, 0.01), start=np.ones(2))
    model = lambda k: np.array([1.0, 2.0]) * k[0] * k[1]  # noqa: E731
    found = fit(model, made, np.array([1.1, 1.0]))
    assert interval(found, np.eye(2)[0], 0.95) == (-np.inf, np.inf)
    # The product itself is known.
    low, high = interval(found, np.ones(2), 0.95)
    assert high - low == pytest.approx(2 * norm.ppf(0.975) * 0.01 / np.sqrt(1 + 2**2), rel=0.01)


def test_a_parameter_without_effect_is_named():
    made = problem(np.array([1.0, 2.0]), np.full(2, 0.1), start=np.ones(2))
    with pytest.raises(CaseError, match=r"a change of disk by a factor e changes .* by 0 of"):
        fit(lambda k: np.array([k[0], k[0] ** 2]), made, np.ones(2))


@pytest.mark.parametrize("start", [0.9901, 1.0, 1.01])
def test_no_run_is_made_beyond_the_bounds(start):
    """Not for a difference either, where the bounds are near."""
    bounds = np.exp([-0.01, 0.01])
    made = problem(np.ones(1), np.full(1, 1e-3), names=("k",), start=np.ones(1), reach=0.01)

    def model(k):
        assert bounds[0] * (1 - 1e-12) <= k[0] <= bounds[1] * (1 + 1e-12)
        return k

    assert np.exp(fit(model, made, np.array([start])).point) == pytest.approx(1.0, rel=1e-5)


def test_a_fit_that_comes_no_nearer_is_given_up():
    """The model is too rough for the uncertainty."""
    random = np.random.default_rng(0)
    rough = Counted(lambda k: 30 + 10 * np.log(k) + 20 * random.standard_normal(1))
    made = problem(np.array([10.0]), np.ones(1), names=("k",), start=np.ones(1))
    with pytest.raises(NumericalError, match=r"have not settled .*: χ² has come down to"):
        fit(rough, made, np.ones(1))
    assert rough.runs <= 26
