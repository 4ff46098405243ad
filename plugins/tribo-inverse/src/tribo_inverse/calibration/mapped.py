"""Local wear coefficients from the depth maps of a file of measured values."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from tribo import Array, Case, CaseError, NumericalError, Simulation
from tribo.kernel_api import begin, case_tables, located, march, unknown_body, validate_case

from tribo_inverse.adjoint.view import View
from tribo_inverse.calibration.cells import on_cells, read_map
from tribo_inverse.calibration.maps import FittedMaps, fit_maps
from tribo_inverse.calibration.measured import MapEntry
from tribo_inverse.calibration.prior import Prior
from tribo_inverse.calibration.scar_shift import PRIOR_SHIFT, find_shift
from tribo_inverse.findings import of_run

NOISE = 3.0
"""Standard deviations by which a mean depth below 0 is not noise."""
FAR = 2.0
"""Largest offset of the mean coefficient, in standard deviations of the prior."""


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
    priors, placed = {}, {}
    *_, last = march(model, begin(model))
    clean = View(model, last.state)
    for place, entry in mapped.items():
        if entry.body not in model.cycle.maps:
            raise unknown_body(entry.body, model.case.bodies, f"{place}.body")
        if entry.body in depths:
            raise CaseError(f"{entry.body!r} has two maps; give one", place)
        spacing, worn = model.grid.spacing, clean.wear(entry.body)
        if entry.body not in model.laws.wear or not np.any(worn):
            raise CaseError(f"{entry.body!r} does not wear in this case", f"{place}.body")
        if entry.length < min(spacing):
            raise CaseError(
                f"{1e6 * entry.length:.3g} µm is less than a cell, {1e6 * min(spacing):.3g} µm: "
                "raise grid.cells or length",
                f"{place}.length",
            )
        heights = read_map(entry.depth, entry.pitch, place)
        with located(f"{place}.depth"):
            shift = find_shift(heights, worn, spacing)
            depth, noise = on_cells(heights, worn.shape, spacing, shift)
            _check_sign(entry.uncertainty, depth[np.isfinite(depth)])
            _check_volume(entry, depth, worn)
        depths[entry.body] = depth, entry.uncertainty * noise
        placed[entry.body] = [PRIOR_SHIFT * size for size in model.grid.size]
        priors[entry.body] = Prior(entry.spread, entry.length)
    try:
        found = fit_maps(model, depths, priors, placed=placed, on_run=on_run)
    except NumericalError as error:
        raise type(error)(
            "the fit went too far from the case to be computed: check the maps' pitch, level and "
            f"uncertainty, and the coefficients of the case; {error}"
        ) from error
    return replace(found, findings=(*found.findings, *map(of_run, last.state.findings)))


def _check_sign(sigma: float, depths: Array) -> None:
    """Refuse depths that are negative in the mean."""
    mean = float(np.mean(depths))
    if mean < -NOISE * sigma / np.sqrt(len(depths)):
        raise CaseError(
            f"the depths are negative, {1e6 * mean:.3g} µm in the mean; depths count downwards "
            "from the unworn surface, positive where it is worn: turn the sign round, or level them"
        )


def _check_volume(entry: MapEntry, depth: Array, worn: Array) -> None:
    """Refuse a loss that differs from the case's by over two standard deviations of the prior."""
    known = np.isfinite(depth) & (worn > 0)
    part, far = float(np.sum(depth[known]) / np.sum(worn[known])), math.exp(FAR * entry.spread)
    if not 1 / far < part < far:
        raise CaseError(
            f"it has {part:.3g} times the volume that the case wears there, which a spread of "
            f"{entry.spread:g} does not allow for: check the map, or first fit the case's k to "
            "its volume, in [[measured]]"
        )
