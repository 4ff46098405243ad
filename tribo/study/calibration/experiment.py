"""What is asked of a case: its tests, parameters and data, and the runs that answer."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tribo.case import Case
from tribo.config.load import case_tables, validate_case
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, located
from tribo.lab.heights import Heights
from tribo.study.calibration.cells import (
    block_means,
    cell_means,
    means_over,
    on_cells,
    read_map,
    surface_shape,
)
from tribo.study.calibration.linearised import Problem
from tribo.study.calibration.measured import (
    Measurements,
    data_error,
    read_measurements,
)
from tribo.study.calibration.parameters import Parameter, check_set, find_parameters
from tribo.study.calibration.quantities import (
    AXES,
    DEPTH_MAP,
    DEPTH_SIGMA,
    DIAMETER_SIGMA,
    EDGE_CELL_SIGMA,
    FIELDS,
    PROFILES,
    Reading,
    edge_sigma,
)
from tribo.study.calibration.scar_shift import ScarShift, find_shift, slopes
from tribo.study.calibration.setups import READ, Run, Setup, find_setups, make_run, unmeasured

SMALL, ANYWHERE = 0.1, 0.25
"""Part of the largest depth of a profile or a map below which depths are no power laws.

The second: standard deviation, in parts of the surface, of how far a map is off before it is seen.
"""


@dataclass(frozen=True)
class Experiment:
    """Parameters of a case, the tests that tell them, and what was measured."""

    setups: list[Setup]
    parameters: list[Parameter]
    table: pd.DataFrame
    """As `Measurements.table` has it, with `setup`, and `edge`: the σ of a computed diameter."""
    heights: Mapping[int, Heights]
    """What was measured of a depth map, by its row of the table."""
    data: pd.DataFrame
    """The same, with the row of the table, `reading`; a depth map has a row for each block of
    cells that it is averaged over, with `x_m`, `y_m`, and how far its scar lies from the middle of
    the map, `shift_x_m`, `shift_y_m`."""
    predicted: pd.DataFrame
    """What is read off at the end but was not measured: `setup`, `test` and `READ`."""
    repeatability: float | None
    """From test to test; None if it is to be estimated."""
    shifts: Mapping[int, ScarShift] = field(default_factory=dict)
    """Where the scar of a map was found, by its row of the table."""
    runs: dict[bytes, Run] = field(default_factory=dict)
    """What has been run, by the bytes of the parameters: readings of the table and predicted."""

    @classmethod
    def of(
        cls,
        case: Case | Mapping[str, Any] | str | Path,
        measured: Measurements | Mapping[str, Any] | str | Path,
    ) -> Experiment:
        """Read a case and measured values; CaseError if they are wrong or do not fit together."""
        tables, asked = case_tables(case), read_measurements(measured)
        if asked.map:
            raise CaseError("asks for local coefficients; see calibrate_maps", "map")
        base = validate_case(tables)
        data = asked.table()
        setups = find_setups(tables, asked.tests, data)
        parameters = find_parameters(base, asked.fit, data["body"].unique())
        for place, test in asked.tests.items():
            check_set(parameters, test.set, f"{place}set")
        diameter = data["position_m"].isna() & data["quantity"].isin(AXES)
        axis = data["quantity"].map(AXES).fillna(0).astype(int)
        spacing = np.array([setup.model.grid.spacing for setup in setups])
        data["edge"] = np.where(diameter, DIAMETER_SIGMA * spacing[data["setup"], axis], 0.0)
        seen = data[~data["below"]].groupby(["setup", *READ], dropna=False)["specimen"]
        repeatability = asked.repeatability
        if repeatability is None and not np.any(seen.nunique() > 1):
            repeatability = 0.0
        heights = {
            each.Index: read_map(each.entry.depth, each.entry.pitch, each.place)
            for each in data.itertuples()
            if each.quantity == DEPTH_MAP and each.entry.depth is not None
        }
        found = cls(
            setups, parameters, data, heights, data, unmeasured(setups, data), repeatability
        )
        return found.moved({})

    @property
    def start(self) -> Array:
        """Where the fit begins, rounded as in the fit, which works with logarithms."""
        return np.exp(np.log([p.start for p in self.parameters]))

    @property
    def run_count(self) -> int:
        """How many simulations were run."""
        return len(self.setups) * len(self.runs)

    @cached_property
    def asked(self) -> list[tuple[Array, list[Reading]]]:
        """Of each case which readings it gives, the table's first, and what they are."""
        both = pd.concat([self.table, self.predicted], ignore_index=True)
        return [
            (own.index.to_numpy(), [Reading(*row) for row in own[READ].itertuples(index=False)])
            for _, own in both.groupby("setup")
        ]

    def moved(self, shifts: Mapping[int, ScarShift]) -> Experiment:
        """Return it with the middles of scars, where they were found, on that of the contact."""
        parts = []
        for reading, row in self.table.groupby(level=0):
            rows = row.assign(reading=reading)
            if row["quantity"].iloc[0] == DEPTH_MAP:
                rows = self._of_map(rows, shifts.get(reading, ScarShift()).shift)
            parts.append(rows)
        return replace(self, data=pd.concat(parts, ignore_index=True), shifts=shifts)

    def on_cells(self, reading: int, shift: tuple[float, float]) -> Array:
        """Return a map on the cells of its surface, in m; 0 of one that is not measured yet."""
        row = self.table.loc[reading]
        model = self.setups[row["setup"]].model
        shape = surface_shape(model, row["body"])
        if reading not in self.heights:
            return np.zeros(shape)
        with located(f"{row['place']}.depth"):
            return on_cells(self.heights[reading], shape, model.grid.spacing, shift)

    def _of_map(self, row: pd.DataFrame, shift: tuple[float, float]) -> pd.DataFrame:
        """Return a row of the table for each block of cells that a map is averaged over."""
        (each,) = row.itertuples()
        depth = self.on_cells(each.Index, shift)
        if told := data_error(each.entry, depth[np.isfinite(depth)]):
            raise CaseError(told, f"{each.place}.depth")
        blocks = block_means(depth, self.setups[each.setup].model.grid.spacing)
        if each.entry.depth is None:
            blocks["measured"] = math.nan
        blocks[["shift_x_m", "shift_y_m"]] = shift
        rows = row.loc[row.index.repeat(len(blocks))].reset_index(drop=True).assign(**blocks)
        for error in ("sigma", "step_sigma"):
            rows[error] /= rows["cells"].map(len) ** 0.5
        return rows

    def centred(self, values: Array) -> Experiment:
        """Return it with the scar of each map, if that tells where it is, where a run has it."""
        found = {}
        for reading, depth in self._made(values).maps.items():
            if reading in self.heights:
                row = self.table.loc[reading]
                spacing = self.setups[row["setup"]].model.grid.spacing
                sigma = math.hypot(row["sigma"], DEPTH_SIGMA * float(np.max(depth)))
                now = find_shift(self.heights[reading], depth, spacing, sigma)
                found[reading] = now.unless_near(self.shifts.get(reading, ScarShift()), spacing)
        return self.moved(found) if found else self

    def run(self, values: Array) -> Run:
        """Return the responses to parameters, of the data and then the predictions."""
        return self.of_data(self._made(values))

    def of_data(self, made: Run) -> Run:
        """Return a run with a response for each row of the data and the predictions."""
        predicted = len(self.table) + np.arange(len(self.predicted))
        reading = np.append(self.data["reading"], predicted).astype(int)
        responses, grid_sigma = made.responses[reading], made.grid_sigma[reading]
        for i, depth in made.maps.items():
            rows = np.flatnonzero(reading == i)
            cells = self.data["cells"].iloc[rows]
            responses[rows] = means_over(cell_means(depth), cells)
            at_edge = means_over(edge_sigma(depth, EDGE_CELL_SIGMA) ** 2, cells) / cells.map(len)
            grid_sigma[rows] = np.sqrt(grid_sigma[rows] ** 2 + at_edge)
        return made._replace(responses=responses, grid_sigma=grid_sigma)

    def _made(self, values: Array) -> Run:
        """Return the readings of a run, made once."""
        key = values.tobytes()
        if key in self.runs:
            return self.runs[key]
        responses, grid_sigma = np.empty((2, len(self.table) + len(self.predicted)))
        notices: dict[str, list[str]] = {}
        maps: dict[int, Array] = {}
        for i, (rows, wanted) in enumerate(self.asked):
            tables, name = self.setups[i].tables, f"run {self.run_count + i + 1}"
            made = make_run(tables, self.parameters, values, wanted, name)
            responses[rows], grid_sigma[rows] = made.responses, made.grid_sigma
            for j, depth in made.maps.items():
                shape = surface_shape(self.setups[i].model, wanted[j].body)
                maps[int(rows[j])] = depth[: shape[0]]
            for notice in made.notices:
                notices.setdefault(notice, []).append(self.setups[i].name or "the case as it is")
        positive = ~self.table["quantity"].isin(FIELDS).to_numpy()
        nothing = positive & (responses <= 0)[: len(self.table)]
        for each in self.table[nothing].itertuples() if np.any(nothing) else ():
            raise CaseError(
                f"the {each.quantity} of {each.body!r} comes out as 0 in the case; begin with more "
                "wear: give start in fit",
                each.place,
            )
        told = (
            notice if len(of) == len(self.setups) else f"{', '.join(of)}: {notice}"
            for notice, of in notices.items()
        )
        self.runs[key] = Run(responses, grid_sigma, maps, tuple(told))
        return self.runs[key]

    def problem(self, values: Array) -> Problem:
        """Return what is to be fitted; how well the grid gives the data a run of `values` says."""
        data, run = self.data, self.run(values)
        sigma = np.hypot(data["sigma"], run.grid_sigma[: len(data)]).to_numpy()
        computed = pd.Series(run.responses[: len(data)]).abs()
        largest = computed.groupby(data["place"]).transform("max").to_numpy()
        is_field = data["quantity"].isin(FIELDS)
        small = np.where(is_field, np.maximum(SMALL * largest, sigma), 0.0)
        with np.errstate(divide="ignore"):
            lower, upper = np.log([(p.lower, p.upper) for p in self.parameters]).T
        return Problem(
            names=tuple(p.path for p in self.parameters),
            observed=data["measured"].to_numpy(),
            sigma=sigma,
            below=data["below"].to_numpy(),
            specimen=data["specimen"].to_numpy(),
            repeatability=self.repeatability,
            small=np.append(small, np.zeros(len(self.predicted))),
            lower=lower,
            upper=upper,
            common=self._common(run),
        )

    def _common(self, run: Run) -> Array:
        """Return what the grid, and a map's place, put off in a whole field: `Problem.common`."""
        columns = []

        def add(rows: Any, source: Array) -> None:
            columns.append(np.zeros(len(self.data)))
            columns[-1][rows] = source

        for _, own in self.data[self.data["quantity"].isin(PROFILES)].groupby("place"):
            rows = own.index.to_numpy()
            depth, error = run.responses[rows], np.min(run.grid_sigma[rows])
            if (largest := np.max(depth)) > 0:
                add(rows, error * depth / largest)
        for reading, depth in run.maps.items():
            rows = np.flatnonzero(self.data["reading"] == reading)
            spacing = self.setups[self.data["setup"].iloc[rows[0]]].model.grid.spacing
            sources = [DEPTH_SIGMA * depth]
            for axis, slope in slopes(depth, spacing).items():
                sources.append(ANYWHERE * spacing[axis] * depth.shape[axis] * slope)
            for source in sources:
                add(rows, means_over(source, self.data["cells"].iloc[rows]))
        return np.array(columns).reshape(-1, len(self.data)).T
