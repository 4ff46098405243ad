"""Sampled intervals are those of closed forms, and of the fit where the case is a power law."""

import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner
from command_line import tribo as command
from scipy.optimize import brentq
from scipy.stats import norm, truncnorm
from tribo.cli.main import tribo
from tribo.config.load import read_toml
from tribo.core.errors import CaseError, Interrupted, NumericalError

import tribo_inverse.calibration.experiment as experiment
from tribo_inverse.calibration.calibrate import calibrate
from tribo_inverse.calibration.fit import fit, interval
from tribo_inverse.calibration.linearised import Problem
from tribo_inverse.calibration.sample import sampled
from tribo_inverse.calibration.setups import Run

EXAMPLES = Path(__file__).parents[3] / "examples"
CASE, WEIGHED = EXAMPLES / "weighed_split.toml", EXAMPLES / "weighed.toml"


def sampled_of(observed, below, repeatability, count, fails=lambda k: None):
    """Sampled and fitted intervals of numbers that were each measured, some repeatedly."""
    which = np.cumsum([0, *(a != b for a, b in pairwise(below))])
    ends = np.full(which[-1] + 1, np.inf)
    problem = Problem(
        names=("a", "b")[: len(ends)],
        observed=np.array(observed),
        sigma=np.full(len(observed), 0.1),
        below=np.array(below),
        specimen=np.arange(len(observed)),
        repeatability=repeatability,
        small=np.zeros(len(observed)),
        lower=-ends,
        upper=ends,
        common=np.zeros((len(observed), 0)),
    )
    found = fit(lambda k: k[which], problem, np.ones(len(ends)))
    axes = np.eye(len(ends))
    both = np.exp(
        [found.point[i] + np.array(interval(found, axes[i], 0.95)) for i in range(len(axes))]
    )
    estimates = pd.DataFrame({"lower": both[:, 0], "upper": both[:, 1], "limited": found.limited()})

    def model(k):
        fails(k)
        return k[which]

    return sampled(model, found, estimates, count, 0.95)[0]


def test_known_errors_give_normal_intervals_and_a_limit_its_closed_form():
    """Flat before, of a number below 1 ± 0.1 the part σ (φ(z) − z Φ(−z)) lies above 1 + σ z."""
    values = [0.9, 1.2, 1.0, 0.95]
    first, second = sampled_of([*values, 1.0], [False] * 4 + [True], 0.0, 8000).itertuples()
    middle, half = np.mean(values), 1.96 * 0.1 / 2
    assert first.sampled_lower == pytest.approx(middle - half, abs=0.12 * half)
    assert first.sampled_upper == pytest.approx(middle + half, abs=0.12 * half)
    z = brentq(lambda z: 0.1 * (norm.pdf(z) - z * norm.sf(z)) - 0.05, -2, 2)
    assert (second.sampled_lower, second.limited) == (0, True)
    assert second.sampled_upper == pytest.approx(1 + 0.1 * z, abs=0.02)


@pytest.mark.parametrize("error", [NumericalError, Interrupted])
def test_what_cannot_be_run_bounds_an_interval_and_an_interrupt_ends_it(error, capsys):
    def fails(k):
        if k[0] > 1.05:
            raise error("too wide")

    if error is Interrupted:
        with pytest.raises(Interrupted, match="too wide"):
            sampled_of([1.0, 1.0], [False, False], 0.0, 400, fails)
    else:
        (found,) = sampled_of([1.0, 1.0], [False, False], 0.0, 400, fails).itertuples()
        assert found.sampled_lower < 0.95 < found.sampled_upper < 1.05
    assert capsys.readouterr().out == ""


def test_a_repeatability_of_few_tests_is_sampled_too():
    """As Student's t makes the interval longer than the 0.40 that it is if they scatter by 0.2."""
    (only,) = sampled_of([0.7, 1.3, 0.9, 1.1, 0.85, 1.15], [False] * 6, None, 4000).itertuples()
    assert only.sampled_lower == pytest.approx(only.lower, abs=0.06)
    assert only.sampled_upper == pytest.approx(only.upper, abs=0.06)
    assert only.upper - only.lower > 0.45


@pytest.fixture
def losses(monkeypatch):
    """Make each quantity of a body proportional to its coefficient, with no run."""

    def made(tables, parameters, values, wanted, *rest):
        k = dict(zip([p.path.split(".")[1] for p in parameters], values, strict=True))
        return Run(
            np.array([2e-6 / 7.08e-15 * k.get(w.body, 0.0) for w in wanted]),
            np.zeros(len(wanted)),
            {},
            (),
        )

    monkeypatch.setattr("tribo_inverse.calibration.experiment.make_run", made)


def test_the_command_prints_sampled_intervals_of_the_weighed_coefficients(losses):
    runs = []
    found = calibrate(CASE, WEIGHED, sample=1200, on_run=lambda run, misfit: runs.append(run))
    assert runs == sorted({*runs})
    assert 600 < found.runs == runs[-1] < 1300
    assert any(note.startswith("ends of sampled intervals lie up to") for note in found.notes)
    asked = ["calibrate", str(CASE), "--measured", str(WEIGHED), "--sample", "1200"]
    ended = CliRunner().invoke(tribo, asked)
    for each in found.parameters.itertuples():
        off = 0.12 * (each.upper - each.lower)
        assert each.sampled_lower == pytest.approx(each.lower, abs=off)
        assert each.sampled_upper == pytest.approx(each.upper, abs=off)
        for end in (each.sampled_lower, each.sampled_upper):
            assert f"{end:.3g}" in ended.stdout.split()
    refused = CliRunner().invoke(tribo, [*asked, "--plan", "0.1"])
    assert (
        str(refused.exception) == "--sample is for one case fitted to [[measured]], without --plan"
    )


@pytest.mark.parametrize("error", [KeyboardInterrupt(), Interrupted("stopped at 5 s of 9 s")])
def test_an_interrupt_while_it_is_sampled_does_not_lose_the_fit(
    losses, monkeypatch, tmp_path, error
):
    made, runs = experiment.make_run, []

    def interrupted(*arguments):
        runs.append(arguments)
        if len(runs) > 50:
            raise error
        return made(*arguments)

    monkeypatch.setattr(experiment, "make_run", interrupted)
    asked = ["calibrate", CASE, "--measured", WEIGHED, "--sample", 1200]
    ended = command(*asked, "-o", tmp_path / "fitted.toml")
    assert ended.returncode == 130
    assert "7.08e-16 1/Pa" in ended.stdout
    assert "Note: sampling was interrupted: the intervals are not" in ended.stdout
    assert "stopped while sampling" in ended.stderr
    assert read_toml(tmp_path / "fitted.toml")["bodies"]["disk"]["wear"]["k"] == 7.08e-16
    assert len(runs) < 60


@pytest.fixture
def products(monkeypatch):
    """Make each quantity proportional to the product of the coefficients alone."""

    def made(tables, parameters, values, wanted, *rest):
        return Run(
            np.full(len(wanted), 1e-6 * np.prod(values / 3e-16)), np.zeros(len(wanted)), {}, ()
        )

    monkeypatch.setattr("tribo_inverse.calibration.experiment.make_run", made)


def test_a_fit_that_the_data_leave_open_is_kept_without_samples(products):
    found = calibrate(CASE, WEIGHED, sample=1200)
    assert np.isinf(found.parameters["upper"]).all()
    assert "sampled_lower" not in found.parameters
    assert found.notes[-1].startswith(
        "nothing was sampled, since the data do not bound bodies.ball.wear.k from above: give it"
    )


def test_what_the_data_leave_open_is_sampled_up_to_its_bounds(products):
    fitted = [{"path": f"bodies.{n}.wear.k", "upper": 1e-14} for n in ("ball", "disk")]
    found = calibrate(CASE, read_toml(WEIGHED) | {"fit": fitted}, sample=1200)
    assert (found.parameters["sampled_upper"] > 3e-15).all()
    assert (found.parameters["sampled_upper"] < 1e-14).all()


@pytest.mark.slow
def test_an_estimate_held_by_its_bound_is_sampled_beside_it(losses):
    """By a loss of 2 ± 0.1 mg, normal but for what is cut off above 0.75 of it."""
    entry = {"body": "ball", "quantity": "mass", "value": "2 mg", "uncertainty": "0.1 mg"}
    best = 7.08e-15
    fitted = {"path": "bodies.ball.wear.k", "start": 0.5 * best, "upper": 0.75 * best}
    found = calibrate(CASE, {"measured": [entry], "fit": [fitted]}, sample=4000)
    (only,) = found.parameters.itertuples()
    low, high = best * truncnorm.ppf([0.025, 0.975], -20, -5, loc=1, scale=0.05)
    assert only.held
    assert only.sampled_lower == pytest.approx(low, abs=0.2 * (high - low))
    assert only.sampled_upper == pytest.approx(high, abs=0.02 * (high - low))


def test_what_cannot_be_sampled_is_refused(losses, monkeypatch):
    with pytest.raises(
        CaseError, match="10 samples are too few for 2 parameters: give 1200 or more"
    ):
        calibrate(CASE, WEIGHED, sample=10)
    monkeypatch.setitem(sys.modules, "emcee", None)
    with pytest.raises(CaseError, match="sampling needs emcee, which is not installed: pip inst"):
        calibrate(CASE, WEIGHED, sample=1200)
