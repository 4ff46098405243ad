"""Fit parameters of a case to measured wear: estimates, intervals, predictions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from html import escape
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import chdtrc
from tribo import Array, Case, CaseError, Finding, NumericalError
from tribo.kernel_api import Console, OutOfWindow, apply_settings, to_toml

from tribo_inverse.calibration.experiment import Experiment, check_sizes
from tribo_inverse.calibration.fit import fit, interval
from tribo_inverse.calibration.linearised import Linearised, Weights, root_covariance
from tribo_inverse.calibration.measured import Measurements
from tribo_inverse.calibration.predictions import predicted
from tribo_inverse.calibration.quantities import plain
from tribo_inverse.findings import of_fit
from tribo_inverse.tables import fit_tables, print_all

DATA = ["test", "body", "quantity", "time_s", "place", "unit"]
DATA += ["measured", "sigma", "computed", "residual"]
"""Columns of a calibration's data."""
AT_BOUND = 1e-6
"""Relative distance below which an estimate counts as on its bound."""


@dataclass(frozen=True, eq=False)
class Calibration:
    """Estimates, the data, and predictions; in SI units.

    Examples
    --------
    >>> from tribo_inverse import calibrate
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "output={}", "kinematics.duration=2"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> mass = {"body": "ball", "quantity": "mass", "value": "0.2 ug", "uncertainty": "10 ng"}
    >>> found = calibrate(case, {"measured": [mass], "fit": [{"path": "bodies.ball.wear.k"}]})
    >>> k = found.parameters.iloc[0]
    >>> f"{found.level:.0%} interval of k: {k.lower:.2g} to {k.upper:.2g} 1/Pa"
    '95% interval of k: 1.1e-15 to 1.4e-15 1/Pa'
    """

    level: float
    """Confidence level of the intervals."""
    runs: int
    """Number of simulations."""
    parameters: pd.DataFrame
    """One row per parameter: `path`, `unit`, `value`; `lower` and `upper`, the ends of its
    interval, 0 or infinite where the data do not bound it; `held`, whether it lies on one of its
    bounds, which are then `lower` and `upper`."""
    data: pd.DataFrame
    """One row per measured value: `test`, empty for the case as it is; `body`, `quantity`,
    `time_s`, `place`, its entry in the file, `unit`, `measured`,
    `sigma`, its standard deviation including the grid and the scatter from test to test,
    `computed`, and `residual`, computed less measured in units of `sigma`."""
    predictions: pd.DataFrame
    """Other quantities of the fitted case at the end of each test: `test`, `body`, `quantity`,
    `unit`, `value`, `lower`, `upper`; these equal where nothing fitted changes it, 0 and infinite
    if it depends on a parameter held by a bound. Where tests scatter, the interval is for the
    mean."""
    chi_square: float
    """Sum of squared weighted residuals."""
    degrees_of_freedom: int
    """Values less the parameters that are not held."""
    repeatability: float
    """Relative standard deviation of the parameters from test to test."""
    repeatability_estimated: bool
    """Whether it is estimated from repeated tests, rather than stated or 0."""
    fitted: Mapping[str, Any]
    """The tables of the case with the estimates."""
    correlation: Array
    """Correlation matrix of the logarithms of the parameters."""
    singular_values: Array
    """Of the weighted Jacobian by the logarithms of the parameters, largest first."""
    bic: float
    """Schwarz's criterion, −2 ln L + p ln n; p includes an estimated repeatability."""
    findings: tuple[Finding, ...]
    """Findings on the data, the fit and the model."""

    def __str__(self) -> str:
        """Return the tables and warnings that `tribo calibrate` prints."""
        text = StringIO()
        print_all(fit_tables(self), self.findings, Console(file=text))
        return text.getvalue().rstrip()

    def _repr_html_(self) -> str:
        """Show the same in a notebook."""
        notes = "".join(f"<p>Warning: {escape(note)}</p>" for note in self.notes)
        return "".join(table._repr_html_() for table in fit_tables(self)) + notes

    @property
    def settings(self) -> dict[str, float]:
        """The estimates by path, as `tribo.config.overrides.apply_settings` takes them."""
        return {each.path: each.value for each in self.parameters.itertuples()}

    @property
    def notes(self) -> list[str]:
        """The findings in words."""
        return [each.words for each in self.findings]

    @property
    def p_value(self) -> float | None:
        """Probability of a χ² at least as large by chance; None without degrees of freedom."""
        if self.degrees_of_freedom == 0 or self.repeatability_estimated:
            return None
        return float(chdtrc(self.degrees_of_freedom, self.chi_square))

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data in SI units, the fitted case as TOML; NaN stands for none."""
        findings = [asdict(each) for each in self.findings]
        more = {"p_value": self.p_value, "fitted": to_toml(self.fitted), "notes": self.notes}
        return plain(self) | more | {"findings": findings}


def calibrate(
    case: Case | Mapping[str, Any] | str | Path,
    measured: Measurements | Mapping[str, Any] | str | Path,
    *,
    level: float = 0.95,
    on_run: Callable[[int, float], object] = lambda run, misfit: None,
) -> Calibration:
    """Fit parameters of a case to wear measured in one or more tests.

    Weighted least squares by Gauss-Newton steps in the logarithms of the parameters, exact for
    volumes under Archard's law. Repeated tests share their runs, which have no observers.

    Parameters
    ----------
    case : Case, Mapping, str or Path
        A case, its tables, or its TOML file.
    measured : Measurements, Mapping, str or Path
        Measured values of the case or of other tests, and the parameters to fit; or a TOML file.
    level : float, optional
        Confidence level of the intervals.
    on_run : callable, optional
        Called after each round of runs with the number of runs and their χ²; NaN where it is not
        the least so far.

    Returns
    -------
    Calibration
        Estimates, intervals, residuals, notes, predictions.

    Raises
    ------
    CaseError, NumericalError
        If the case or the measured values are wrong, a run fails, or the fit does not converge.

    Examples
    --------
    >>> from tribo_inverse import calibrate
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "output={}", "kinematics.duration=2"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> mass = {"body": "ball", "quantity": "mass", "value": "0.2 ug", "uncertainty": "10 ng"}
    >>> found = calibrate(case, {"measured": [mass], "fit": [{"path": "bodies.ball.wear.k"}]})
    >>> {path: f"{k:.3g} 1/Pa" for path, k in found.settings.items()}  # by 100 N over 0.2 m
    {'bodies.ball.wear.k': '1.27e-15 1/Pa'}
    """
    if not 0 < level < 1:
        raise CaseError(f"the level, {level:g}, must lie between 0 and 1, as 0.95 does")
    experiment = Experiment.of(case, measured)
    for each in experiment.data[experiment.data["measured"].isna()].itertuples():
        needed = "value, or before and after" if each.quantity == "mass" else "value"
        raise CaseError(f"give {needed}; only with --plan it may be left out", each.place)
    if (count := len(experiment.data)) < len(experiment.parameters):
        raise CaseError(
            f"{len(experiment.parameters)} parameters cannot be fitted to {count} measured "
            f"value{'' if count == 1 else 's'}: measure more, or leave parameters out of fit"
        )
    try:
        first = experiment.run(experiment.start).responses
    except OutOfWindow as error:
        paths = " and ".join(p.path for p in experiment.parameters)
        raise NumericalError(f"give a start of {paths} in fit that is nearer; {error}") from error
    check_sizes(experiment.data, first, experiment.parameters)
    least, told = math.inf, 0

    def responses(values: Array) -> Array:
        found = experiment.run(values).responses
        problem = experiment.problem(values)
        misfit = float(np.sum(problem.residuals(found, Weights.of(problem.sigma)) ** 2))
        nonlocal least, told
        if experiment.run_count > told:
            told = experiment.run_count
            on_run(told, misfit if misfit < least else math.nan)
        least = min(least, misfit)
        return found

    fitted = fit(responses, experiment.problem, experiment.start)
    return _outcome(fitted, experiment, level)


def _outcome(fitted: Linearised, experiment: Experiment, level: float) -> Calibration:
    """Return the calibration that follows from a fit."""
    jacobian, data = fitted.jacobian(), experiment.data
    last = experiment.run(np.exp(fitted.point))
    root = root_covariance(jacobian)
    deviations = np.sqrt(np.sum(root**2, axis=1))
    estimates = _estimates(fitted, experiment, level)
    held = estimates["held"].to_numpy()
    settled = {each.path: float(f"{each.value:.7g}") for each in estimates.itertuples()}
    problem, computed = fitted.problem, fitted.responses[: len(data)]
    effects = fitted.effects(fitted.point)
    scatter = fitted.repeatability * np.sqrt(np.sum(effects**2, axis=1))
    sigma = np.hypot(problem.sigma, scatter)
    residuals = fitted.residuals(fitted.point)
    data = data.assign(
        sigma=sigma,
        computed=computed,
        residual=problem.residuals(computed, Weights.of(sigma)),
        alone=residuals,
    )
    freedom = max(len(data) - int(np.sum(~held)), 0)
    predictions = predicted(fitted, experiment, estimates, level)
    scatters = problem.repeatability is None
    return Calibration(
        level=level,
        runs=experiment.run_count,
        parameters=estimates,
        data=data[DATA],
        predictions=predictions,
        chi_square=float(np.sum(residuals**2)),
        degrees_of_freedom=freedom,
        repeatability=fitted.repeatability,
        repeatability_estimated=scatters,
        fitted=apply_settings(experiment.tables, settled),
        correlation=root @ root.T / np.outer(deviations, deviations),
        singular_values=np.asarray(np.linalg.svd(jacobian, compute_uv=False), dtype=np.float64),
        bic=fitted.deviance(fitted.point) + (len(held) + scatters) * math.log(len(data)),
        findings=(
            *of_fit(estimates, data, jacobian, None if scatters else freedom),
            *last.findings,
        ),
    )


def _estimates(fitted: Linearised, experiment: Experiment, level: float) -> pd.DataFrame:
    """Return `Calibration.parameters`."""
    table = pd.DataFrame(experiment.parameters).drop(columns="start")
    values = np.exp(fitted.point)
    lower, upper = table[["lower", "upper"]].to_numpy(float, copy=True).T
    held = (values - lower <= AT_BOUND * values) | (upper - values <= AT_BOUND * values)
    for i in np.flatnonzero(~held):
        low, high = interval(fitted, np.eye(len(values))[i], level)
        lower[i] = max(values[i] * math.exp(low), lower[i])
        upper[i] = min(values[i] * math.exp(high), upper[i])
    return table[["path", "unit"]].assign(value=values, lower=lower, upper=upper, held=held)
