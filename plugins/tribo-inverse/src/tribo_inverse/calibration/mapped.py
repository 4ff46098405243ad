"""Local wear coefficients from the depth maps of a file of measured values."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from tribo import Array, Case, CaseError, Finding, NumericalError, Simulation
from tribo.kernel_api import begin, case_tables, located, march, unknown_body, validate_case

from tribo_inverse.adjoint.view import View
from tribo_inverse.calibration.cells import on_cells, read_map
from tribo_inverse.calibration.maps import FittedMaps, fit_maps
from tribo_inverse.calibration.measured import MapEntry, data_error
from tribo_inverse.calibration.prior import Prior
from tribo_inverse.calibration.quantities import DEPTH_MAP
from tribo_inverse.calibration.scar_shift import PRIOR_SHIFT, ScarShift, find_shift, slopes
from tribo_inverse.findings import SIGNIFICANT, of_run, off_level, off_middle

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
    priors, placed, read = {}, {}, list[_Read]()
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
        shift, far = ScarShift(), [0.0, 0.0]
        with located(f"{place}.depth"):
            if not entry.centred:
                shift = find_shift(heights, worn, spacing, entry.uncertainty)
                far = [PRIOR_SHIFT * size for size in model.grid.size]
            depth, noise = on_cells(heights, worn.shape, spacing, shift.shift)
            if error := data_error(DEPTH_MAP, entry.uncertainty, depth[np.isfinite(depth)]):
                raise CaseError(error)
            _check_volume(entry, depth, worn)
        depths[entry.body], placed[entry.body] = (depth, entry.uncertainty * noise), far
        priors[entry.body] = Prior(entry.spread, entry.length)
        read.append(_Read(place, entry, depth, worn, shift.shift))
    try:
        found = fit_maps(model, depths, priors, placed=placed, on_run=on_run)
    except NumericalError as error:
        raise type(error)(
            "the fit went too far from the case to be computed: check the maps' pitch, level and "
            f"uncertainty, and the coefficients of the case; {error}"
        ) from error
    more = [of_run(each) for each in last.state.findings]
    for each in read:
        more += each.findings(found.maps[each.entry.body].off, model.grid.spacing)
    return replace(found, findings=(*found.findings, *more))


def _check_volume(entry: MapEntry, depth: Array, worn: Array) -> None:
    """Refuse a loss that differs from the case's by over two standard deviations of the prior."""
    known = np.isfinite(depth) & (worn > 0)
    lost, own = float(np.sum(depth[known])), float(np.sum(worn[known]))
    noise = SIGNIFICANT * entry.uncertainty * float(np.sum(known)) ** 0.5
    far = math.exp(FAR * entry.spread)
    if not (lost + noise > own / far and lost - noise < own * far):
        times = f"{lost / own:.3g} times" if lost > noise else "none of"
        raise CaseError(
            f"it has {times} the volume that the case wears there, which a spread of "
            f"{entry.spread:g} does not allow for: check the map, or first fit the case's k to "
            "it, as a depth_map in [[measured]]"
        )


class _Read(NamedTuple):
    """A map, its depth on the cells, moved by a shift, and the depth of a run with one k."""

    place: str
    entry: MapEntry
    depth: Array
    worn: Array
    shift: tuple[float, float]

    def findings(self, off: Sequence[float], spacing: tuple[float, float]) -> Iterator[Finding]:
        """Report a map further `off` the middle, in m, than its noise, or not levelled."""
        name, along, shift = (
            f"map of {self.entry.body!r}",
            slopes(self.worn, spacing),
            [*self.shift],
        )
        for axis, further in zip(along, off, strict=True):
            shift[axis] += further
        moved = sum(shift[axis] * slope for axis, slope in along.items())
        if np.std(np.asarray(moved)[self.worn > 0]) > self.entry.uncertainty:
            but = ", as far as a coefficient that differs from side to side lets it tell"
            for axis in along:
                yield off_middle(name, self.place, axis, shift[axis], but=but)
        yield from off_level(name, self.place, self.depth, self.worn, self.entry.uncertainty)
