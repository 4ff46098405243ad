"""Fit a case to what was measured: estimates with intervals, and what they predict."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tribo.case import Case
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, NumericalError
from tribo.registry.registry import Registry
from tribo.study.calibration.fit import fit
from tribo.study.calibration.measured import Measurements
from tribo.study.calibration.outcome import Calibration, outcome
from tribo.study.calibration.parameters import Parameter
from tribo.study.calibration.posed import Posed
from tribo.study.calibration.quantities import in_si

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
    posed = Posed.of(case, measured, registry)
    for each in posed.data[posed.data["measured"].isna()].itertuples():
        more = ", or before and after" if each.quantity == "mass" else ""
        raise CaseError(f"give value{more}", each.place)
    if (count := len(posed.data)) < len(posed.parameters):
        raise CaseError(
            f"{len(posed.parameters)} parameters cannot be fitted to {count} measured "
            f"value{'' if count == 1 else 's'}: measure more, or leave parameters out of fit"
        )
    far = far_off(posed.data, posed.run(posed.start).responses, posed.parameters)
    problem = posed.problem()

    def responses(values: Array) -> Array:
        found = posed.fitted_to(values)
        if on_run is not None:
            misfit = problem.residuals(found, 1 / problem.sigma)
            on_run(posed.made, float(np.sum(misfit**2)))
        return found

    try:
        fitted = fit(responses, problem, posed.start)
    except (CaseError, NumericalError) as error:
        if not far:
            raise
        raise type(error)(f"{error}; or is a measured value off? {'; '.join(far)}") from error
    return outcome(fitted, posed, level)


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
