"""Findings on data and on a fit, in words and numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from scipy.ndimage import binary_dilation
from scipy.special import chdtrc
from tribo import Array, Finding
from tribo.kernel_api import signed

from tribo_inverse.calibration.linearised import COLLINEAR, normalised
from tribo_inverse.calibration.quantities import (
    DEPTH_SIGMA,
    FIELDS,
    WORN,
    in_si,
    in_words,
    p_words,
    percent,
)

if TYPE_CHECKING:
    from tribo_inverse.calibration.maps import FittedMaps

UNLIKELY = 0.01
"""p-value below which data and model disagree."""
TOO_SMALL = 0.001
"""1 − p above which the data agree with the model better than they may."""
PARTICIPATES = 0.3
"""Component of a singular vector above which a parameter is named."""
CORRELATED = 3.0
"""Standard deviations above which the correlation of neighbouring residuals is significant."""
SIGNIFICANT = 4.0
"""Standard deviations above which a level or a volume is not noise."""
DIRECTIONS = ("along", "across")
"""The sliding direction, by axis."""


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
        `Calibration.data` with `stated`, the standard deviation without the grid's, and `alone`,
        the weighted residuals, which are independent where tests scatter.
    jacobian : ndarray, shape (n, p)
        Derivatives of the weighted residuals by the logarithms of the parameters.
    freedom : int, optional
        Degrees of freedom of χ²; None where the repeatability is estimated.
    """
    return [
        *_bounds(estimates, freedom is None),
        *_resolutions(estimates, data, jacobian),
        *_collinear(list(estimates["path"]), jacobian),
        *(() if freedom is None else _misfit(data, freedom)),
        *_patterns(data),
        *_coarse_grid(data),
    ]


def _bounds(estimates: pd.DataFrame, scatters: bool) -> Iterator[Finding]:
    """Report estimates on a bound, or not bounded by the data."""
    for each in estimates.itertuples():
        value, upper = in_si(each.value, each.unit), in_si(each.upper, each.unit)
        sides = ["below"] * (each.lower == 0) + ["above"] * math.isinf(each.upper)
        if each.held:
            yield Finding(
                "held",
                f"{each.path}: the estimate lies on its {bound(each)} bound, {value}, and has no "
                "interval",
                value=each.value,
                place=each.path,
            )
        elif each.limited:
            yield Finding(
                "undetected",
                f"{each.path}: its wear was below the limit of detection, so that only the bound "
                f"{upper} is known; the fitted case has a negligible value",
                limit=each.upper,
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


def _resolutions(estimates: pd.DataFrame, data: pd.DataFrame, jacobian: Array) -> Iterator[Finding]:
    """Report the instrument whose resolution is more than half of the variance of an estimate."""
    parts = (data["step_sigma"] / data["sigma"]).to_numpy()
    for each, effect in zip(estimates.itertuples(), np.linalg.pinv(jacobian), strict=True):
        known = not (each.held or each.limited or math.isinf(each.upper))
        if known and each.resolution_share > 0.5:
            entry = data.iloc[int(np.argmax(np.abs(effect) * parts))]
            instrument = "balance" if entry.quantity == "mass" else "instrument"
            yield Finding(
                "reading",
                f"{each.path}: the {instrument}'s resolution dominates the uncertainty; "
                f"the {named(entry)} read to {in_words(entry.quantity, entry.step)} "
                f"leaves ±{percent(each.resolution_limit)} % open",
                value=each.resolution_limit,
                place=each.path,
            )


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
    """Report a χ² that is too large, or too small, to be due to chance."""
    if freedom == 0:
        words = "there are no more data than parameters: nothing is left to test the model with"
        yield Finding("untested", words)
        return
    read = data[~data["below"]]
    chi_square = float(np.sum(read["alone"] ** 2))
    stated = float(np.sum((read["residual"] * read["sigma"] / read["stated"]) ** 2))
    by_steps = float(np.mean((read["step_sigma"] / read["stated"]) ** 2))
    # Readings in coarse steps are alike.
    if by_steps < 0.5 and chdtrc(freedom, stated) > 1 - TOO_SMALL:
        yield Finding(
            "overstated",
            f"data and model differ by less than the stated uncertainties: χ² with those alone is "
            f"{stated:.2g} where about {freedom} is expected; the uncertainties are too large, or "
            "the data not independent",
            value=stated,
            limit=freedom,
        )
    if chdtrc(freedom, chi_square) < UNLIKELY:
        worst = read.loc[read["alone"].abs().idxmax()]
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


def _patterns(data: pd.DataFrame) -> Iterator[Finding]:
    """Report profiles and maps whose scaled neighbouring residuals are correlated."""
    along = data[data["quantity"].isin(FIELDS)].sort_values("position_m", kind="stable")
    for place, rows in along.groupby("place", sort=False):
        residuals = rows["alone"].to_numpy()
        scale = (rows["computed"] / rows["sigma"]).to_numpy()
        size = float(np.sum(scale**2)) or 1.0
        residuals = residuals - np.sum(residuals * scale) / size * scale
        squares = float(np.sum(residuals**2)) or 1.0
        correlation = float(np.sum(residuals[1:] * residuals[:-1]) / squares)
        limit = CORRELATED / len(rows) ** 0.5
        if correlation > limit and np.max(np.abs(residuals)) > 1:
            yield Finding(
                "pattern",
                f"the residuals of the {named(next(rows.itertuples()))} follow a pattern: "
                f"neighbours have a correlation of {correlation:.2f}, so the scar has another "
                "shape than the model's",
                value=correlation,
                limit=limit,
                place=str(place),
            )


def _coarse_grid(data: pd.DataFrame) -> Iterator[Finding]:
    """Report diameters that are measured more exactly than the grid computes them."""
    for entry in data[data["stated"] < data["edge"]].drop_duplicates("place").itertuples():
        yield Finding(
            "grid",
            f"the {named(entry)} is measured to {in_words(entry.quantity, entry.stated)}, the grid "
            f"is good to about {in_words(entry.quantity, entry.edge)}: raise grid.cells",
            value=entry.stated,
            limit=entry.edge,
            place=entry.place,
        )


def named(entry: Any) -> str:
    """Return the name of a measurement, as ``"mass of 'ball' in heavy"``."""
    where = f" in {entry.test}" if entry.test else ""
    when = "" if math.isnan(entry.time_s) else f" at {entry.time_s:g} s"
    return f"{entry.quantity}{f' of {entry.body!r}' if entry.body else ''}{where}{when}"


def off_middle(
    name: str, place: str, axis: int, shift: float, sigma: float = math.inf, but: str = ""
) -> Finding:
    """Report the distance of the scar from the middle of a map."""
    known = f"± {1e6 * sigma:.1g} " if math.isfinite(sigma) else ""
    return Finding(
        "shift",
        f"the scar in the {name} lies {signed(1e6 * shift, 1)} {known}µm {DIRECTIONS[axis]} the "
        f"sliding direction from the middle of the map{but}",
        value=shift,
        uncertainty=sigma if known else None,
        place=place,
    )


def off_level(
    name: str, place: str, measured: Array, depth: Array, sigma: float
) -> Iterator[Finding]:
    """Report a map whose median outside the scar, two cells and more away, is not 0.

    The limit is four standard errors of a median, plus 0.2 % of the scar's depth.
    """
    largest = float(np.max(depth))
    unworn = ~binary_dilation(depth > WORN * largest, iterations=2) & np.isfinite(measured)
    if not np.any(unworn):
        return
    level = float(np.median(measured[unworn]))
    error = (0.5 * math.pi / np.sum(unworn)) ** 0.5 * sigma
    limit = max(SIGNIFICANT * error, DEPTH_SIGMA * largest)
    if abs(level) > limit:
        yield Finding(
            "level",
            f"outside the scar the {name} lies {1e6 * abs(level):.2g} µm "
            f"{'above' if level > 0 else 'below'} 0: level it first, as tribo scar does",
            value=level,
            limit=float(limit),
            place=place,
        )


def of_maps(found: FittedMaps) -> Iterator[Finding]:
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
    least = freedom - found.by_grid
    if least > 1 and chdtrc(least, chi_square) > 1 - TOO_SMALL:
        yield Finding(
            "overstated",
            f"the depths differ from the fit by less than their uncertainty: χ² is "
            f"{chi_square:.3g} where at least {least:.3g} is expected; give the uncertainty of a "
            "cell, or of a line along a track, not of a pixel",
            value=chi_square,
            limit=least,
        )
    for name, each in found.maps.items():
        if (silent := int(np.sum(~each.told))) > 0:
            yield Finding(
                "unknown",
                f"{name}: the data do not determine {silent} cells, mostly where nothing was "
                "worn or measured: there the coefficient is the case's, as uncertain as before",
                value=silent,
                place=name,
            )


def chosen(case: str, by: float, limit: float, p_value: float | None) -> Finding:
    """Report the case that the data support."""
    words = f"the data speak for {case}: Schwarz's criterion is lower by {by:.3g} or more"
    if p_value is not None and p_value < UNLIKELY:
        words += f"; yet {case} does not describe them either ({p_words(p_value)})"
    return Finding("chosen", words, value=by, limit=limit, place=case)


def undecided(best: str, rivals: Mapping[str, float], limit: float, following: Any) -> Finding:
    """Report cases that the data do not separate, and the quantity to measure next, if any."""
    more = ""
    if following is not None:
        name, test = following.quantity, following.test
        values = " and ".join(in_words(name, each) for each in following[["value_x", "value_y"]])
        where = f" in {test}" if test else ""
        more = (
            f"; of what was not measured they differ most in the {name} of {following.body!r}"
            f"{where}: {values}, {percent(abs(following.ratio - 1))} % apart"
        )
    return Finding(
        "undecided",
        f"these data do not separate {' and '.join([best, *rivals])}: Schwarz's criterion "
        f"differs by {', '.join(f'{by:.2g}' for by in rivals.values())}, where {limit:g} is strong "
        f"evidence{more}",
        value=min(rivals.values()),
        limit=limit,
        place=", ".join([best, *rivals]),
    )
