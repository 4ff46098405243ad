"""Fit parameters of a case to measured wear: estimates, intervals, predictions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import chdtrc
from tribo import Array, Case, CaseError, Finding, NumericalError
from tribo.kernel_api import OutOfWindow, apply_settings, to_toml

from tribo_inverse.calibration.experiment import Experiment, check_sizes
from tribo_inverse.calibration.fit import (
    NO_EFFECT,
    Unsettled,
    fit,
    interval,
    limit,
    steps,
)
from tribo_inverse.calibration.linearised import Linearised, Weights, root_covariance
from tribo_inverse.calibration.measured import Measurements
from tribo_inverse.calibration.predictions import predicted
from tribo_inverse.calibration.quantities import (
    DEPTH_MAP,
    FIELDS,
    plain,
)
from tribo_inverse.findings import named, of_fit, off_level, off_middle

DATA = ["test", "body", "quantity", "time_s", "position_m", "place", "unit"]
DATA += ["measured", "below", "sigma", "computed", "residual"]
"""Columns of a calibration's data."""
PLACE = ["x_m", "y_m", "shift_x_m", "shift_y_m"]
"""Further columns, where a depth map is among the data."""
AT_BOUND = 1e-6
"""Relative distance below which an estimate counts as on its bound."""
SIGMA_CHANGE = 0.05
"""Relative change of a standard deviation, by errors of the grid, up to which a fit is kept."""


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
    interval, 0 or infinite where the data do not bound it; `resolution_share`, the part of its
    variance due to the resolution of instruments; `resolution_limit`, its largest error due to the
    resolution, relative to `value`; `held`, whether it lies on one of its bounds, which are then
    `lower` and `upper`; `limited`, whether only limits of detection depend on it, so that only
    `upper` is known."""
    data: pd.DataFrame
    """One row per measured value: `test`, empty for the case as it is; `body`, `quantity`,
    `time_s`, `position_m` on a profile, `place`, its entry in the file, `unit`, `measured`,
    `below`, whether it is a limit of detection, `sigma`, its standard deviation including the grid
    and the scatter from test to test, `computed`, and `residual`, computed less measured in units
    of `sigma`; √(−2 ln Φ(z)) for a limit that lies z above the computed value. A map has one row
    per block of cells, with its middle, `x_m` and `y_m`, and the shift of the scar from the middle
    of the map, `shift_x_m` and `shift_y_m`."""
    predictions: pd.DataFrame
    """Other quantities of the fitted case at the end of each test: `test`, `body`, `quantity`,
    `unit`, `value`, `lower`, `upper`; these equal where nothing fitted changes it, 0 and infinite
    if it depends on a parameter held by a bound. For a parameter that is `limited` the case is run
    at its upper bound. Where tests scatter, the interval is for the mean."""
    chi_square: float
    """Sum of squared weighted residuals, without limits of detection."""
    degrees_of_freedom: int
    """Values, without limits of detection, less the parameters that they determine and the shifts
    of maps."""
    repeatability: float
    """Relative standard deviation of the parameters from test to test."""
    repeatability_estimated: bool
    """Whether it is estimated from repeated tests, rather than stated or 0."""
    fitted: Mapping[str, Mapping[str, Any]]
    """The tables of each test's case with the estimates, by the name of the test."""
    correlation: Array
    """Correlation matrix of the logarithms of the parameters."""
    singular_values: Array
    """Of the weighted Jacobian by the logarithms of the parameters, largest first."""
    bic: float
    """Schwarz's criterion, −2 ln L + p ln n; p includes an estimated repeatability."""
    left_out: Array
    """Log-likelihood of each test predicted from all others; NaN if these do not determine a
    parameter."""
    findings: tuple[Finding, ...]
    """Findings on the data, the fit and the model."""

    @property
    def settings(self) -> dict[str, float]:
        """The estimates by path, as `tribo.config.overrides.apply_settings` takes them."""
        return {each.path: each.value for each in self.parameters.itertuples()}

    @property
    def notes(self) -> list[str]:
        """The findings in words."""
        return [each.words for each in self.findings]

    @property
    def brief(self) -> pd.DataFrame:
        """The data, with one row per depth map or profile.

        It has the number of `depths`, the means of `measured` and `computed`, and the root mean
        squares of `sigma` and `residual`.
        """
        parts, is_field = [], self.data["quantity"].isin(FIELDS)
        for _, rows in self.data.groupby(self.data["place"].where(is_field, self.data.index)):
            part = rows[:1].assign(depths=len(rows))
            if len(rows) > 1:
                means = rows[["measured", "computed"]].mean()
                squares = (rows[["sigma", "residual"]] ** 2).mean() ** 0.5
                part = part.assign(**means, **squares, position_m=math.nan)
            parts.append(part)
        return pd.concat(parts).sort_index()

    @property
    def p_value(self) -> float | None:
        """Probability of a χ² at least as large by chance; None without degrees of freedom."""
        if self.degrees_of_freedom == 0 or self.repeatability_estimated:
            return None
        return float(chdtrc(self.degrees_of_freedom, self.chi_square))

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data in SI units, the fitted cases as TOML; NaN stands for none."""
        fitted = {name: to_toml(tables) for name, tables in self.fitted.items()}
        findings = [asdict(each) for each in self.findings]
        more = {"p_value": self.p_value, "fitted": fitted, "notes": self.notes}
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
        others = {
            "mass": "value, or before and after",
            DEPTH_MAP: "depth, the file of a height map",
        }
        needed = others.get(each.quantity, "value")
        raise CaseError(f"give {needed}; only with --plan it may be left out", each.place)
    if (count := len(experiment.data)) < len(experiment.parameters):
        raise CaseError(
            f"{len(experiment.parameters)} parameters cannot be fitted to {count} measured "
            f"value{'' if count == 1 else 's'}: measure more, or leave parameters out of fit"
        )
    try:
        experiment = experiment.centred(experiment.start)
        first = experiment.run(experiment.start).responses
    except OutOfWindow as error:
        paths = " and ".join(p.path for p in experiment.parameters)
        raise NumericalError(f"give a start of {paths} in fit that is nearer; {error}") from error
    check_sizes(experiment.data, first, experiment.parameters)
    # Correlated errors of a map scale with its depth, which is known near the estimate only.
    problem = experiment.problem(experiment.start).without_common()

    least, told = math.inf, 0

    def responses(values: Array) -> Array:
        found = experiment.run(values).responses
        misfit = float(np.sum(problem.residuals(found, problem.weights()) ** 2))
        nonlocal least, told
        if experiment.run_count > told:
            told = experiment.run_count
            on_run(told, misfit if misfit < least else math.nan)
        least = min(least, misfit)
        return found

    try:
        unsettled: Unsettled | None = None
        try:
            fitted = fit(responses, problem, experiment.start)
        except Unsettled as error:
            # The uncertainties at the start may be too far off to settle it.
            fitted, unsettled = error.last, error
        estimate, before = np.exp(fitted.point), problem.sigma
        experiment = experiment.centred(estimate)
        problem = experiment.problem(estimate)
        if problem.common.size or np.any(np.abs(problem.sigma - before) > SIGMA_CHANGE * before):
            estimate, least = np.where(fitted.limited(), experiment.start, estimate), math.inf
            fitted = fit(responses, problem, estimate, steps(fitted))
        elif unsettled:
            raise unsettled
    except (CaseError, NumericalError) as error:
        if all(setup.model.case.stop.depth is None for setup in experiment.setups):
            raise
        words = (
            "leave out stop.depth: it ends the run at different times for different coefficients"
        )
        raise type(error)(f"{words}; {error}") from error
    return _outcome(fitted, experiment, level)


def _outcome(fitted: Linearised, experiment: Experiment, level: float) -> Calibration:
    """Return the calibration that follows from a fit."""
    jacobian, data = fitted.sensitivity(), experiment.data
    last = experiment.run(np.exp(fitted.point))
    root = root_covariance(jacobian)
    deviations = np.sqrt(np.sum(root**2, axis=1))
    estimates = _estimates(fitted, jacobian, experiment, level)
    held = estimates["held"].to_numpy()
    settled = {each.path: float(f"{each.value:.7g}") for each in estimates.itertuples()}
    problem, computed = fitted.problem, fitted.responses[: len(data)]
    effects = fitted.effects(fitted.point)
    scatter = fitted.repeatability * np.sqrt(np.sum(effects**2, axis=1))
    sigma = np.hypot(problem.sigma, scatter)
    residuals = fitted.residuals(fitted.point)
    chi_square = float(np.sum(residuals[~problem.below] ** 2))
    data = data.assign(
        stated=data["sigma"],
        sigma=sigma,
        computed=computed,
        residual=problem.residuals(computed, Weights.of(sigma)),
        alone=residuals,
    )
    determined = np.max(np.abs(jacobian[~problem.below]), axis=0, initial=0.0) > NO_EFFECT
    moved = sum(bool(far) for each in experiment.shifts.values() for far in each.shift)
    freedom = max(int(np.sum(~problem.below)) - int(np.sum(determined & ~held)) - moved, 0)
    predictions = predicted(fitted, experiment, estimates, level)
    scatters = problem.repeatability is None
    return Calibration(
        level=level,
        runs=experiment.run_count,
        parameters=estimates,
        data=data[DATA + PLACE if "x_m" in data else DATA],
        predictions=predictions,
        chi_square=chi_square,
        degrees_of_freedom=freedom,
        repeatability=fitted.repeatability,
        repeatability_estimated=scatters,
        fitted={each.name: apply_settings(each.case, settled) for each in experiment.setups},
        correlation=root @ root.T / np.outer(deviations, deviations),
        singular_values=np.asarray(np.linalg.svd(jacobian, compute_uv=False), dtype=np.float64),
        bic=fitted.deviance(fitted.point) + (len(held) + scatters) * math.log(len(data)),
        left_out=fitted.left_out(),
        findings=(
            *_of_places(experiment, last.maps),
            *of_fit(estimates, data, jacobian, None if scatters else freedom),
            *last.findings,
        ),
    )


def _of_places(experiment: Experiment, depths: Mapping[int, Array]) -> Iterator[Finding]:
    """Report maps whose scar is off the middle, or that are not levelled."""
    for reading, depth in depths.items():
        row, found = experiment.table.loc[reading], experiment.shifts[reading]
        where = named(row), row["place"]
        for axis, (shift, sigma) in enumerate(zip(*found, strict=True)):
            if shift:
                yield off_middle(*where, axis, shift, sigma)
        yield from off_level(
            *where, experiment.on_cells(reading, found.shift)[0], depth, row["sigma"]
        )


def _estimates(
    fitted: Linearised, jacobian: Array, experiment: Experiment, level: float
) -> pd.DataFrame:
    """Return `Calibration.parameters`."""
    table = pd.DataFrame(experiment.parameters).drop(columns="start")
    values = np.exp(fitted.point)
    lower, upper = table[["lower", "upper"]].to_numpy(float, copy=True).T
    held = (values - lower <= AT_BOUND * values) | (upper - values <= AT_BOUND * values)
    limited = fitted.limited() & ~held
    for i in np.flatnonzero(~held):
        axis = np.eye(len(values))[i]
        if limited[i]:
            low, high = -math.inf, limit(fitted, axis, level)
        else:
            low, high = interval(fitted, axis, level)
        lower[i] = max(values[i] * math.exp(low), lower[i])
        upper[i] = min(values[i] * math.exp(high), upper[i])
    standard = np.asarray(np.linalg.pinv(jacobian), dtype=np.float64)
    effect = fitted.weights.weigh_transposed(standard.T).T
    deviation, most = experiment.data[["step_sigma", "step_most"]].to_numpy().T
    share = np.sum((effect * deviation) ** 2, axis=1) / np.sum(standard**2, axis=1)
    return table[["path", "unit"]].assign(
        value=values,
        lower=lower,
        upper=upper,
        resolution_share=share,
        resolution_limit=np.sum(np.abs(effect) * most, axis=1),
        held=held,
        limited=limited,
    )
