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

from tribo_inverse.adjoint.objective import View
from tribo_inverse.calibration.cells import on_cells, read_map
from tribo_inverse.calibration.exactness import data_error
from tribo_inverse.calibration.maps import FittedMaps, fit_maps
from tribo_inverse.calibration.measured import MapEntry
from tribo_inverse.calibration.prior import Prior
from tribo_inverse.calibration.quantities import DEPTH_MAP
from tribo_inverse.calibration.scar_shift import PRIOR_SHIFT, ScarShift, find_shift, slopes
from tribo_inverse.findings import SIGNIFICANT, off_level, off_middle

FAR = 2.0
"""Standard deviations of the prior by which the mean coefficient may be off."""


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
        if entry.body not in model.exposures:
            raise unknown_body(entry.body, model.bodies, f"{place}.body")
        if entry.body in depths:
            raise CaseError(f"{entry.body!r} has two maps; give one", place)
        spacing, worn = model.grid.spacing, clean.wear(entry.body)
        if entry.body not in model.laws or not np.any(worn):
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
        depths[entry.body], placed[entry.body] = (depth, entry.uncertainty * noise), far
        priors[entry.body] = Prior(entry.spread, entry.length)
        read.append(_Read(place, entry, depth, worn, shift.shift))
    for each in read:
        each.check_volume()
    try:
        found = fit_maps(model, depths, priors, placed=placed, on_run=on_run)
    except NumericalError as error:
        raise type(error)(
            "the fit went too far from the case to be computed: check the maps' pitch, level and "
            f"uncertainty, and the coefficients of the case; {error}"
        ) from error
    more = [Finding("run", str(notice)) for notice in last.state.notices]
    for each in read:
        more += each.off_middle(found.maps[each.entry.body].off, model.grid.spacing)
        more += each.off_level()
    return replace(found, findings=(*found.findings, *more))


class _Read(NamedTuple):
    """A map, its depth on the cells, moved by a shift, and that of a run with one coefficient."""

    place: str
    entry: MapEntry
    depth: Array
    worn: Array
    shift: tuple[float, float]

    def off_middle(self, off: Sequence[float], spacing: tuple[float, float]) -> Iterator[Finding]:
        """Report a map further `off` the contact's middle, in m, than its noise hides."""
        along, shift = slopes(self.worn, spacing), [*self.shift]
        for axis, further in zip(along, off, strict=True):
            shift[axis] += further
        moved = sum(shift[axis] * slope for axis, slope in along.items())
        if np.std(np.asarray(moved)[self.worn > 0]) > self.entry.uncertainty:
            but = ", as far as a coefficient that differs from side to side lets it tell"
            for axis in along:
                yield off_middle(self._name, self.place, axis, shift[axis], but=but)

    def off_level(self) -> Iterator[Finding]:
        """Report a map that is not levelled."""
        given = self.depth, self.worn, self.entry.uncertainty
        return off_level(self._name, self.place, *given)

    @property
    def _name(self) -> str:
        return f"map of {self.entry.body!r}"

    def check_volume(self) -> None:
        """Refuse a loss further from the case's than two standard deviations of the prior."""
        known = np.isfinite(self.depth) & (self.worn > 0)
        lost, own = float(np.sum(self.depth[known])), float(np.sum(self.worn[known]))
        noise = SIGNIFICANT * self.entry.uncertainty * float(np.sum(known)) ** 0.5
        far = math.exp(FAR * self.entry.spread)
        if not (lost + noise > own / far and lost - noise < own * far):
            times = f"{lost / own:.3g} times" if lost > noise else "none of"
            raise CaseError(
                f"it has {times} the volume that the case wears there, which a spread of "
                f"{self.entry.spread:g} does not allow for: check the map, or first fit the "
                "case's k to it, as a depth_map in [[measured]]",
                f"{self.place}.depth",
            )
