"""Fit a case to what was measured: estimates with intervals, and what they predict."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from tribo.case import Case
from tribo.config.load import case_tables, validate_case
from tribo.config.overrides import apply_settings
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, NumericalError, TriboWarning
from tribo.registry.registry import Registry
from tribo.simulation.model import Model
from tribo.simulation.positions import chosen
from tribo.simulation.run import Simulation
from tribo.study.calibration.fit import Problem, fit
from tribo.study.calibration.measured import Measured, Measurements, read_measurements
from tribo.study.calibration.outcome import Calibration, outcome
from tribo.study.calibration.parameters import Parameter, find_parameters
from tribo.study.calibration.quantities import (
    AXES,
    PROFILES,
    QUANTITIES,
    Reading,
    in_si,
    read,
    unavailable,
)
from tribo.study.variation import unknown_body

NOTABLE, TOO_FAR = 5.0, 300.0
"""Factors between measured and computed: mentioned if a run fails, refused.

A prefix is a factor of 1000; a start may be off by a few on top of it.
"""


def calibrate(
    case: Case | Mapping[str, Any] | str | Path,
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
    case : Case, Mapping, str or Path
        A case, its tables, or its TOML file.
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
    tables = case_tables(case)
    asked = read_measurements(measured)
    base = validate_case(tables, registry=registry)
    model = Simulation(base, registry).model
    for i, entry in enumerate(asked.measured):
        _check_entry(model, entry, f"measured[{i}]")
    parameters = find_parameters(base, asked.fit, asked.measured)
    data = asked.table()
    if len(data) < len(parameters):
        raise CaseError(
            f"{len(parameters)} parameters cannot be fitted to {len(data)} measured "
            f"value{'' if len(data) == 1 else 's'}: measure more, or leave parameters out of fit"
        )
    predicted = _not_measured(model, asked.measured)
    columns = ["body", "quantity", "time_s", "position_m"]
    wanted = [*(Reading(*row) for row in data[columns].itertuples(index=False)), *predicted]
    times = sorted({entry.time for entry in asked.measured if entry.time is not None})
    kept = {"output.save_times": times, "observers": [], **chosen(base, model)}
    tables = apply_settings(tables, kept)
    runs: dict[bytes, Run] = {}

    def run(values: Array) -> Run:
        key = values.tobytes()
        if key not in runs:
            found = make_run(tables, parameters, values, wanted, registry, f"run {len(runs) + 1}")
            _check_positive(data, found.responses)
            runs[key] = found
        return runs[key]

    # Rounded as in the fit, which works with logarithms.
    start = np.exp(np.log([p.start for p in parameters]))
    first = run(start)
    far = far_off(data, first.responses, parameters)
    problem = Problem(
        names=tuple(p.path for p in parameters),
        observed=data["measured"].to_numpy(),
        sigma=np.hypot(data["sigma"], first.read_off[: len(data)]).to_numpy(),
        logged=np.array([each.quantity not in PROFILES for each in wanted]),
        lower=np.array([math.log(p.lower) if p.lower > 0 else -math.inf for p in parameters]),
        upper=np.array([math.log(p.upper) for p in parameters]),
    )

    def responses(values: Array) -> Array:
        found = run(values).responses
        if on_run is not None:
            on_run(len(runs), float(np.sum(problem.residuals(found) ** 2)))
        # A prediction of 0 is left out.
        return np.where(problem.logged & (found <= 0), 1.0, found)

    try:
        fitted = fit(responses, problem, start)
    except (CaseError, NumericalError) as error:
        if not far:
            raise
        raise type(error)(f"{error}; or is a measured value off? {'; '.join(far)}") from error
    last = runs[np.exp(fitted.point).tobytes()]
    positive = np.all([made.responses > 0 for made in runs.values()], axis=0)
    return outcome(
        fitted,
        parameters,
        data,
        {i: each for i, each in enumerate(predicted, len(data)) if positive[i]},
        grid=model.grid,
        read_off=last.read_off,
        level=level,
        runs=len(runs),
        notices=last.notices,
    )


class Run(NamedTuple):
    """Responses of a run, their standard deviations due to the grid, and its notices."""

    responses: Array
    read_off: Array
    notices: tuple[str, ...]


def make_run(
    tables: Mapping[str, Any],
    parameters: Sequence[Parameter],
    values: Array,
    wanted: Sequence[Reading],
    registry: Registry | None = None,
    name: str = "run",
) -> Run:
    """Run a case with other values of its parameters, and read numbers off the result."""
    # Taking logarithms may round to just beyond a bound.
    settings = {
        p.path: min(max(float(value), p.lower), p.upper)
        for p, value in zip(parameters, values, strict=True)
    }
    with warnings.catch_warnings():
        # The calibration has the notices of the last run.
        warnings.simplefilter("ignore", TriboWarning)
        try:
            case = validate_case(apply_settings(tables, settings), registry=registry)
            result = Simulation(case, registry).run()
        except (CaseError, NumericalError) as error:
            named = ", ".join(f"{path} = {value:.4g}" for path, value in settings.items())
            raise type(error)(f"{name}, with {named}: {error}") from error
    with result:
        given, blurred = np.array([read(result, each) for each in wanted]).T
        return Run(given, blurred, result.notices)


def far_off(data: pd.DataFrame, computed: Array, parameters: Sequence[Parameter]) -> list[str]:
    """Return a sentence for each entry that is several times larger or smaller than computed.

    `computed` begins with the data as the first run gives them. CaseError if
    the factor is above 300, one line per entry.
    """
    given = ", ".join(f"{p.path} = {in_si(p.start, p.unit)}" for p in parameters)
    sizes = data[["unit", "sigma"]].assign(
        value=data["measured"].abs(), own=np.abs(computed[: len(data)])
    )
    found, refused = [], []
    for place, unit, sigma, value, own in (
        sizes.groupby(data["place"], sort=False).max().itertuples()
    ):
        # A value below its uncertainty only says that the quantity is no larger than that.
        factor = max(value / own, own / max(value, sigma)) if own > 0 < value else 1.0
        text = (
            f"{place} was read as {in_si(value, unit)}, and the case gives {in_si(own, unit)} "
            f"with {given}"
        )
        if factor > TOO_FAR:
            refused.append(
                f"{text}: check the value and its unit, or give a start in fit that is nearer to it"
            )
        elif factor > NOTABLE:
            found.append(text)
    if refused:
        raise CaseError("\n".join(refused))
    return found


def _check_positive(data: pd.DataFrame, computed: Array) -> None:
    nothing = data[data["position_m"].isna() & (computed[: len(data)] <= 0)]
    for each in nothing.itertuples():
        raise CaseError(
            f"the {each.quantity} of {each.body!r} comes out as 0 in the case; begin with more "
            "wear: give start in fit",
            each.place,
        )


def _check_entry(model: Model, entry: Measured, place: str) -> None:
    if entry.body not in model.bodies:
        raise unknown_body(entry.body, model.bodies, f"{place}.body")
    reason = unavailable(model, entry.body, entry.quantity)
    if reason:
        raise CaseError(reason, f"{place}.quantity")
    if entry.time is not None and entry.time > model.end_time * (1 + 1e-12):
        raise CaseError(
            f"{entry.time:g} s is not reached: the run ends at {model.end_time:g} s",
            f"{place}.time",
        )
    for position in entry.position or ():
        half = 0.5 * model.grid.size[AXES[entry.quantity]]
        if abs(position) > half:
            raise CaseError(
                f"{1e3 * position:g} mm lies outside the window, which reaches "
                f"{1e3 * half:g} mm from the centre",
                f"{place}.position",
            )


def _not_measured(model: Model, measured: Sequence[Measured]) -> list[Reading]:
    """Return all quantities at the end of the run that were not measured."""
    known = {
        (entry.body, entry.quantity)
        for entry in measured
        if entry.time is None or entry.time >= model.end_time * (1 - 1e-12)
    }
    return [
        Reading(body, quantity)
        for body in model.bodies
        for quantity in QUANTITIES
        if quantity not in PROFILES
        and (body, quantity) not in known
        and not unavailable(model, body, quantity)
    ]
