"""Findings on data and on a fit, in words and numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from scipy.special import chdtrc
from tribo import Array, Finding

from tribo_inverse.calibration.linearised import COLLINEAR, normalised
from tribo_inverse.calibration.quantities import in_si, in_words, p_words

if TYPE_CHECKING:
    from tribo_inverse.calibration.maps import FittedMap

UNLIKELY = 0.01
"""p-value below which data and model disagree."""
PARTICIPATES = 0.3
"""Component of a singular vector above which a parameter is named."""


def of_run(finding: Finding, runs: Sequence[str] = ()) -> Finding:
    """Word the finding of some runs of a fit, or of all."""
    return replace(finding, words=": ".join([*([", ".join(runs)] if runs else []), str(finding)]))


def of_fit(
    estimates: pd.DataFrame, data: pd.DataFrame, jacobian: Array, freedom: int | None
) -> list[Finding]:
    """Return the findings on a fit.

    Parameters
    ----------
    estimates : DataFrame
        `Calibration.parameters`.
    data : DataFrame
        `Calibration.data` with `alone`, the weighted residuals, which are independent where tests
        scatter.
    jacobian : ndarray, shape (n, p)
        Derivatives of the weighted residuals by the logarithms of the parameters.
    freedom : int, optional
        Degrees of freedom of χ²; None where the repeatability is estimated.
    """
    return [
        *_bounds(estimates, freedom is None),
        *_collinear(list(estimates["path"]), jacobian),
        *(() if freedom is None else _misfit(data, freedom)),
    ]


def _bounds(estimates: pd.DataFrame, scatters: bool) -> Iterator[Finding]:
    """Report estimates on a bound, or not bounded by the data."""
    for each in estimates.itertuples():
        value = in_si(each.value, each.unit)
        sides = ["below"] * (each.lower == 0) + ["above"] * math.isinf(each.upper)
        if each.held:
            yield Finding(
                "held",
                f"{each.path}: the estimate lies on its {bound(each)} bound, {value}, and has no "
                "interval",
                value=each.value,
                place=each.path,
            )
        elif sides:
            few = "; too few tests were repeated to estimate their scatter: state repeatability"
            yield Finding(
                "unbounded",
                f"{each.path}: the data do not bound it from {' or '.join(sides)}"
                f"{few if scatters and len(sides) == 2 else ''}",
                value=each.value,
                place=each.path,
            )


def bound(estimate: Any) -> str:
    """Return which bound holds an estimate."""
    return "lower" if estimate.value - estimate.lower < estimate.upper - estimate.value else "upper"


def unresolved(readings: pd.DataFrame) -> Iterator[Finding]:
    """Report computed values below the smallest step of their instrument."""
    for entry in readings[readings["computed"] < readings["step"]].itertuples():
        computed, step = (in_words(entry.quantity, each) for each in (entry.computed, entry.step))
        yield Finding(
            "reading",
            f"the computed {named(entry)}, {computed}, is below the resolution of {step}: lengthen "
            "the test, or take a finer instrument",
            value=entry.computed,
            limit=entry.step,
            place=entry.place,
        )


def _collinear(paths: list[str], jacobian: Array) -> Iterator[Finding]:
    """Report parameters with the same effect on the data."""
    _, angles, directions = normalised(jacobian)
    for angle, direction in zip(angles, directions, strict=True):
        if angle > COLLINEAR:
            continue
        names = [
            path for path, part in zip(paths, direction, strict=True) if abs(part) > PARTICIPATES
        ]
        yield Finding(
            "collinear",
            f"the data do not separate {' and '.join(names)}: measure something that only one of "
            "them changes, or leave one out of fit",
            value=float(angle),
            limit=COLLINEAR,
            place=", ".join(names),
        )


def _misfit(data: pd.DataFrame, freedom: int) -> Iterator[Finding]:
    """Report a χ² that is too large to be due to chance."""
    if freedom == 0:
        words = "there are no more data than parameters: nothing is left to test the model with"
        yield Finding("untested", words)
        return
    chi_square = float(np.sum(data["alone"] ** 2))
    if chdtrc(freedom, chi_square) < UNLIKELY:
        worst = data.loc[data["alone"].abs().idxmax()]
        yield Finding(
            "misfit",
            f"data and model disagree: χ² is {chi_square:.3g} where about {freedom} is expected; "
            f"the {named(worst)} is off by {abs(worst.alone):.3g} times its uncertainty. The model "
            "leaves something out, or uncertainties are larger than stated; the intervals are then "
            "too narrow",
            value=chi_square,
            limit=freedom,
            place=worst.place,
        )


def named(entry: Any) -> str:
    """Return the name of a measurement, as ``"mass of 'ball' in heavy"``."""
    where = f" in {entry.test}" if entry.test else ""
    when = "" if math.isnan(entry.time_s) else f" at {entry.time_s:g} s"
    return f"{entry.quantity}{f' of {entry.body!r}' if entry.body else ''}{where}{when}"


def of_map(found: FittedMap) -> Iterator[Finding]:
    """Return the findings on the fit of local coefficients."""
    chi_square, freedom = found.chi_square, found.degrees_of_freedom
    if found.is_refuted:
        yield Finding(
            "misfit",
            "no map that varies so smoothly explains the depths: χ² is "
            f"{chi_square:.4g} where about {freedom:.4g} is expected; the model leaves something "
            "out, or the uncertainty is larger, or the length shorter",
            value=chi_square,
            limit=freedom,
        )
    if (silent := int(np.sum(~found.told))) > 0:
        yield Finding(
            "unknown",
            f"{found.body}: the data do not determine {silent} cells, mostly where nothing was "
            "worn or measured: there the coefficient is the case's, as uncertain as before",
            value=silent,
            place=found.body,
        )


def chosen(case: str, by: float, limit: float, p_value: float | None) -> Finding:
    """Report the case that the data support."""
    words = f"the data speak for {case}: Schwarz's criterion is lower by {by:.3g} or more"
    if p_value is not None and p_value < UNLIKELY:
        words += f"; yet {case} does not describe them either ({p_words(p_value)})"
    return Finding("chosen", words, value=by, limit=limit, place=case)


def undecided(best: str, rivals: Mapping[str, float], limit: float) -> Finding:
    """Report cases that the data do not separate."""
    return Finding(
        "undecided",
        f"these data do not separate {' and '.join([best, *rivals])}: Schwarz's criterion "
        f"differs by {', '.join(f'{by:.2g}' for by in rivals.values())}, where {limit:g} is strong "
        "evidence; measure a quantity in which their predictions differ",
        value=min(rivals.values()),
        limit=limit,
        place=", ".join([best, *rivals]),
    )
