"""How far a calibration can be trusted, in words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import chdtrc

from tribo.core.arrays import Array
from tribo.study.calibration.quantities import FIELDS, in_si, in_words, percent

UNLIKELY = 0.01
"""Probability of so large a misfit below which data and model are said to disagree."""
HARDLY, NOT_AT_ALL = 0.2, 0.01
"""How far apart the effects of parameters are: 1 is at right angles, 0 is the same."""
_TAKES_PART, _MOST, _ALIKE = 0.3, 0.5, 3.0
"""The last: standard deviations by which residuals of neighbours are alike more than noise is."""


def notes(
    estimates: pd.DataFrame, data: pd.DataFrame, jacobian: Array, spare: int | None, cells: int
) -> list[str]:
    """Return notes, with the derivatives of the residuals by the logarithms of the parameters.

    The data have residuals also `alone`: made independent of each other where tests scatter.
    `spare` are the degrees of freedom of χ², None where the data tell their own scatter; `cells`
    are those of the coarsest grid.
    """
    return [
        *_on_parameters(estimates, data, jacobian, spare),
        *_entangled(list(estimates["path"]), jacobian),
        *_on_misfit(data, spare, cells),
        *_on_patterns(data),
        *_on_instruments(data),
    ]


def _on_parameters(
    estimates: pd.DataFrame, data: pd.DataFrame, jacobian: Array, spare: int | None
) -> Iterator[str]:
    """Name parameters on a bound or left open, and the instrument that limits each."""
    parts = (data["step_sigma"] / data["sigma"]).to_numpy()
    for each, effect in zip(estimates.itertuples(), np.linalg.pinv(jacobian), strict=True):
        is_open = {"below": each.lower == 0, "above": math.isinf(each.upper)}
        if each.held:
            below = each.value - each.lower < each.upper - each.value
            yield (
                f"{each.path}: the estimate lies on its {'lower' if below else 'upper'} bound, "
                f"{in_si(each.lower if below else each.upper, each.unit)}, and has no interval; "
                "without the bound the data would be met better"
            )
        elif each.limited:
            yield (
                f"{each.path}: what it wears was below the limit of detection, so that it is below "
                f"{in_si(each.upper, each.unit)} and nothing more is known; the fitted case has as "
                "good as none"
            )
        elif any(is_open.values()):
            sides = " or ".join(side for side, so in is_open.items() if so)
            scatter = "; too few tests alike tell how far they scatter: state repeatability"
            yield (
                f"{each.path}: the data do not bound it from {sides}"
                f"{scatter if spare is None and all(is_open.values()) else ''}"
            )
        if not (each.held or each.limited or is_open["above"]) and each.resolution_share > _MOST:
            entry = data.iloc[int(np.argmax(np.abs(effect) * parts))]
            yield (
                f"{each.path}: the {_instrument(entry)}'s resolution dominates the uncertainty; "
                f"the {named(entry)} read to {in_words(entry.quantity, entry.step)} "
                f"leaves ±{percent(each.resolution_limit)} % open"
            )


def _entangled(paths: Sequence[str], jacobian: Array) -> Iterator[str]:
    """Name parameters that change the data in the same way."""
    scaled = jacobian / np.sqrt(np.sum(jacobian**2, axis=0))
    _, angles, directions = np.linalg.svd(scaled, full_matrices=False)
    for angle, direction in zip(angles, directions, strict=True):
        if angle > HARDLY:
            continue
        taking = [i for i in range(len(paths)) if abs(direction[i]) > _TAKES_PART]
        names = [paths[i] for i in taking]
        how = "changing them together"
        if len(taking) == 2:
            opposed = direction[taking[0]] * direction[taking[1]] < 0
            how = "raising one and lowering the other" if opposed else "raising both"
        cannot = angle <= NOT_AT_ALL
        yield (
            f"the data {'cannot' if cannot else 'can hardly'} tell {', '.join(names[:-1])} and "
            f"{names[-1]} apart: {how} changes {'none' if cannot else 'little'} of the computed "
            "values; measure something that only one of them changes, or leave one out of fit"
        )


def _on_misfit(data: pd.DataFrame, spare: int | None, cells: int) -> Iterator[str]:
    if spare is None:
        return
    if spare == 0:
        yield (
            "there are no more data than parameters, so that nothing is left to test the model with"
        )
        return
    read = data[~data["below"]]
    chi_square = float(np.sum(read["alone"] ** 2))
    if chdtrc(spare, chi_square) < UNLIKELY:
        worst = read.loc[read["alone"].abs().idxmax()]
        of_grid = ""
        # Where the instrument is less exact than the grid it is not that.
        if worst.quantity in FIELDS and worst.sigma**2 > 2 * worst.stated**2:
            of_grid = f", or the grid is too coarse: try grid.cells = {2 * cells}"
        yield (
            f"data and model disagree: χ² is {chi_square:.3g} where about {spare} is expected; the "
            f"{named(worst)} is off by {abs(worst.alone):.3g} times its "
            "uncertainty. The model leaves something out, or uncertainties are larger than stated"
            f"{of_grid}; the intervals are then too narrow"
        )


def _on_patterns(data: pd.DataFrame) -> Iterator[str]:
    """Name profiles and maps whose residuals are alike from place to place, as noise is not."""
    along = data[data["quantity"].isin(FIELDS)].sort_values("position_m", kind="stable")
    for _, rows in along.groupby("place", sort=False):
        residuals = rows["alone"].to_numpy()
        alike = np.sum(residuals[1:] * residuals[:-1]) / np.sum(residuals**2)
        if alike * len(rows) ** 0.5 > _ALIKE and np.max(np.abs(residuals)) > 1:
            yield (
                f"the residuals of the {named(next(rows.itertuples()))} follow a pattern: those "
                f"of neighbours are alike, with a correlation of {alike:.2f}, so that the scar has "
                "another shape than the model gives it"
            )


def _on_instruments(data: pd.DataFrame) -> Iterator[str]:
    """Name quantities for which the instrument or the grid is too coarse."""
    largest = data["measured"].abs().groupby(data["place"]).transform("max")
    for entry in data.assign(largest=largest).drop_duplicates("place").itertuples():
        name = entry.quantity
        if entry.step_most >= entry.largest and not entry.below:
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
