"""Quantities of the fitted case that were not measured."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
from scipy.special import chdtri

from tribo_inverse.calibration.experiment import Experiment
from tribo_inverse.calibration.fit import ABOVE_ROUNDING, interval
from tribo_inverse.calibration.linearised import Linearised
from tribo_inverse.calibration.quantities import QUANTITIES


def predicted(
    fitted: Linearised, experiment: Experiment, estimates: pd.DataFrame, level: float
) -> pd.DataFrame:
    """Return `Calibration.predictions`."""
    held = estimates["held"].to_numpy()
    by_grid = math.sqrt(chdtri(1, 1 - level)) * experiment.run(np.exp(fitted.point)).grid_sigma
    positive = np.all([made.responses > 0 for made in experiment.runs.values()], axis=0)
    rows = []
    for i, each in enumerate(experiment.predicted.itertuples(), len(experiment.data)):
        if not positive[i]:
            continue
        value, ends = float(fitted.responses[i]), (0.0, math.inf)
        follows = np.abs(fitted.slopes[i]) > ABOVE_ROUNDING
        slopes = np.where(follows, fitted.slopes[i], 0.0)
        if not np.any(follows & held):
            known = value * np.expm1(interval(fitted, slopes, level))
            down, up = np.hypot(known, by_grid[i])
            ends = max(value - down, 0.0), value + up
        unit = QUANTITIES[each.quantity].unit
        rows.append((each.test, each.body, each.quantity, unit, value, *ends))
    columns = ["test", "body", "quantity", "unit", "value", "lower", "upper"]
    return pd.DataFrame(rows, columns=columns)
