"""Local wear coefficients from the depth maps of a file of measured values."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from tribo.case import Case
from tribo.config.load import case_tables, validate_case
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, located
from tribo.lab.heights import Heights
from tribo.simulation.march import begin, march
from tribo.simulation.run import Simulation
from tribo.study.calibration.cells import on_cells, read_map, surface_shape
from tribo.study.calibration.map_notes import off_level, off_middle, off_turn
from tribo.study.calibration.maps import FittedMaps, Prior, fit_maps
from tribo.study.calibration.measured import MapEntry
from tribo.study.calibration.scar_shift import find_shift, slopes
from tribo.study.gradient.objective import View
from tribo.study.variation import unknown_body


def calibrate_maps(
    case: Case | Mapping[str, Any] | str | Path,
    mapped: Mapping[str, MapEntry],
    *,
    on_run: Callable[[int, float], None] = lambda count, misfit: None,
) -> FittedMaps:
    """Fit local coefficients to the maps of a file, by their place in it; see `fit_maps`."""
    model = Simulation(
        validate_case(case_tables(case)).model_copy(update={"observers": ()}),
    ).model
    depths: dict[str, tuple[Array, Array | float]] = {}
    priors, remarks = {}, list[str]()
    *_, last = march(model, begin(model))
    clean = View(model, last.state)
    for place, entry in mapped.items():
        if entry.body not in model.exposures:
            raise unknown_body(entry.body, model.bodies, f"{place}.body")
        if entry.body in depths:
            raise CaseError(f"{entry.body!r} has two maps; give one", place)
        if entry.body not in model.laws:
            raise CaseError(f"{entry.body!r} does not wear in this case", f"{place}.body")
        heights = read_map(entry.depth, entry.pitch, place)
        shape = surface_shape(model, entry.body)
        with located(f"{place}.depth"):
            depth, noise = on_cells(heights, shape, model.grid.spacing)
        remarks += _remarks(entry, heights, depth, clean.wear(entry.body), model.grid.spacing)
        depths[entry.body] = depth, entry.uncertainty * noise
        priors[entry.body] = Prior(entry.spread, entry.length)
    return replace(fit_maps(model, depths, priors, on_run=on_run), remarks=tuple(remarks))


def _remarks(
    entry: MapEntry, heights: Heights, depth: Array, model: Array, spacing: tuple[float, float]
) -> Iterator[str]:
    """Name a map that is off the middle of the case's scar, or not levelled."""
    name = f"the map of {entry.body!r}"
    found = find_shift(heights, model, spacing, entry.uncertainty, 0.0)
    moved = sum(found.shift[axis] * slope for axis, slope in slopes(model, spacing).items())
    if np.std(np.asarray(moved)[model > 0]) > entry.uncertainty:
        for note in off_middle(name, found):
            yield f"{note}: centre it, unless the coefficient is higher on that side"
    yield from off_level(name, depth, model, entry.uncertainty)
    yield from off_turn(name, depth, model)
