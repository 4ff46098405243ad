"""Read off a fit what it says: estimates, intervals, residuals, predictions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from scipy.special import chdtri

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.study.calibration.fit import NOTABLE, Surrogate, covariance, interval
from tribo.study.calibration.measured import Measured
from tribo.study.calibration.notes import notes
from tribo.study.calibration.outcome import Calibration, Datum, Estimate, Expected
from tribo.study.calibration.parameters import Parameter
from tribo.study.calibration.quantities import unit_of

AT_BOUND = 1e-6
"""How near to a bound an estimate lies on it, relative."""


def outcome(
    fitted: Surrogate,
    parameters: Sequence[Parameter],
    measured: Sequence[Measured],
    predicted: Mapping[int, tuple[str, str]],
    *,
    grid: Grid,
    read_off: Array,
    level: float,
    runs: int,
    notices: Sequence[str],
) -> Calibration:
    """Return what a fit says.

    Parameters
    ----------
    fitted : Surrogate
        About the estimate.
    parameters : sequence of Parameter
        What was fitted.
    measured : sequence of Measured
        What it was fitted to.
    predicted : Mapping
        Body and quantity of the responses that are predictions, by their index.
    grid : Grid
        The window of the runs.
    read_off : ndarray, shape (m,)
        Standard deviations with which it gives the responses.
    level : float
        Probability of the intervals.
    runs : int
        Simulations made.
    notices : sequence of str
        Warnings of the run with the estimates.
    """
    jacobian = fitted.jacobian(fitted.point)
    spread = covariance(jacobian)
    deviations = np.sqrt(np.diag(spread))
    data = _data(fitted, measured)
    shares, limits = _resolution(jacobian, measured, fitted.problem.sigma)
    estimates = []
    for i, parameter in enumerate(parameters):
        value = float(np.exp(fitted.point[i]))
        held = any(
            abs(value - bound) <= AT_BOUND * value for bound in (parameter.lower, parameter.upper)
        )
        ends = parameter.lower, parameter.upper
        if not held:
            low, high = _ends(fitted, np.eye(len(parameters))[i], value, level)
            ends = max(low, parameter.lower), min(high, parameter.upper)
        estimates.append(
            Estimate(
                parameter.path,
                parameter.unit,
                value,
                *ends,
                float(shares[i]),
                float(limits[i]),
                held,
            )
        )
    held_ones = [each.held for each in estimates]
    spare = len(data) - held_ones.count(False)
    predictions = []
    for i, (body, quantity) in predicted.items():
        value = float(fitted.responses[i])
        ends = (0.0, math.inf)
        if not np.any(np.abs(fitted.slopes[i][held_ones]) > NOTABLE):
            ends = _widened(
                *_ends(fitted, fitted.slopes[i], value, level),
                value,
                math.sqrt(chdtri(1, 1 - level)) * float(read_off[i]),
            )
        predictions.append(Expected(body, quantity, unit_of(quantity), value, *ends))
    return Calibration(
        level=level,
        runs=runs,
        parameters=tuple(estimates),
        data=tuple(data),
        predictions=tuple(predictions),
        chi_square=float(sum(each.residual**2 for each in data)),
        degrees_of_freedom=spare,
        correlation=spread / np.outer(deviations, deviations),
        singular_values=np.asarray(np.linalg.svd(jacobian, compute_uv=False), dtype=np.float64),
        notes=(*notes(estimates, parameters, data, measured, jacobian, grid, spare), *notices),
    )


def _ends(fitted: Surrogate, direction: Array, value: float, level: float) -> tuple[float, float]:
    low, high = interval(fitted, direction, level)
    return value * math.exp(low), value * math.exp(high)


def _widened(low: float, high: float, value: float, by: float) -> tuple[float, float]:
    """Return an interval of a value that is uncertain by so much more."""
    return max(value - math.hypot(value - low, by), 0.0), value + math.hypot(high - value, by)


def _resolution(jacobian: Array, measured: Sequence[Measured], sigma: Array) -> tuple[Array, Array]:
    """Return of each parameter the variance's share, and the largest error, from resolution."""
    effect = np.linalg.pinv(jacobian)
    parts = [(*entry.from_resolution, len(entry.values)) for entry in measured]
    deviation = np.concatenate([np.full(n, own) for own, _, n in parts]) / sigma
    most = np.concatenate([np.full(n, worst) for _, worst, n in parts]) / sigma
    share = np.sum((effect * deviation) ** 2, axis=1) / np.sum(effect**2, axis=1)
    return share, np.sum(np.abs(effect) * most, axis=1)


def _data(fitted: Surrogate, measured: Sequence[Measured]) -> list[Datum]:
    computed, sigmas = iter(fitted.responses.tolist()), iter(fitted.problem.sigma.tolist())
    found = []
    for entry in measured:
        positions = entry.position or (None,)
        for value, position in zip(entry.values.tolist(), positions, strict=True):
            own, sigma = next(computed), next(sigmas)
            found.append(
                Datum(
                    entry.body,
                    entry.quantity,
                    entry.time,
                    position,
                    unit_of(entry.quantity),
                    value,
                    sigma,
                    own,
                    (own - value) / sigma,
                )
            )
    return found
