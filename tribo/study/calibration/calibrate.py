"""Fit a case to what was measured: estimates with intervals, and what they predict."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tribo.case import Case
from tribo.config.load import case_tables, validate_case
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, NumericalError
from tribo.registry.registry import Registry
from tribo.study.calibration.bench import Run, benches, make_run
from tribo.study.calibration.fit import fit
from tribo.study.calibration.linearised import Problem
from tribo.study.calibration.measured import Measurements, read_measurements
from tribo.study.calibration.outcome import Calibration, outcome
from tribo.study.calibration.parameters import Parameter, check_set, find_parameters
from tribo.study.calibration.quantities import PROFILES, in_si

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
    """Fit parameters of a case to wear that was measured in one test or several.

    Weighted least squares by Gauss-Newton steps in logarithms, which are exact
    for volumes under Archard's law, so that few runs are needed. Tests alike
    share their runs. All runs are in memory, without the case's observers.

    Parameters
    ----------
    case : Case, Mapping, str or Path
        A case, its tables, or its TOML file.
    measured : Measurements, Mapping, str or Path
        What was measured, in the case or in tests that differ from it, and what
        is to be fitted; or its TOML file.
    level : float, optional
        Probability with which each interval is to cover the truth.
    registry : Registry, optional
        Where to look components up; the installed plugins if left out.
    on_run : callable, optional
        Called after each round of runs with the number of runs and their misfit χ².

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
    tables, asked = case_tables(case), read_measurements(measured)
    base = validate_case(tables, registry=registry)
    data = asked.table()
    tested = benches(tables, asked.tests, data, registry)
    parameters = find_parameters(base, asked.fit, data["body"].unique())
    for place, test in asked.tests.items():
        check_set(parameters, test.set, f"{place}set")
    if len(data) < len(parameters):
        raise CaseError(
            f"{len(parameters)} parameters cannot be fitted to {len(data)} measured "
            f"value{'' if len(data) == 1 else 's'}: measure more, or leave parameters out of fit"
        )
    data["edge"] = 0.0
    for bench in tested:
        data.loc[bench.rows, "edge"] = [
            bench.edge(name) for name in data.loc[bench.rows, "quantity"]
        ]
    first_predicted = len(data)
    predicted = [(bench.name, each) for bench in tested for each in bench.predicted]
    places = iter(range(first_predicted, first_predicted + len(predicted)))
    rows = [[*bench.rows, *(next(places) for _ in bench.predicted)] for bench in tested]
    runs: dict[bytes, Run] = {}

    def run(values: Array) -> Run:
        key = values.tobytes()
        if key not in runs:
            responses, read_off = np.empty((2, len(data) + len(predicted)))
            notices: dict[str, None] = {}
            for i, bench in enumerate(tested):
                name = f"run {len(tested) * len(runs) + i + 1}"
                made = make_run(bench.tables, parameters, values, bench.wanted, registry, name)
                responses[rows[i]], read_off[rows[i]] = made.responses, made.read_off
                notices |= dict.fromkeys(made.notices)
            _check_positive(data, responses)
            runs[key] = Run(responses, read_off, tuple(notices))
        return runs[key]

    # Rounded as in the fit, which works with logarithms.
    start = np.exp(np.log([p.start for p in parameters]))
    first = run(start)
    far = far_off(data, first.responses, parameters)
    repeated = data[~data["below"]].groupby(
        ["bench", "body", "quantity", "time_s", "position_m"], dropna=False
    )["specimen"]
    repeatability = 0.0 if repeated.nunique().max() == 1 else None
    quantities = [*data["quantity"], *(each.quantity for _, each in predicted)]
    problem = Problem(
        names=tuple(p.path for p in parameters),
        observed=data["measured"].to_numpy(),
        sigma=np.hypot(data["sigma"], first.read_off[: len(data)]).to_numpy(),
        below=data["below"].to_numpy(),
        specimen=data["specimen"].to_numpy(),
        repeatability=repeatability if asked.repeatability is None else asked.repeatability,
        logged=np.array([name not in PROFILES for name in quantities]),
        lower=np.array([math.log(p.lower) if p.lower > 0 else -math.inf for p in parameters]),
        upper=np.array([math.log(p.upper) for p in parameters]),
    )

    def responses(values: Array) -> Array:
        found = run(values).responses
        if on_run is not None:
            misfit = problem.residuals(found, 1 / problem.sigma)
            on_run(len(tested) * len(runs), float(np.sum(misfit**2)))
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
        cases={bench.name: bench.case for bench in tested},
        read_off=last.read_off,
        level=level,
        runs=len(tested) * len(runs),
        notices=last.notices,
    )


def far_off(data: pd.DataFrame, computed: Array, parameters: Sequence[Parameter]) -> list[str]:
    """Return a sentence for each entry that is several times larger or smaller than computed.

    `computed` begins with the data as the first run gives them. CaseError if
    the factor is above 300, one line per entry.
    """
    given = ", ".join(f"{p.path} = {in_si(p.start, p.unit)}" for p in parameters)
    sizes = data[["unit", "sigma", "below"]].assign(
        value=data["measured"].abs(), own=np.abs(computed[: len(data)])
    )
    found, refused = [], []
    for place, unit, sigma, below, value, own in (
        sizes.groupby(data["place"], sort=False).max().itertuples()
    ):
        # A value below its uncertainty only says that the quantity is no larger than that, as a
        # limit does.
        factor = max(0 if below else value / own, own / max(value, sigma)) if own > 0 < value else 1
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
