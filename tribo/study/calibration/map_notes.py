"""What is wrong with a measured depth map or profile, in words: its place, level, pitch."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import affine_transform, binary_dilation

from tribo.core.arrays import Array
from tribo.core.words import signed
from tribo.study.calibration.cells import means
from tribo.study.calibration.notes import named
from tribo.study.calibration.placing import Placed, slopes
from tribo.study.calibration.quantities import AXES, DEPTH_SIGMA, PROFILES, WORN

if TYPE_CHECKING:
    from tribo.study.calibration.experiment import Experiment
    from tribo.study.calibration.linearised import Linearised

WAYS = ("along", "across")
"""The sliding direction."""
MARGIN = 2
"""Cells around what is worn that may be."""
CERTAIN, FEWEST, MEDIAN = 4.0, 4, 1.25
"""Standard deviations that are no noise, fewest cells of a median, its standard deviation."""
WIDER, MOST, FAR = 0.01, 0.5, 1.25
"""Least part by which a scar is too wide, and of the excess in χ² that this must explain.

The last: how many times as wide is too far off for a linear model."""
GROWS = 0.9
"""Power of the depth with which a scar's volume grows, below which it is said not to."""


def map_notes(fitted: Linearised, experiment: Experiment) -> Iterator[str]:
    """Name maps that are off their middle, not levelled, or of another pitch; shifted profiles."""
    for reading, depth in experiment.run(np.exp(fitted.point)).maps.items():
        row, found = experiment.table.loc[reading], experiment.placed[reading]
        name = f"the {named(row)}"
        spacing = experiment.setups[row["setup"]].model.grid.spacing
        yield from off_middle(name, found)
        measured = experiment.on_cells(reading, found.shift)
        yield from off_level(name, measured, depth, row["sigma"])
        yield from _off_pitch(name, fitted, experiment, reading, depth, spacing)
    yield from _off_profiles(fitted, experiment)


def off_middle(name: str, found: Placed) -> Iterator[str]:
    """Say how far the scar lies from the middle of the map."""
    if any(found.shift):
        words = [
            f"{signed(1e6 * far, 1)} ± {1e6 * sigma:.1g} µm {way}"
            for far, sigma, way in zip(found.shift, found.sigma, WAYS, strict=True)
            if far
        ]
        yield (
            f"the scar in {name} lies {' and '.join(words)} the sliding direction from the middle "
            "of the map"
        )


def off_level(name: str, measured: Array, depth: Array, sigma: float) -> Iterator[str]:
    """Say how far a map, on the cells of a model's, is from 0 where that is not worn.

    All over, or on one side where that is more.
    """
    largest = float(np.max(depth))
    unworn = ~binary_dilation(depth > WORN * largest, iterations=MARGIN) & np.isfinite(measured)
    sides = [
        unworn & ((place < 0.5 * n) == first)
        for place, n in zip(np.indices(depth.shape), depth.shape, strict=True)
        for first in (True, False)
    ]
    worst, where = 0.0, ""
    for part, words in ((unworn, ""), *((side, " on one side") for side in sides)):
        if (count := int(np.sum(part))) >= FEWEST:
            level = float(np.median(measured[part]))
            noise = CERTAIN * MEDIAN * sigma / count**0.5
            limit = max(noise, DEPTH_SIGMA * largest, 2 * abs(worst))
            if abs(level) > limit:
                worst, where = level, words
    if worst:
        yield (
            f"outside the scar {name} lies {1e6 * abs(worst):.2g} µm "
            f"{'above' if worst > 0 else 'below'} 0{where}: level it first, as tribo scar does"
        )


def _off_profiles(fitted: Linearised, experiment: Experiment) -> Iterator[str]:
    """Say how far profiles lie from the model's, by what their slopes explain of the residuals."""
    profiles = experiment.data[experiment.data["quantity"].isin(PROFILES)]
    for _, own in profiles.groupby("place", sort=False):
        rows, positions = own.index.to_numpy(), own["position_m"].to_numpy()
        x, first = np.unique(positions, return_index=True)
        if len(x) < FEWEST:
            continue
        column = np.zeros(len(experiment.data))
        column[rows] = np.interp(positions, x, np.gradient(fitted.responses[rows][first], x))
        shift, size = _explained(fitted, column)
        if abs(shift) * size > CERTAIN:
            row = next(own.itertuples())
            yield (
                f"the scar in the {named(row)} lies {signed(1e6 * shift, 1)} ± {1e6 / size:.1g} µm "
                f"{WAYS[AXES[row.quantity]]} the sliding direction from its position 0, which is "
                "the contact's centre"
            )


def _explained(fitted: Linearised, column: Array) -> tuple[float, float]:
    """Return how much of an error there is in the data, besides parameters, and its size in σ."""
    column, residuals = fitted.weights.weigh(column), fitted.residuals(fitted.point)
    taken = np.linalg.svd(fitted.jacobian(fitted.point), full_matrices=False)[0]
    column = column - taken @ (taken.T @ column)
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
    """Say by how much the scar is wider than the model's, where that explains the misfit."""
    stretch = np.zeros(depth.shape)
    for axis, slope in slopes(depth, spacing).items():
        n = depth.shape[axis]
        stretch += spacing[axis] * (np.indices(depth.shape)[axis] - 0.5 * (n - 1)) * slope
    rows = np.flatnonzero(experiment.data["reading"] == reading)
    column = np.zeros(len(experiment.data))
    column[rows] = means(stretch, experiment.data["cells"].iloc[rows])
    wider, size = _explained(fitted, column)
    fall = (wider * size) ** 2
    misfit = float(np.sum(fitted.residuals(fitted.point)[rows] ** 2))
    # Where what the grid may put off is most of the uncertainty, noise is less than it says.
    excess = misfit - min(len(rows), max(misfit - fall, 0.0))
    if excess < CERTAIN**2:
        return
    widths = _widths(fitted, experiment, reading, depth)
    if widths is None:
        return
    times, met = widths
    if 1 / FAR < times < FAR:
        times, explains = 1 + wider, fall > MOST * excess
    else:
        residuals = fitted.problem.residuals(met, fitted.weights)[rows]
        explains = float(np.sum(residuals**2)) - len(rows) < (1 - MOST) * excess
    if explains and abs(times - 1) > WIDER:
        yield (
            f"the scar in {name} is about {times:.2f} times as wide as the model's of that "
            "depth: check pitch"
        )


def _widths(
    fitted: Linearised, experiment: Experiment, reading: int, depth: Array
) -> tuple[float, Array] | None:
    """Return how many times as wide a scar is as the model's of its depth, by volumes over depths.

    And the responses with the model's scar made as wide and deep. As a parameter grows the model's
    volume and depth do as powers; that which changes it most. None where nothing makes it grow.
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
    # What grows deeper grows no narrower; where it seems to, nothing that is fitted makes it grow.
    grown, deepened = np.sum(cells * effect) / np.sum(cells * computed), effect[deepest]
    if larger <= 0 or grown * computed[deepest] < GROWS * deepened or deepened <= 0:
        return None
    axes = np.array(depth.shape) > 1
    power = grown * computed[deepest] / deepened
    wider = (larger / deeper) ** (axes / np.sum(axes))
    middle = 0.5 * (np.array(depth.shape) - 1)
    stretched = affine_transform(depth, 1 / wider, middle - middle / wider, order=1, mode="nearest")
    met = fitted.responses.copy()
    met[rows] = deeper * means(stretched, data["cells"])
    return float((larger / deeper**power) ** (1 / np.sum(axes))), met
