"""Local wear coefficients from the depth map of a file of measured values."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from tribo import Array, Case, CaseError, NumericalError, Simulation, read_heights
from tribo.kernel_api import begin, case_tables, located, march, unknown, validate_case

from tribo_inverse.adjoint.view import View
from tribo_inverse.calibration.cells import on_cells
from tribo_inverse.calibration.maps import FittedMap, fit_map
from tribo_inverse.calibration.measured import MapEntry
from tribo_inverse.calibration.prior import Prior
from tribo_inverse.calibration.scar_shift import PRIOR_SHIFT, find_shift
from tribo_inverse.findings import of_run

PLACE = "map.1"
"""Place of the map in a file of measured values."""
FAR = 2.0
"""Largest offset of the mean coefficient, in standard deviations of the prior."""


def calibrate_map(
    case: Case | Mapping[str, Any] | str | Path,
    entry: MapEntry,
    *,
    on_run: Callable[[int, float], None] = lambda count, misfit: None,
) -> FittedMap:
    """Fit local coefficients to the map of a file; see `fit_map`."""
    model = Simulation(
        validate_case(case_tables(case)).model_copy(update={"observers": ()}),
    ).model
    *_, last = march(model, begin(model))
    spacing = model.grid.spacing
    if entry.body not in model.cycle.maps:
        raise CaseError(unknown("body", entry.body, model.case.bodies), f"{PLACE}.body")
    worn = View(model, last.state).wear(entry.body)
    if entry.body not in model.laws.wear or not np.any(worn):
        raise CaseError(f"{entry.body!r} does not wear in this case", f"{PLACE}.body")
    if entry.length < min(spacing):
        raise CaseError(
            f"{1e6 * entry.length:.3g} µm is less than a cell, {1e6 * min(spacing):.3g} µm: "
            "raise grid.cells or length",
            f"{PLACE}.length",
        )
    with located(f"{PLACE}.depth"):
        pitch = None if entry.pitch is None else (entry.pitch, entry.pitch)
        heights = read_heights(entry.depth, pitch)
        depth, noise = on_cells(heights, worn.shape, spacing, find_shift(heights, worn, spacing))
        _check_volume(entry, depth, worn)
    try:
        found = fit_map(
            model,
            entry.body,
            depth,
            entry.uncertainty * noise,
            Prior(entry.spread, entry.length),
            placed=(PRIOR_SHIFT * model.grid.size[0], PRIOR_SHIFT * model.grid.size[1]),
            on_run=on_run,
        )
    except NumericalError as error:
        raise type(error)(
            "the fit went too far from the case to be computed: check the map's pitch, level and "
            f"uncertainty, and the coefficients of the case; {error}"
        ) from error
    return replace(found, findings=(*found.findings, *map(of_run, last.state.findings)))


def _check_volume(entry: MapEntry, depth: Array, worn: Array) -> None:
    """Refuse a loss that differs from the case's by over two standard deviations of the prior."""
    known = np.isfinite(depth) & (worn > 0)
    part, far = float(np.sum(depth[known]) / np.sum(worn[known])), math.exp(FAR * entry.spread)
    if not 1 / far < part < far:
        raise CaseError(
            f"it has {part:.3g} times the volume that the case wears there, which a spread of "
            f"{entry.spread:g} does not allow for: check the map, which is positive where it is "
            "worn, or first fit the case's k to its volume, in [[measured]]"
        )
