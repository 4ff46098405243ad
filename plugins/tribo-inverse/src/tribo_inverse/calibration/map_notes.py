"""Notes on the position, level and pixel pitch of measured depth maps and profiles."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import affine_transform, binary_dilation
from tribo import Array
from tribo.kernel_api import signed

from tribo_inverse.calibration.cells import cell_means, means_over
from tribo_inverse.calibration.notes import named
from tribo_inverse.calibration.quantities import AXES, DEPTH_SIGMA, PROFILES, WORN
from tribo_inverse.calibration.scar_shift import ScarShift, slopes

if TYPE_CHECKING:
    from tribo_inverse.calibration.experiment import Experiment
    from tribo_inverse.calibration.linearised import Linearised

DIRECTIONS = ("along", "across")
"""The sliding direction."""
MARGIN = 2
"""Cells around the worn area that may be worn."""
SIGNIFICANT = 4.0
"""Standard deviations above which a deviation is not noise."""
FEWEST, FEW = 4, 2
"""Values of a profile's slope, and of a median."""
MEDIAN_SIGMA = 1.25
"""Standard deviation of a median, relative to that of a mean."""
TURNED = 0.25
"""Squared residuals of a turned map, relative to those of the map, below which it is named."""
LEAST_STRETCH = 0.01
"""Relative error of a pitch that is reported."""
EXPLAINED = 0.5
"""Part of the excess of χ² that a wrong pitch must explain."""
LINEAR = 1.25
"""Stretch up to which the depths are taken as linear in it."""
LEAST_EXPONENT = 0.9
"""Exponent of a scar's volume against its depth, below which no parameter makes a scar grow."""


def map_notes(fitted: Linearised, experiment: Experiment) -> Iterator[str]:
    """Name maps off centre, not levelled, turned, or of a wrong pitch, and shifted profiles."""
    for reading, depth in experiment.run(np.exp(fitted.point)).maps.items():
        row, found = experiment.table.loc[reading], experiment.shifts[reading]
        name = f"the {named(row)}"
        spacing = experiment.setups[row["setup"]].model.grid.spacing
        yield from off_middle(name, found)
        measured, _ = experiment.on_cells(reading, found.shift)
        yield from off_turn(name, measured, depth)
        # A scar of another width reaches beyond the model's.
        off_pitch = list(_off_pitch(name, fitted, experiment, reading, depth, spacing))
        yield from off_pitch or off_level(name, measured, depth, row["sigma"])
    yield from _off_profiles(fitted, experiment)


def off_middle(name: str, found: ScarShift) -> Iterator[str]:
    """Report the distance of the scar from the middle of the map."""
    if any(found.shift):
        words = [
            f"{signed(1e6 * far, 1)} {f'± {1e6 * sigma:.1g} ' if np.isfinite(sigma) else ''}µm "
            f"{direction}"
            for far, sigma, direction in zip(found.shift, found.sigma, DIRECTIONS, strict=True)
            if far
        ]
        yield (
            f"the scar in {name} lies {' and '.join(words)} the sliding direction from the middle "
            "of the map"
        )


def off_level(name: str, measured: Array, depth: Array, sigma: float) -> Iterator[str]:
    """Report the level of a map outside the model's scar, or of one side where that is larger."""
    largest = float(np.max(depth))
    unworn = ~binary_dilation(depth > WORN * largest, iterations=MARGIN) & np.isfinite(measured)
    sides = [
        unworn & ((place < 0.5 * n) == first)
        for place, n in zip(np.indices(depth.shape), depth.shape, strict=True)
        for first in (True, False)
    ]
    worst, where = 0.0, ""
    for part, words in ((unworn, ""), *((side, " on one side") for side in sides)):
        if (count := int(np.sum(part))) >= FEW:
            level = float(np.median(measured[part]))
            noise = SIGNIFICANT * MEDIAN_SIGMA * sigma / count**0.5
            limit = max(noise, DEPTH_SIGMA * largest, 2 * abs(worst))
            if abs(level) > limit:
                worst, where = level, words
    if worst:
        yield (
            f"outside the scar {name} lies {1e6 * abs(worst):.2g} µm "
            f"{'above' if worst > 0 else 'below'} 0{where}: level it first, as tribo scar does"
        )


def off_turn(name: str, measured: Array, depth: Array) -> Iterator[str]:
    """Report a map that fits far better with its axes swapped, or mirrored; of whatever scale."""
    model = cell_means(depth)
    ways = {
        "mirrored along the sliding direction": measured[::-1],
        "mirrored across the sliding direction": measured[:, ::-1],
    }
    if measured.shape[0] == measured.shape[1]:
        ways["with its axes swapped (x goes from row to row, y along each)"] = measured.T
    for way, turned in ways.items():
        known = np.isfinite(turned) & np.isfinite(measured)
        if np.any(model[known] > 0) and 2 * np.sum(known) > np.sum(np.isfinite(measured)):
            here = model[known] / np.linalg.norm(model[known])
            own, other = (m @ m - (here @ m) ** 2 for m in (measured[known], turned[known]))
            if other < TURNED * own:
                yield f"{name} fits far better {way}: turn it"


def _off_profiles(fitted: Linearised, experiment: Experiment) -> Iterator[str]:
    """Report the shift of profiles: the part of the residuals proportional to their slope."""
    profiles = experiment.data[experiment.data["quantity"].isin(PROFILES)]
    for _, own in profiles.groupby("place", sort=False):
        rows, positions = own.index.to_numpy(), own["position_m"].to_numpy()
        x, first = np.unique(positions, return_index=True)
        if len(x) < FEWEST:
            continue
        column = np.zeros(len(experiment.data))
        column[rows] = np.interp(positions, x, np.gradient(fitted.responses[rows][first], x))
        shift, size = _explained(fitted, column)
        if abs(shift) * size > SIGNIFICANT:
            row = next(own.itertuples())
            yield (
                f"the scar in the {named(row)} lies {signed(1e6 * shift, 1)} ± {1e6 / size:.1g} µm "
                f"{DIRECTIONS[AXES[row.quantity]]} the sliding direction from its "
                "position 0, which is the contact's centre"
            )


def _explained(fitted: Linearised, column: Array) -> tuple[float, float]:
    """Return the amplitude of a systematic error fitted beside the parameters, and 1/σ of it."""
    column, residuals = fitted.weights.weigh(column), fitted.residuals(fitted.point)
    by_parameters = np.linalg.svd(fitted.jacobian(fitted.point), full_matrices=False)[0]
    column = column - by_parameters @ (by_parameters.T @ column)
    squared = float(column @ column)
    if squared == 0:
        return 0.0, 0.0
    return float(column @ residuals) / squared, squared**0.5


def _off_pitch(
    name: str,
    fitted: Linearised,
    experiment: Experiment,
    reading: int,
    depth: Array,
    spacing: tuple[float, float],
) -> Iterator[str]:
    """Report a scar that is wider or narrower than the model's, if a wrong pitch explains χ²."""
    stretch = np.zeros(depth.shape)
    for axis, slope in slopes(depth, spacing).items():
        n = depth.shape[axis]
        stretch += spacing[axis] * (np.indices(depth.shape)[axis] - 0.5 * (n - 1)) * slope
    rows = np.flatnonzero(experiment.data["reading"] == reading)
    column = np.zeros(len(experiment.data))
    column[rows] = means_over(stretch, experiment.data["cells"].iloc[rows])
    amplitude, size = _explained(fitted, column)
    fall = (amplitude * size) ** 2
    misfit = float(np.sum(fitted.residuals(fitted.point)[rows] ** 2))
    # σ includes errors of the grid, so that χ² may be less than the number of values.
    excess = misfit - min(len(rows), max(misfit - fall, 0.0))
    if excess < SIGNIFICANT**2:
        return
    stretched = _stretched(fitted, experiment, reading, depth)
    if stretched is None:
        return
    factor, responses = stretched
    if 1 / LINEAR < factor < LINEAR:
        factor, explains = 1 + amplitude, fall > EXPLAINED * excess
    else:
        residuals = fitted.problem.residuals(responses, fitted.weights)[rows]
        explains = float(np.sum(residuals**2)) - len(rows) < (1 - EXPLAINED) * excess
    if explains and abs(factor - 1) > LEAST_STRETCH:
        yield (
            f"the scar in {name} is about {factor:.2f} times as wide as the model's of that "
            "depth: check pitch"
        )


def _stretched(
    fitted: Linearised, experiment: Experiment, reading: int, depth: Array
) -> tuple[float, Array] | None:
    """Return the width of a scar relative to a model scar of its depth, by volumes over depths.

    Also the responses with the model's scar stretched to the measured width and depth. The model's
    volume and depth grow as powers of the parameter that changes them most. None where no parameter
    makes the scar grow.
    """
    rows = np.flatnonzero(experiment.data["reading"] == reading)
    data = experiment.data.iloc[rows]
    cells = data["cells"].map(len).to_numpy()
    measured, computed = data["measured"].to_numpy(), fitted.responses[rows]
    effects = fitted.effects(fitted.point)[rows]
    effect = effects[:, np.argmax(np.sum(np.abs(effects), axis=0))]
    deepest = int(np.argmax(computed))
    deeper = np.max(measured) / computed[deepest]
    larger = np.sum(cells * measured) / np.sum(cells * computed)
    of_volume, of_depth = np.sum(cells * effect) / np.sum(cells * computed), effect[deepest]
    # A scar that grows deeper does not become narrower.
    if larger <= 0 or of_volume * computed[deepest] < LEAST_EXPONENT * of_depth or of_depth <= 0:
        return None
    axes = np.array(depth.shape) > 1
    power = of_volume * computed[deepest] / of_depth
    wider = (larger / deeper) ** (axes / np.sum(axes))
    middle = 0.5 * (np.array(depth.shape) - 1)
    stretched = affine_transform(depth, 1 / wider, middle - middle / wider, order=1, mode="nearest")
    responses = fitted.responses.copy()
    responses[rows] = deeper * means_over(stretched, data["cells"])
    return float((larger / deeper**power) ** (1 / np.sum(axes))), responses
