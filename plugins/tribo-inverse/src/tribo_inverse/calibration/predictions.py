"""Quantities of the fitted case that were not measured."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
from scipy.special import chdtri
from tribo import Array, CaseError, NumericalError

from tribo_inverse.calibration.experiment import Experiment
from tribo_inverse.calibration.fit import ABOVE_ROUNDING, interval
from tribo_inverse.calibration.linearised import Linearised
from tribo_inverse.calibration.quantities import QUANTITIES


def predicted(
    fitted: Linearised, experiment: Experiment, estimates: pd.DataFrame, level: float
) -> pd.DataFrame:
    """Return `Calibration.predictions`.

    A parameter that is `limited` is estimated near 0, where slopes do not extend to its upper
    bound: the case is run there.
    """
    values, held = (estimates[name].to_numpy() for name in ("value", "held"))
    limited = estimates["limited"].to_numpy()
    at_bounds = [
        _at_bound(fitted, experiment, values, one, estimates["upper"].iloc[one])
        for one in np.flatnonzero(limited).tolist()
    ]
    by_grid = math.sqrt(chdtri(1, 1 - level)) * experiment.run(np.exp(fitted.point)).grid_sigma
    positive = np.all(
        [experiment.of_data(made).responses > 0 for made in experiment.runs.values()], axis=0
    )
    rows = []
    for i, each in enumerate(experiment.predicted.itertuples(), len(experiment.data)):
        if not positive[i]:
            continue
        value, ends = float(fitted.responses[i]), (0.0, math.inf)
        follows = np.abs(fitted.slopes[i]) > ABOVE_ROUNDING
        slopes = np.where(limited | ~follows, 0.0, fitted.slopes[i])
        if not np.any(follows & held):
            known = value * np.expm1(interval(fitted, slopes, level))
            to_bounds = [float(found[i]) - value for found in at_bounds]
            ends = _ends(value, (*known, -by_grid[i], by_grid[i], *to_bounds))
            # A response that the bound more than doubles vanishes with the parameter.
            if max(to_bounds, default=0.0) > value:
                ends = 0.0, ends[1]
        unit = QUANTITIES[each.quantity].unit
        rows.append((each.test, each.body, each.quantity, unit, value, *ends))
    columns = ["test", "body", "quantity", "unit", "value", "lower", "upper"]
    return pd.DataFrame(rows, columns=columns)


def _ends(value: float, moves: Sequence[float]) -> tuple[float, float]:
    """Return the ends of an interval with independent errors, combined in quadrature on each side.

    The lower end is 0 at the least.
    """
    down, up = (math.hypot(*(max(sign * move, 0.0) for move in moves)) for sign in (-1, 1))
    return max(value - down, 0.0), value + up


def _at_bound(
    fitted: Linearised, experiment: Experiment, values: Array, one: int, bound: float
) -> Array:
    """Return the responses with a parameter at its upper bound; infinite if they are not known."""
    if np.isfinite(bound):
        place = values.copy()
        place[one] = bound
        try:
            return experiment.run(place).responses
        except (CaseError, NumericalError):
            # A failed prediction must not lose the fit.
            pass
    return np.where(np.abs(fitted.slopes[:, one]) > ABOVE_ROUNDING, np.inf, fitted.responses)
