"""Notes on the parameters, the misfit and the instruments of a calibration."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import chdtrc, ndtr, stdtr
from tribo import Array

from tribo_inverse.calibration.linearised import COLLINEAR, normalised
from tribo_inverse.calibration.quantities import FIELDS, in_si, in_words, percent

UNLIKELY = 0.01
"""p-value below which data and model disagree."""
TOO_SMALL = 0.001
"""1 − p above which the data agree with the model better than they may."""
STEEP = 0.3
"""Square root of the fall of χ² beyond a bound from which on the bound matters."""
NEARLY_COLLINEAR = 0.2
"""Singular value of the Jacobian with normalised columns below which parameters are hardly told
apart; not at all below `COLLINEAR`."""
_PARTICIPATES = 0.3
"""Component of a singular vector from which on a parameter is named."""
_DOMINATES = 0.5
"""Part of a variance."""
_FEWEST_REPEATS = 3
"""Tests of which one may be called unlike the others."""
_OUTLYING = 0.05
"""Probability, for all repeats together, below which one is not of the others."""
_CORRELATED = 3.0
"""Standard deviations above which the correlation of neighbouring residuals is significant."""


def notes(
    estimates: pd.DataFrame,
    data: pd.DataFrame,
    jacobian: Array,
    freedom: int | None,
    cells: int,
    explained: str,
) -> list[str]:
    """Return notes; the Jacobian is of the weighted residuals by the logarithms of the parameters.

    The column `alone` of the data has the weighted residuals, independent where tests scatter.
    `freedom` are the degrees of freedom of χ², None where the repeatability is estimated; `cells`
    are those of the coarsest grid, `explained` the answer of `explanations`.
    """
    return [
        *_on_parameters(estimates, data, jacobian, freedom),
        *_on_collinearity(list(estimates["path"]), jacobian),
        *_on_misfit(data, freedom, cells, explained),
        *(on_repeats(data) if freedom is None else ()),
        *_on_patterns(data),
        *_on_instruments(data),
    ]


def _on_parameters(
    estimates: pd.DataFrame, data: pd.DataFrame, jacobian: Array, freedom: int | None
) -> Iterator[str]:
    """Name parameters on a bound or not bounded, and the instrument that dominates each."""
    parts = (data["step_sigma"] / data["sigma"]).to_numpy()
    effects = np.linalg.pinv(jacobian)
    for each, effect, column in zip(estimates.itertuples(), effects, jacobian.T, strict=True):
        is_open = {"below": each.lower == 0, "above": math.isinf(each.upper)}
        if each.held:
            steep = abs(float(np.sum(column * data["alone"]))) / float(np.sqrt(np.sum(column**2)))
            met = "without the bound the data would be met better"
            yield (
                f"{each.path}: the estimate lies on its {bound(each)} bound, "
                f"{in_si(each.value, each.unit)}, and has no interval; "
                f"{met if steep > STEEP else 'the data hardly tell it'}"
            )
        elif each.limited:
            yield (
                f"{each.path}: what it wears was below the limit of detection, so that it is below "
                f"{in_si(each.upper, each.unit)} and nothing more is known; the fitted case has as "
                "good as none"
            )
        elif any(is_open.values()):
            sides = " or ".join(side for side, so in is_open.items() if so)
            scatter = "; too few tests were repeated to estimate their scatter: state repeatability"
            yield (
                f"{each.path}: the data do not bound it from {sides}"
                f"{scatter if freedom is None and all(is_open.values()) else ''}"
            )
        if (
            not (each.held or each.limited or is_open["above"])
            and each.resolution_share > _DOMINATES
        ):
            entry = data.iloc[int(np.argmax(np.abs(effect) * parts))]
            yield (
                f"{each.path}: the {_instrument(entry)}'s resolution dominates the uncertainty; "
                f"the {named(entry)} read to {in_words(entry.quantity, entry.step)} "
                f"leaves ±{percent(each.resolution_limit)} % open"
            )


def bound(estimate: Any) -> str:
    """Return which bound holds an estimate."""
    return "lower" if estimate.value - estimate.lower < estimate.upper - estimate.value else "upper"


def _on_collinearity(paths: Sequence[str], jacobian: Array) -> Iterator[str]:
    """Name parameters whose effects on the data are nearly collinear."""
    _, angles, directions = normalised(jacobian)
    for angle, direction in zip(angles, directions, strict=True):
        if angle > NEARLY_COLLINEAR:
            continue
        taking = [i for i in range(len(paths)) if abs(direction[i]) > _PARTICIPATES]
        names = [paths[i] for i in taking]
        raised = [i for i in taking if direction[i] * direction[taking[0]] > 0]
        how = f"raising {_listed([paths[i] for i in raised])}"
        if lowered := [paths[i] for i in taking if i not in raised]:
            how += f" and lowering {_listed(lowered)}"
        cannot = angle <= COLLINEAR
        yield (
            f"the data {'cannot' if cannot else 'can hardly'} tell {_listed(names)} "
            f"apart: {how} changes {'none' if cannot else 'little'} of the computed "
            "values; measure something that only one of them changes, or leave one out of fit"
        )


def _listed(names: Sequence[str]) -> str:
    """Return names as "a, b and c"."""
    return " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))


def disagrees(chi_square: float, freedom: int) -> bool:
    """Whether χ² is too large to be by chance; not where nothing is left to test by."""
    return freedom > 0 and bool(chdtrc(freedom, chi_square) < UNLIKELY)


def _on_misfit(
    data: pd.DataFrame, freedom: int | None, cells: int, explained: str
) -> Iterator[str]:
    if freedom is None:
        return
    if freedom == 0:
        yield (
            "there are no more data than parameters, so that nothing is left to test the model with"
        )
        return
    read = data[~data["below"]]
    chi_square = float(np.sum(read["alone"] ** 2))
    stated = float(np.sum((read["residual"] * read["sigma"] / read["stated"]) ** 2))
    by_steps = float(np.mean((read["step_sigma"] / read["stated"]) ** 2))
    # Readings in coarse steps are alike.
    if by_steps < 0.5 and chdtrc(freedom, stated) > 1 - TOO_SMALL:
        yield (
            f"data and model differ by less than the stated uncertainties: χ² with those alone is "
            f"{stated:.2g} where about {freedom} is expected; the uncertainties are too large, or "
            "the data not independent"
        )
    if disagrees(chi_square, freedom):
        worst = read.loc[read["alone"].abs().idxmax()]
        of_grid = ""
        # Only where errors of the grid dominate is the grid the reason.
        if not explained and worst.quantity in FIELDS and worst.sigma**2 > 2 * worst.stated**2:
            of_grid = f", or the grid is too coarse: try grid.cells = {2 * cells}"
        yield (
            f"data and model disagree: χ² is {chi_square:.3g} where about {freedom} is expected; "
            f"the {named(worst)} is off by {abs(worst.alone):.3g} times its "
            f"uncertainty. {explained}The model leaves something out, or uncertainties are larger "
            f"than stated{of_grid}; the intervals are then too narrow"
        )


def on_repeats(data: pd.DataFrame) -> Iterator[str]:
    """Name a value far from those of repeated tests, which are fitted with their scatter."""
    numbers = data[~data["below"] & ~data["quantity"].isin(FIELDS)]
    alike = ["setup", "body", "quantity", "time_s"]
    for _, rows in numbers.groupby(alike, dropna=False, sort=False):
        n, (measured, stated) = len(rows), rows[["measured", "stated"]].to_numpy().T
        if n < _FEWEST_REPEATS:
            continue
        logs, apart = np.log(measured), math.sqrt(1 + 1 / (n - 1))
        others = [np.delete(logs, i) for i in range(n)]
        means = np.array([np.mean(rest) for rest in others])
        scatter = np.array([np.std(rest, ddof=1) for rest in others])
        # That of the others, which readings in coarse steps may hide.
        of_others = np.array([np.mean(np.delete(stated, i)) for i in range(n)])
        at_least = np.maximum(scatter, of_others / np.exp(means))
        # Neither the scatter of the others nor the instrument makes it so.
        by_scatter = 2 * stdtr(n - 2, -np.abs(logs - means) / apart / at_least)
        by_both = np.sqrt(stated**2 + of_others**2 / (n - 1))
        by_instrument = 2 * ndtr(-np.abs(measured - np.exp(means)) / by_both)
        chance = n * np.maximum(by_scatter, by_instrument)
        worst = int(np.argmin(chance))
        if chance[worst] < _OUTLYING:
            each = rows.iloc[worst]
            yield (
                f"the {named(each)} of {in_words(each.quantity, each.measured)} is not as in the "
                f"other {n - 1} tests, which scatter by {percent(float(scatter[worst]))} % about "
                f"{in_words(each.quantity, float(np.exp(means[worst])))}: check it; the "
                "repeatability, and with it all intervals, are larger for it"
            )


def _on_patterns(data: pd.DataFrame) -> Iterator[str]:
    """Name profiles and maps whose neighbouring residuals are correlated, but for their scale."""
    along = data[data["quantity"].isin(FIELDS)].sort_values("position_m", kind="stable")
    for _, rows in along.groupby("place", sort=False):
        residuals = rows["alone"].to_numpy()
        scale = (rows["computed"] / rows["sigma"]).to_numpy()
        size = float(np.sum(scale**2)) or 1.0
        residuals = residuals - np.sum(residuals * scale) / size * scale
        squares = float(np.sum(residuals**2)) or 1.0
        correlation = np.sum(residuals[1:] * residuals[:-1]) / squares
        if correlation * len(rows) ** 0.5 > _CORRELATED and np.max(np.abs(residuals)) > 1:
            yield (
                f"the residuals of the {named(next(rows.itertuples()))} follow a pattern: those "
                f"of neighbours have a correlation of {correlation:.2f}, so the scar has another "
                "shape than the model's"
            )


def _on_instruments(data: pd.DataFrame) -> Iterator[str]:
    """Name quantities for which the instrument or the grid is too coarse."""
    largest = data["measured"].abs().groupby(data["place"]).transform("max")
    for entry in data.assign(largest=largest).drop_duplicates("place").itertuples():
        name = entry.quantity
        if entry.step_most >= entry.largest and entry.step_most > 0 and not entry.below:
            yield (
                f"the {_instrument(entry)} is too coarse: read to {in_words(name, entry.step)}, "
                f"the {named(entry)} may be off by {in_words(name, entry.step_most)}, and "
                f"{in_words(name, entry.largest)} is given"
            )
        if entry.stated < entry.edge:
            yield (
                f"the {named(entry)} is measured to {in_words(name, entry.stated)}, the grid "
                f"is good to about {in_words(name, entry.edge)}: raise grid.cells"
            )


def _instrument(entry: Any) -> str:
    return "balance" if entry.quantity == "mass" else "instrument"


def named(entry: Any) -> str:
    """Return the name of what was measured, as ``"mass of 'ball' in heavy"``."""
    where = f" in {entry.test}" if entry.test else ""
    when = "" if math.isnan(entry.time_s) else f" at {entry.time_s:g} s"
    return f"{entry.quantity} of {entry.body!r}{where}{when}"
