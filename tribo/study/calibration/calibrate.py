"""Fit a case to what was measured: estimates with intervals, and what they predict."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tribo.config.load import read_toml, validate_case
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, NumericalError, located
from tribo.core.words import did_you_mean, suggestion
from tribo.registry.registry import Registry
from tribo.simulation.model import Model
from tribo.simulation.run import Simulation
from tribo.study.calibration.far_off import check_far_off, far_off
from tribo.study.calibration.fit import Problem, fit
from tribo.study.calibration.judge import outcome
from tribo.study.calibration.measured import Measured, Measurements, read_measurements
from tribo.study.calibration.outcome import Calibration
from tribo.study.calibration.parameters import find_parameters
from tribo.study.calibration.quantities import PROFILES, QUANTITIES, check_available, is_available
from tribo.study.calibration.runs import Predicted, Runs


def calibrate(
    case: Mapping[str, Any] | str | Path,
    measured: Measurements | Mapping[str, Any] | str | Path,
    *,
    level: float = 0.95,
    registry: Registry | None = None,
    on_run: Callable[[int, float], None] | None = None,
) -> Calibration:
    """Fit parameters of a case to measured wear.

    Weighted least squares, by Gauss-Newton on a surrogate of power laws: it is
    exact for volumes under Archard's law, so that few runs are needed. All
    runs are in memory, without the case's observers.

    Parameters
    ----------
    case : Mapping, str or Path
        The tables of a case, or its TOML file.
    measured : Measurements, Mapping, str or Path
        What was measured and what is to be fitted, or its TOML file.
    level : float, optional
        Probability with which each interval is to cover the truth.
    registry : Registry, optional
        Where to look components up; the installed plugins if left out.
    on_run : callable, optional
        Called after each run with its number and its misfit χ².

    Returns
    -------
    Calibration
        Estimates, intervals, residuals, what the data can tell, predictions.

    Raises
    ------
    CaseError
        If the case or the measured values are wrong, do not fit together, or
        are too few.
    NumericalError
        If a run fails or the estimates do not settle.
    """
    if not 0 < level < 1:
        raise CaseError(f"the level, {level:g}, must lie between 0 and 1, as 0.95 does")
    tables = read_toml(case) if isinstance(case, str | Path) else case
    asked = read_measurements(measured)
    base = validate_case(tables, registry=registry)
    model = Simulation(base, registry).model
    for i, entry in enumerate(asked.measured):
        _check_entry(model, entry, f"measured[{i}]")
    parameters = find_parameters(base, asked.fit, asked.measured)
    count = sum(len(entry.values) for entry in asked.measured)
    if count < len(parameters):
        raise CaseError(
            f"{len(parameters)} parameters cannot be fitted to {count} measured "
            f"value{'' if count == 1 else 's'}: measure more, or leave parameters out of fit"
        )
    predicted = _predicted(model, asked.measured)
    runs = Runs(tables, asked.measured, parameters, predicted, registry)
    start = np.array([p.start for p in parameters])
    first = runs(start)
    far = list(far_off(asked.measured, first[:count], parameters))
    check_far_off(far)
    sigma = np.concatenate([np.full(len(e.values), e.sigma) for e in asked.measured])
    problem = Problem(
        names=tuple(p.path for p in parameters),
        observed=np.concatenate([entry.values for entry in asked.measured]),
        sigma=np.hypot(sigma, runs.read_off[:count]),
        logged=runs.logged,
        lower=np.array([math.log(p.lower) if p.lower > 0 else -math.inf for p in parameters]),
        upper=np.array([math.log(p.upper) for p in parameters]),
    )
    of_run = {np.exp(np.log(start)).tobytes(): (runs.notices, runs.read_off)}

    def told(responses: Array) -> Array:
        if on_run is not None:
            on_run(runs.count, float(np.sum(problem.residuals(responses) ** 2)))
        return responses

    def run(values: Array) -> Array:
        responses = runs(values)
        of_run[values.tobytes()] = runs.notices, runs.read_off
        return told(responses)

    try:
        fitted = fit(run, problem, start, told(first))
    except (CaseError, NumericalError) as error:
        if not far:
            raise
        texts = "; ".join(each.text for each in far)
        raise type(error)(f"{error}; or is a measured value off? {texts}") from error
    notices, read_off = of_run[np.exp(fitted.point).tobytes()]
    return outcome(
        fitted,
        parameters,
        asked.measured,
        {count + i: which for i, which in enumerate(predicted) if runs.positive[i]},
        grid=model.grid,
        read_off=read_off,
        level=level,
        runs=runs.count,
        notices=notices,
    )


def _check_entry(model: Model, entry: Measured, place: str) -> None:
    names = list(model.bodies)
    if entry.body not in names:
        raise CaseError(
            f"there is no body {entry.body!r}{suggestion(did_you_mean(entry.body, names))} "
            f"The bodies are {', '.join(names)}",
            f"{place}.body",
        )
    with located(f"{place}.quantity"):
        check_available(model, entry.body, entry.quantity)
    if entry.time is not None and entry.time > model.end_time * (1 + 1e-12):
        raise CaseError(
            f"{entry.time:g} s is not reached: the run ends at {model.end_time:g} s",
            f"{place}.time",
        )
    if entry.position is not None:
        half = 0.5 * model.grid.size[PROFILES[entry.quantity]]
        outside = next((p for p in entry.position if abs(p) > half), None)
        if outside is not None:
            raise CaseError(
                f"{1e3 * outside:g} mm lies outside the window, which reaches "
                f"{1e3 * half:g} mm from the centre",
                f"{place}.position",
            )


def _predicted(model: Model, measured: Sequence[Measured]) -> list[Predicted]:
    """Return all that the runs give at their end and was not measured then."""
    known = {
        (entry.body, entry.quantity)
        for entry in measured
        if entry.time is None or entry.time >= model.end_time * (1 - 1e-12)
    }
    return [
        (body, quantity)
        for body in model.bodies
        for quantity in QUANTITIES
        if (body, quantity) not in known and is_available(model, body, quantity)
    ]
