"""What a calibration found: estimates, intervals, residuals, predictions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import chdtrc, chdtri

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.study.calibration.fit import NOTABLE, Surrogate, interval, root_covariance
from tribo.study.calibration.measured import Measured
from tribo.study.calibration.notes import notes
from tribo.study.calibration.parameters import Parameter
from tribo.study.calibration.quantities import QUANTITIES, Reading

AT_BOUND = 1e-6
"""How near to a bound an estimate lies on it, relative."""


@dataclass(frozen=True, eq=False)
class Calibration:
    """Estimates, what they rest on, and what they predict; in SI units.

    Parameters
    ----------
    level : float
        Probability with which each interval is to cover the truth.
    runs : int
        Simulations that it took.
    parameters : DataFrame
        A row a parameter, in the order asked for: `path`, `unit`, `value`;
        `lower` and `upper`, the ends of its interval, infinite or 0 where the
        data do not bound it; `resolution_share`, the part of its variance that
        comes from instruments' resolution; `resolution_limit`, how far it may
        be off through resolution alone, in the worst case, relative to
        `value`; `held`, whether it lies on one of its bounds, so that it has no
        interval; `lower` and `upper` are then its bounds.
    data : DataFrame
        A row a measured value: `body`, `quantity`, `time_s`, `position_m` of a
        profile's point, `unit`, `measured`, `sigma`, `computed`, and
        `residual`, computed less measured, in units of `sigma`: the standard
        deviation of both, of the measured value and with which the grid gives
        the computed one.
    predictions : DataFrame
        What else the fitted case gives at its end: `body`, `quantity`,
        `unit`, `value`, `lower`, `upper`. The interval is open, 0 to infinity,
        where it depends on a parameter that a bound holds.
    chi_square : float
        Sum of the squared residuals.
    degrees_of_freedom : int
        Data less the parameters that no bound holds.
    correlation : ndarray, shape (p, p)
        Between the logarithms of the parameters.
    singular_values : ndarray, shape (p,)
        Of the derivatives of the residuals by the logarithms of the
        parameters, largest first: each is the number of standard deviations
        by which a change by a factor e would show in the data.
    notes : tuple of str
        What to bear in mind.
    """

    level: float
    runs: int
    parameters: pd.DataFrame
    data: pd.DataFrame
    predictions: pd.DataFrame
    chi_square: float
    degrees_of_freedom: int
    correlation: Array
    singular_values: Array
    notes: tuple[str, ...]

    @property
    def settings(self) -> dict[str, float]:
        """The estimates by path, as `tribo.config.overrides.apply_settings` takes them."""
        return {each.path: each.value for each in self.parameters.itertuples()}

    @property
    def p_value(self) -> float | None:
        """Probability of a misfit at least as large by chance; None without data to spare."""
        if self.degrees_of_freedom == 0:
            return None
        return float(chdtrc(self.degrees_of_freedom, self.chi_square))

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data in SI units; what is not given is NaN."""
        return {
            "level": self.level,
            "runs": self.runs,
            "parameters": self.parameters.to_dict("records"),
            "data": self.data.to_dict("records"),
            "predictions": self.predictions.to_dict("records"),
            "chi_square": self.chi_square,
            "degrees_of_freedom": self.degrees_of_freedom,
            "p_value": self.p_value,
            "correlation": self.correlation.tolist(),
            "singular_values": self.singular_values.tolist(),
            "notes": list(self.notes),
        }


def outcome(
    fitted: Surrogate,
    parameters: Sequence[Parameter],
    measured: Sequence[Measured],
    predicted: Mapping[int, Reading],
    *,
    grid: Grid,
    read_off: Array,
    level: float,
    runs: int,
    notices: Sequence[str],
) -> Calibration:
    """Return what a fit says of its parameters, data and predictions, in that order.

    `predicted` are the responses that are predictions, by their index; `read_off`
    are the standard deviations with which the grid gives the responses.
    """
    jacobian = fitted.jacobian(fitted.point)
    root = root_covariance(jacobian)
    deviations = np.sqrt(np.sum(root**2, axis=1))
    estimates = _estimates(fitted, parameters, measured, level)
    held = estimates["held"].to_numpy()
    data = _data(fitted, measured)
    chi_square = float(np.sum(data["residual"] ** 2))
    spare = len(data) - int(np.sum(~held))
    rows = []
    for i, asked in predicted.items():
        value, ends = float(fitted.responses[i]), (0.0, math.inf)
        if not np.any(np.abs(fitted.slopes[i][held]) > NOTABLE):
            low, high = _ends(fitted, fitted.slopes[i], value, level)
            by = math.sqrt(chdtri(1, 1 - level)) * float(read_off[i])
            ends = (
                max(value - math.hypot(value - low, by), 0.0),
                value + math.hypot(high - value, by),
            )
        rows.append((asked.body, asked.quantity, QUANTITIES[asked.quantity].unit, value, *ends))
    return Calibration(
        level=level,
        runs=runs,
        parameters=estimates,
        data=data,
        predictions=pd.DataFrame(
            rows, columns=["body", "quantity", "unit", "value", "lower", "upper"]
        ),
        chi_square=chi_square,
        degrees_of_freedom=spare,
        correlation=root @ root.T / np.outer(deviations, deviations),
        singular_values=np.asarray(np.linalg.svd(jacobian, compute_uv=False), dtype=np.float64),
        notes=(*notes(estimates, data, measured, jacobian, grid, spare), *notices),
    )


def _ends(fitted: Surrogate, direction: Array, value: float, level: float) -> tuple[float, float]:
    low, high = interval(fitted, direction, level)
    return value * math.exp(low), value * math.exp(high)


def _estimates(
    fitted: Surrogate, parameters: Sequence[Parameter], measured: Sequence[Measured], level: float
) -> pd.DataFrame:
    values = np.exp(fitted.point)
    lower, upper = np.array([(p.lower, p.upper) for p in parameters]).T
    held = (values - lower <= AT_BOUND * values) | (upper - values <= AT_BOUND * values)
    for i in np.flatnonzero(~held):
        low, high = _ends(fitted, np.eye(len(values))[i], float(values[i]), level)
        lower[i], upper[i] = max(low, lower[i]), min(high, upper[i])
    effect = np.linalg.pinv(fitted.jacobian(fitted.point))
    of_steps = np.array([entry.from_resolution for entry in measured for _ in entry.values])
    deviation, most = of_steps.T / fitted.problem.sigma
    return pd.DataFrame(
        {
            "path": [p.path for p in parameters],
            "unit": [p.unit for p in parameters],
            "value": values,
            "lower": lower,
            "upper": upper,
            "resolution_share": np.sum((effect * deviation) ** 2, axis=1)
            / np.sum(effect**2, axis=1),
            "resolution_limit": np.sum(np.abs(effect) * most, axis=1),
            "held": held,
        }
    )


def _data(fitted: Surrogate, measured: Sequence[Measured]) -> pd.DataFrame:
    readings = [reading for entry in measured for reading in entry.readings]
    table = pd.DataFrame(readings).rename(columns={"time": "time_s", "position": "position_m"})
    return table.assign(
        unit=[QUANTITIES[each.quantity].unit for each in readings],
        measured=fitted.problem.observed,
        sigma=fitted.problem.sigma,
        computed=fitted.responses[: len(readings)],
        residual=fitted.problem.residuals(fitted.responses),
    )
