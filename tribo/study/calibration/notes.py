"""In words, how far a calibration can be trusted."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from scipy.special import chdtrc

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.study.calibration.measured import Measured
from tribo.study.calibration.outcome import Datum, Estimate
from tribo.study.calibration.parameters import Parameter
from tribo.study.calibration.quantities import EDGES, in_si, in_words, percent

UNLIKELY = 0.01
"""Probability of so large a misfit below which data and model are said to disagree."""
HARDLY, NOT_AT_ALL = 0.2, 0.01
"""How far apart the effects of parameters are: 1 is at right angles, 0 is the same."""
_AXES = {"scar_along": 0, "scar_across": 1}
_TAKES_PART = 0.3
_MOST = 0.5


def notes(
    estimates: Sequence[Estimate],
    parameters: Sequence[Parameter],
    data: Sequence[Datum],
    measured: Sequence[Measured],
    jacobian: Array,
    grid: Grid,
    spare: int,
) -> list[str]:
    """Return what to bear in mind, a sentence or two each.

    Parameters
    ----------
    estimates : sequence of Estimate
        The fitted parameters.
    parameters : sequence of Parameter
        The same as they were asked for.
    data : sequence of Datum
        The measured values beside the computed ones.
    measured : sequence of Measured
        The same as they were given.
    jacobian : ndarray, shape (n, p)
        Derivatives of the residuals by the logarithms of the parameters.
    grid : Grid
        The window of the runs.
    spare : int
        Degrees of freedom of χ².
    """
    return [
        *_dominated(estimates, data, measured, jacobian),
        *_entangled([each.path for each in estimates], jacobian),
        *_open(estimates),
        *_bounded(estimates, parameters),
        *_misfit(data, spare),
        *_too_coarse_to_show(measured),
        *_too_coarse(measured, grid),
    ]


def _dominated(
    estimates: Sequence[Estimate],
    data: Sequence[Datum],
    measured: Sequence[Measured],
    jacobian: Array,
) -> Iterator[str]:
    """Say where better instruments would help most."""
    effect = np.linalg.pinv(jacobian)
    owners = [entry for entry in measured for _ in entry.values]
    parts = np.array(
        [entry.from_resolution[0] / each.sigma for entry, each in zip(owners, data, strict=True)]
    )
    for estimate, own in zip(estimates, effect, strict=True):
        if estimate.held or math.isinf(estimate.upper):
            continue
        if estimate.resolution_share > _MOST:
            entry = owners[int(np.argmax(np.abs(own) * parts))]
            step = in_words(entry.quantity, entry.resolution or 0.0)
            yield (
                f"{estimate.path}: the {_instrument(entry)}'s resolution dominates the "
                f"uncertainty; the {entry.quantity} of {entry.body!r} read to {step} leaves "
                f"±{percent(estimate.resolution_limit)} % open"
            )


def _entangled(paths: Sequence[str], jacobian: Array) -> Iterator[str]:
    """Say which parameters change the data in the same way."""
    scaled = jacobian / np.sqrt(np.sum(jacobian**2, axis=0))
    _, angles, directions = np.linalg.svd(scaled)
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
            f"the data {'cannot' if cannot else 'can hardly'} tell {_listed(names)} apart: {how} "
            f"changes {'none' if cannot else 'little'} of the computed values; measure something "
            "that only one of them changes, or leave one out of fit"
        )


def _open(estimates: Sequence[Estimate]) -> Iterator[str]:
    for each in estimates:
        if each.held:
            continue
        sides = [
            side
            for side, is_open in (
                ("below", each.lower == 0),
                ("above", math.isinf(each.upper)),
            )
            if is_open
        ]
        if sides:
            yield f"{each.path}: the data do not bound it from {' or '.join(sides)}"


def _bounded(estimates: Sequence[Estimate], parameters: Sequence[Parameter]) -> Iterator[str]:
    for estimate, asked in zip(estimates, parameters, strict=True):
        if estimate.held:
            is_lower = estimate.value - asked.lower < asked.upper - estimate.value
            side, bound = ("lower", asked.lower) if is_lower else ("upper", asked.upper)
            yield (
                f"{estimate.path}: the estimate lies on its {side} bound, "
                f"{in_si(bound, asked.unit)}, and has no interval; without the bound the data "
                "would be met better"
            )


def _misfit(data: Sequence[Datum], spare: int) -> Iterator[str]:
    if spare == 0:
        yield (
            "there are no more data than parameters, so that nothing is left to test the model with"
        )
        return
    chi_square = sum(each.residual**2 for each in data)
    worst = max(data, key=lambda each: abs(each.residual))
    if chdtrc(spare, chi_square) < UNLIKELY:
        yield (
            f"data and model disagree: χ² is {chi_square:.3g} where about {spare} is expected; the "
            f"{worst.quantity} of {worst.body!r} is off by {abs(worst.residual):.3g} times its "
            "uncertainty. The model leaves something out, or uncertainties are larger than stated; "
            "the intervals are then too narrow"
        )


def _too_coarse_to_show(measured: Sequence[Measured]) -> Iterator[str]:
    for entry in measured:
        off, value = entry.from_resolution[1], float(np.max(np.abs(entry.values)))
        if off >= value:
            yield (
                f"the {_instrument(entry)} is too coarse: read to "
                f"{in_words(entry.quantity, entry.resolution or 0.0)}, the {entry.quantity} of "
                f"{entry.body!r} may be off by {in_words(entry.quantity, off)}, and "
                f"{in_words(entry.quantity, value)} is given"
            )


def _instrument(entry: Measured) -> str:
    return "balance" if entry.quantity == "mass" else "instrument"


def _too_coarse(measured: Sequence[Measured], grid: Grid) -> Iterator[str]:
    for entry in measured:
        if entry.quantity in _AXES:
            blur = EDGES * grid.spacing[_AXES[entry.quantity]]
            if entry.sigma < blur:
                yield (
                    f"the {entry.quantity} of {entry.body!r} is measured to "
                    f"{in_words(entry.quantity, entry.sigma)}, the grid is good to about "
                    f"{in_words(entry.quantity, blur)}: raise grid.cells"
                )


def _listed(names: Sequence[str]) -> str:
    return f"{', '.join(names[:-1])} and {names[-1]}"
