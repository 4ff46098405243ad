"""Result of a calibration: estimates, intervals, residuals, predictions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import chdtrc, chdtri

from tribo.config.overrides import apply_settings
from tribo.core.arrays import Array
from tribo.study.calibration.fit import NO_EFFECT, NOTABLE, interval
from tribo.study.calibration.linearised import Linearised, root_covariance, weigh
from tribo.study.calibration.notes import notes
from tribo.study.calibration.posed import Posed
from tribo.study.calibration.quantities import QUANTITIES, plain

DATA = ["test", "body", "quantity", "time_s", "position_m", "unit"]
DATA += ["measured", "below", "sigma", "computed", "residual"]
"""Columns of a calibration's data."""
AT_BOUND = 1e-6
"""Relative distance below which an estimate counts as on its bound."""


@dataclass(frozen=True, eq=False)
class Calibration:
    """Estimates, the data behind them, and predictions; in SI units."""

    level: float
    """Probability with which each interval is to cover the truth."""
    runs: int
    """Simulations that it took."""
    parameters: pd.DataFrame
    """A row a parameter, in the order asked for: `path`, `unit`, `value`; `lower` and `upper`, the
    ends of its interval, infinite or 0 where the data do not bound it; `resolution_share`, the part
    of its variance that comes from instruments' resolution; `resolution_limit`, how far it may be
    off through resolution alone, in the worst case, relative to `value`; `held`, whether it lies on
    one of its bounds, which `lower` and `upper` then are; `limited`, whether only limits of
    detection tell of it: `upper` is then all that is known, and `value` as good as none."""
    data: pd.DataFrame
    """A row a measured value: `test`, empty for one of the case as it is; `body`, `quantity`,
    `time_s`, `position_m` of a profile's point, `unit`, `measured`, `below` for a limit that the
    reading was below, `sigma`, `computed`, and `residual`, computed less measured, in units of
    `sigma`: the standard deviation of the measured value, with which the grid gives the computed
    one, and from test to test. That of a limit is √(−2 ln Φ(z)) for a computed value z standard
    deviations below it."""
    predictions: pd.DataFrame
    """What else the fitted case gives at the end of each test, in the mean, where tests scatter:
    `test`, `body`, `quantity`, `unit`, `value`, `lower`, `upper`; 0 and infinite where it depends
    on a parameter that a bound holds."""
    chi_square: float
    """Sum of the squared residuals, limits left out, in standard deviations of what is independent
    where tests scatter."""
    degrees_of_freedom: int
    """Values, limits left out, less the parameters that they depend on and no bound holds."""
    repeatability: float
    """Relative standard deviation of the parameters from test to test."""
    repeatability_estimated: bool
    """Whether it is estimated from tests alike, rather than stated or 0."""
    fitted: Mapping[str, Mapping[str, Any]]
    """The tables of each test's case with the estimates, by the name of the test."""
    correlation: Array
    """Between the logarithms of the parameters."""
    singular_values: Array
    """Of the derivatives of the residuals by the logarithms of the parameters, largest first: the
    standard deviations by which a change by a factor e would show in the data."""
    bic: float
    """Schwarz's criterion, −2 ln L + p ln n, the repeatability a parameter where estimated."""
    left_out: Array
    """Log-likelihood of each test foretold from all others; NaN where those do not determine a
    parameter, none of a single test."""
    notes: tuple[str, ...]
    """Remarks on what the data can tell."""

    @property
    def settings(self) -> dict[str, float]:
        """The estimates by path, as `tribo.config.overrides.apply_settings` takes them."""
        return {each.path: each.value for each in self.parameters.itertuples()}

    @property
    def p_value(self) -> float | None:
        """Probability of a misfit at least as large by chance.

        None without data to spare, and where they tell the repeatability.
        """
        if self.degrees_of_freedom == 0 or self.repeatability_estimated:
            return None
        return float(chdtrc(self.degrees_of_freedom, self.chi_square))

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data in SI units; what is not given is NaN."""
        found = plain(self) | {"p_value": self.p_value}
        return {name: value for name, value in found.items() if name != "fitted"}


def outcome(fitted: Linearised, posed: Posed, level: float) -> Calibration:
    """Return the calibration that follows from a fit."""
    jacobian, data = fitted.sensitivity(), posed.data
    last = posed.run(np.exp(fitted.point))
    root = root_covariance(jacobian)
    deviations = np.sqrt(np.sum(root**2, axis=1))
    estimates = _estimates(fitted, jacobian, posed, level)
    held, limited = (estimates[name].to_numpy() for name in ("held", "limited"))
    settled = {each.path: float(f"{each.value:.7g}") for each in estimates.itertuples()}
    problem, computed = fitted.problem, fitted.responses[: len(data)]
    effects = fitted.effects(fitted.point)
    scatter = fitted.repeatability * np.sqrt(np.sum(effects**2, axis=1))
    sigma = np.hypot(problem.sigma, scatter)
    data = data.assign(
        stated=data["sigma"],
        sigma=sigma,
        computed=computed,
        residual=problem.residuals(computed, 1 / sigma),
    )
    told = np.max(np.abs(jacobian[~problem.below]), axis=0, initial=0.0) > NO_EFFECT
    spare = max(int(np.sum(~problem.below)) - int(np.sum(told & ~held)), 0)
    positive = np.all([made.responses > 0 for made in posed.runs.values()], axis=0)
    rows = []
    for i, each in enumerate(posed.predicted.itertuples(), len(data)):
        if not positive[i]:
            continue
        value, ends = float(fitted.responses[i]), (0.0, math.inf)
        if not np.any(np.abs(fitted.slopes[i][held]) > NOTABLE):
            below, above = value - value * np.exp(interval(fitted, fitted.slopes[i], level))
            by = math.sqrt(chdtri(1, 1 - level)) * float(last.read_off[i])
            least = 0.0 if np.any(fitted.slopes[i][limited] > NOTABLE) else value - below
            ends = max(value - math.hypot(value - least, by), 0.0), value + math.hypot(above, by)
        unit = QUANTITIES[each.quantity].unit
        rows.append((each.test, each.body, each.quantity, unit, value, *ends))
    columns = ["test", "body", "quantity", "unit", "value", "lower", "upper"]
    return Calibration(
        level=level,
        runs=posed.made,
        parameters=estimates,
        data=data[DATA],
        predictions=pd.DataFrame(rows, columns=columns),
        chi_square=float(np.sum(fitted.residuals(fitted.point)[~problem.below] ** 2)),
        degrees_of_freedom=spare,
        repeatability=fitted.repeatability,
        repeatability_estimated=problem.repeatability is None,
        fitted={each.name: apply_settings(each.case, settled) for each in posed.tested},
        correlation=root @ root.T / np.outer(deviations, deviations),
        singular_values=np.asarray(np.linalg.svd(jacobian, compute_uv=False), dtype=np.float64),
        bic=fitted.deviance(fitted.point)
        + (len(held) + (problem.repeatability is None)) * math.log(len(data)),
        left_out=fitted.left_out(),
        notes=(
            *notes(estimates, data, jacobian, None if problem.repeatability is None else spare),
            *last.notices,
        ),
    )


def _estimates(fitted: Linearised, jacobian: Array, posed: Posed, level: float) -> pd.DataFrame:
    """Return `Calibration.parameters`."""
    table = pd.DataFrame(posed.parameters).drop(columns="start")
    values = np.exp(fitted.point)
    lower, upper = table[["lower", "upper"]].to_numpy(float, copy=True).T
    held = (values - lower <= AT_BOUND * values) | (upper - values <= AT_BOUND * values)
    limited = fitted.limited() & ~held
    for i in np.flatnonzero(~held):
        low, high = values[i] * np.exp(interval(fitted, np.eye(len(values))[i], level))
        lower[i], upper[i] = max(0.0 if limited[i] else low, lower[i]), min(high, upper[i])
    standard = np.asarray(np.linalg.pinv(jacobian), dtype=np.float64)
    effect = weigh(fitted.weights.T, standard.T).T
    deviation, most = posed.data[["step_sigma", "step_most"]].to_numpy().T
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
