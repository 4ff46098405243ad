"""Depth maps, in the file of measured values, that local wear coefficients are fitted to."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pandas as pd

from tribo.case import Case
from tribo.config.load import case_tables, validate_case
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, located
from tribo.core.table import Table
from tribo.core.units import Quantity
from tribo.lab.heights import Heights, read_heights
from tribo.simulation.model import Model
from tribo.simulation.run import Simulation
from tribo.study.calibration.maps import FittedMaps, Prior, fit_maps
from tribo.study.variation import unknown_body

FINER, LEAST = 1e-6, 0.5 - 1e-6
MOST = 600
"""Numbers that a map is averaged to where a few parameters are fitted to it."""


class Mapped(Table):
    """The depth worn off a body, measured all over it, and how its coefficient may vary."""

    body: str
    """Name of the body in the case."""
    depth: str
    """File of a height map: depths in m, positive where material is gone, NaN where missing."""
    pitch: Annotated[float, Quantity("m", above=0)] | None = None
    """Distance between its pixels; that of the file if left out."""
    uncertainty: Annotated[float, Quantity("m", above=0)]
    """Standard deviation of the depth of a cell of the grid."""
    spread: Annotated[float, Quantity("1", above=0, below=3)] = 0.5
    """Relative standard deviation of the coefficient from place to place: that of its logarithm."""
    length: Annotated[float, Quantity("m", above=0)]
    """Correlation length: the distance at which coefficients are still much alike."""


def calibrate_maps(
    case: Case | Mapping[str, Any] | str | Path,
    mapped: Mapping[str, Mapped],
    *,
    on_run: Callable[[int, float], None] = lambda count, misfit: None,
) -> FittedMaps:
    """Do as `fit_maps`, with the maps by their place in the file, for messages."""
    model = Simulation(
        validate_case(case_tables(case)).model_copy(update={"observers": ()}),
    ).model
    depths: dict[str, tuple[Array, float]] = {}
    priors = {}
    for place, entry in mapped.items():
        if entry.body not in model.exposures:
            raise unknown_body(entry.body, model.bodies, f"{place}.body")
        if entry.body in depths:
            raise CaseError(f"{entry.body!r} has two maps; give one", place)
        if entry.body not in model.laws:
            raise CaseError(f"{entry.body!r} does not wear in this case", f"{place}.body")
        depth = read_depth(model, entry.body, entry.depth, entry.pitch, place)
        depths[entry.body] = depth, entry.uncertainty
        priors[entry.body] = Prior(entry.spread, entry.length)
    return fit_maps(model, depths, priors, on_run=on_run)


def read_depth(model: Model, body: str, file: str | None, pitch: float | None, place: str) -> Array:
    """Return a map's depth at the cells of a body's own surface, in m; NaN where missing.

    Of a map that is not measured yet, without a file, 0 at all of them.
    """
    shape = model.exposures[body].rows, model.grid.cells[1]
    if file is None:
        return np.zeros(shape)
    with located(f"{place}.depth"):
        heights = read_heights(file, None if pitch is None else (pitch, pitch))
        _check_depths(heights)
        return on_cells(heights, shape, model.grid.spacing)


def _check_depths(heights: Heights) -> None:
    """Raise CaseError if depths are larger than the map is wide, as no worn surface's are."""
    depths, width = heights.heights, max(heights.grid.size)
    absurd = depths[np.abs(depths) > width]
    if len(absurd):
        raise CaseError(
            f"{len(absurd)} of its {depths.size} depths are larger than the map is wide, "
            f"{1e3 * width:.3g} mm; the first is {absurd[0]:g} m. Depths are in m, and NaN where "
            "nothing was measured: put NaN for fill values, 1e-6 times the depth for one in µm"
        )


def in_blocks(depth: Array, spacing: tuple[float, float]) -> pd.DataFrame:
    """Return the mean of a map over equal blocks of cells, 600 at most, a row each.

    `measured` is the mean, `x_m` and `y_m` its place, and `cells` those that were measured, counted
    row by row.
    """
    side = 1
    while np.prod(-(-np.array(depth.shape) // side)) > MOST:
        side += 1
    (rows, ny), cells = depth.shape, np.arange(depth.size)
    i, j = cells // ny, cells % ny
    known = pd.DataFrame(
        {
            "measured": depth.ravel(),
            "x_m": spacing[0] * (i - 0.5 * (rows - 1)),
            "y_m": spacing[1] * (j - 0.5 * (ny - 1)),
            "cells": cells,
            "block": i // side * ny + j // side,
        }
    ).dropna()
    blocks = known.groupby("block")
    means = blocks[["measured", "x_m", "y_m"]].mean()
    return means.assign(cells=blocks["cells"].agg(tuple)).reset_index(drop=True)


def on_cells(heights: Heights, shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Return the mean of a map over each cell of a surface, centre on centre.

    Of the pixels that a cell cuts it has a part. NaN where less than half of it was measured.
    """
    averaged = shape[0] == 1
    cell = heights.heights.shape[0] * heights.pitch[0] if averaged else spacing[0], spacing[1]
    if any(pitch > (1 + FINER) * size for pitch, size in zip(heights.pitch, cell, strict=True)):
        raise CaseError(
            f"its pixels, {1e6 * heights.pitch[0]:g} × {1e6 * heights.pitch[1]:g} µm, are larger "
            f"than cells, {1e6 * cell[0]:g} × {1e6 * cell[1]:g} µm; check pitch, or lower "
            "grid.cells"
        )
    known = np.isfinite(heights.heights)
    pixels = np.where(known, heights.heights, 0.0)
    # Heights within a pixel follow those beside it, or parts of one would be off.
    slopes = [
        np.where(known, np.nan_to_num(np.gradient(heights.heights, axis=axis)), 0.0)
        for axis in (0, 1)
    ]
    (in_x, off_x), (in_y, off_y) = (
        _overlaps(n, width, m, pitch)
        for n, width, m, pitch in zip(shape, cell, known.shape, heights.pitch, strict=True)
    )
    total = in_x @ pixels @ in_y.T + off_x @ slopes[0] @ in_y.T + in_x @ slopes[1] @ off_y.T
    measured = in_x @ known @ in_y.T
    enough = measured >= LEAST * cell[0] * cell[1]
    found = np.divide(total, measured, out=np.full(shape, np.nan), where=enough)
    if not np.any(enough):
        raise CaseError(
            "it does not lie on the window: its middle is taken as the contact's; check pitch, "
            f"{1e6 * heights.pitch[0]:g} × {1e6 * heights.pitch[1]:g} µm"
        )
    return np.asarray(found)


def _overlaps(cells: int, width: float, pixels: int, pitch: float) -> tuple[Array, Array]:
    """Return what cells and pixels share, centre on centre: lengths, shape (cells, pixels).

    And each times how far the middle of what is shared lies from that of the pixel, in pixels.
    """
    to_cell = width * (np.arange(cells + 1)[:, None] - 0.5 * cells)
    to_pixel = pitch * (np.arange(pixels + 1) - 0.5 * pixels)
    begin = np.maximum(to_cell[:-1], to_pixel[:-1])
    end = np.minimum(to_cell[1:], to_pixel[1:])
    shared = np.maximum(end - begin, 0.0)
    return shared, 0.5 * shared * (begin + end - to_pixel[:-1] - to_pixel[1:]) / pitch
