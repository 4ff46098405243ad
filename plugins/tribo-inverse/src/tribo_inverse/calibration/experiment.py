"""The tests, parameters and data of a calibration, and runs of the model for them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from tribo import Array, Case, CaseError, Finding, Heights
from tribo.kernel_api import case_tables, located, validate_case

from tribo_inverse.calibration.cells import (
    block_means,
    cell_means,
    means_over,
    on_cells,
    read_map,
    surface_shape,
)
from tribo_inverse.calibration.linearised import Problem
from tribo_inverse.calibration.measured import Measurements, data_error, read_measurements
from tribo_inverse.calibration.parameters import Parameter, check_set, find_parameters
from tribo_inverse.calibration.quantities import (
    DEPTH_MAP,
    DEPTH_SIGMA,
    EDGE_CELL_SIGMA,
    FIELDS,
    PROFILES,
    Reading,
    edge_sigma,
    in_si,
)
from tribo_inverse.calibration.scar_shift import PRIOR_SHIFT, find_shift, slopes
from tribo_inverse.calibration.setups import (
    READ,
    Setup,
    SetupRun,
    find_setups,
    make_run,
    unmeasured,
)
from tribo_inverse.findings import named, of_run

REFUSED = 300.0
"""Factor between measured and computed values above which they are refused: a wrong prefix of a
unit makes 1000."""
LINEAR_BELOW = 0.1
"""Part of the largest depth of a profile or map below which depths are taken as linear."""


@dataclass(frozen=True)
class Experiment:
    """Parameters of a case, its tests, and the measured data."""

    setups: list[Setup]
    parameters: list[Parameter]
    table: pd.DataFrame
    """`Measurements.table` with `setup`."""
    heights: Mapping[int, Heights]
    """Measured depth maps by their row of the table."""
    data: pd.DataFrame
    """The table with its row, `reading`. A depth map has one row per block of cells, with `x_m`,
    `y_m`, and the shift of its scar, `shift_x_m`, `shift_y_m`."""
    predicted: pd.DataFrame
    """Quantities at the end that were not measured: `setup`, `test` and `READ`."""
    repeatability: float | None
    """From test to test; None to estimate it."""
    runs: dict[bytes, SetupRun] = field(default_factory=dict)
    """Runs by the bytes of the parameters, with the readings of the table and predictions."""

    @classmethod
    def of(
        cls,
        case: Case | Mapping[str, Any] | str | Path,
        measured: Measurements | Mapping[str, Any] | str | Path,
    ) -> Experiment:
        """Read a case and measured values; CaseError if they are wrong or do not fit together."""
        tables, measurements = case_tables(case), read_measurements(measured)
        if measurements.map:
            raise CaseError("asks for local coefficients; see calibrate_maps", "map")
        base = validate_case(tables)
        data = measurements.table()
        setups = find_setups(tables, measurements.tests, data)
        parameters = find_parameters(base, measurements.fit, data["body"].unique())
        for place, test in measurements.tests.items():
            check_set(parameters, test.set, f"{place}set")
        seen = data.groupby(["setup", *READ], dropna=False)["specimen"]
        repeatability = measurements.repeatability
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
        """Start of the fit, rounded as in the fit, which works with logarithms."""
        return np.exp(np.log([p.start for p in self.parameters]))

    @property
    def run_count(self) -> int:
        """Number of simulations."""
        return len(self.setups) * len(self.runs)

    @cached_property
    def readings(self) -> list[tuple[Array, list[Reading]]]:
        """Readings of each setup, and their rows in the table followed by the predictions."""
        both = pd.concat([self.table, self.predicted], ignore_index=True)
        return [
            (own.index.to_numpy(), [Reading(*row) for row in own[READ].itertuples(index=False)])
            for _, own in both.groupby("setup")
        ]

    def moved(self, shifts: Mapping[int, tuple[float, float]]) -> Experiment:
        """Return it with maps moved so that their scars lie on the middle of the contact."""
        parts = []
        for reading, row in self.table.groupby(level=0):
            rows = row.assign(reading=reading)
            if row["quantity"].iloc[0] == DEPTH_MAP:
                rows = self._of_map(rows, shifts.get(reading, (0.0, 0.0)))
            parts.append(rows)
        return replace(self, data=pd.concat(parts, ignore_index=True))

    def on_cells(self, reading: int, shift: tuple[float, float]) -> tuple[Array, Array]:
        """Return a map on the cells of its surface, in m, and its noise; see `cells.on_cells`.

        0 for a map that is not measured yet.
        """
        row = self.table.loc[reading]
        model = self.setups[row["setup"]].model
        shape = surface_shape(model, row["body"])
        if reading not in self.heights:
            return np.zeros(shape), np.ones(shape)
        with located(f"{row['place']}.depth"):
            return on_cells(self.heights[reading], shape, model.grid.spacing, shift)

    def _of_map(self, row: pd.DataFrame, shift: tuple[float, float]) -> pd.DataFrame:
        """Return a row of the table for each block of cells of a map."""
        (each,) = row.itertuples()
        depth, noise = self.on_cells(each.Index, shift)
        if error := data_error(each.entry.sigma, depth[np.isfinite(depth)]):
            raise CaseError(error, f"{each.place}.depth")
        blocks = block_means(depth, noise, self.setups[each.setup].model.grid.spacing)
        if each.entry.depth is None:
            blocks["measured"] = math.nan
        blocks[["shift_x_m", "shift_y_m"]] = shift
        rows = row.loc[row.index.repeat(len(blocks))].reset_index(drop=True).assign(**blocks)
        rows["sigma"] *= rows["noise"]
        return rows

    def centred(self) -> Experiment:
        """Return it with maps moved so that their scars lie where the first run has them."""
        shifts = {}
        for reading, depth in self._readings_of(self.start).maps.items():
            if reading in self.heights:
                model = self.setups[self.table.loc[reading, "setup"]].model
                shifts[reading] = find_shift(self.heights[reading], depth, model.grid.spacing)
        return self.moved(shifts) if shifts else self

    def run(self, values: Array) -> SetupRun:
        """Return a run with one response per row of the data, then per prediction."""
        return self.of_data(self._readings_of(values))

    def of_data(self, made: SetupRun) -> SetupRun:
        """Return a run of readings with one response per row of the data, then per prediction."""
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

    def _readings_of(self, values: Array) -> SetupRun:
        """Return the readings of a run, which is cached."""
        key = values.tobytes()
        if key in self.runs:
            return self.runs[key]
        responses, grid_sigma = np.empty((2, len(self.table) + len(self.predicted)))
        runs: dict[str, tuple[Finding, list[str]]] = {}
        maps: dict[int, Array] = {}
        for i, (rows, wanted) in enumerate(self.readings):
            tables, name = self.setups[i].tables, f"run {self.run_count + i + 1}"
            made = make_run(tables, self.parameters, values, wanted, name)
            responses[rows], grid_sigma[rows] = made.responses, made.grid_sigma
            for j, depth in made.maps.items():
                shape = surface_shape(self.setups[i].model, wanted[j].body)
                maps[int(rows[j])] = depth[: shape[0]]
            for finding in made.findings:
                names = runs.setdefault(str(finding), (finding, []))[1]
                names.append(self.setups[i].name or "the case as it is")
        positive = ~self.table["quantity"].isin(FIELDS).to_numpy()
        none = ~(responses > 0)[: len(self.table)]
        for each in self.table[positive & none].itertuples():
            value, remedy = responses[each.Index], "begin with more wear: give start in fit"
            if np.isnan(value):
                raise CaseError(f"the case gives no {named(each)}; leave it out", each.place)
            raise CaseError(f"the case gives {value:g} as {named(each)}; {remedy}", each.place)
        findings = tuple(
            of_run(finding, () if len(names) == len(self.setups) else names)
            for finding, names in runs.values()
        )
        self.runs[key] = SetupRun(responses, grid_sigma, maps, findings)
        return self.runs[key]

    def problem(self, values: Array) -> Problem:
        """Return the least-squares problem, with the errors of the grid in a run of `values`."""
        data, run = self.data, self.run(values)
        sigma = np.hypot(data["sigma"], run.grid_sigma[: len(data)]).to_numpy()
        depths = data["measured"].fillna(pd.Series(run.responses[: len(data)])).abs()
        largest = depths.groupby(data["place"]).transform("max")
        is_field = data["quantity"].isin(FIELDS)
        small = np.where(is_field, np.maximum(LINEAR_BELOW * largest, data["sigma"]), 0.0)
        with np.errstate(divide="ignore"):
            lower, upper = np.log([(p.lower, p.upper) for p in self.parameters]).T
        return Problem(
            names=tuple(p.path for p in self.parameters),
            observed=data["measured"].to_numpy(),
            sigma=sigma,
            specimen=data["specimen"].to_numpy(),
            repeatability=self.repeatability,
            small=np.append(small, np.zeros(len(self.predicted))),
            lower=lower,
            upper=upper,
            common=self._common(run),
        )

    def _common(self, run: SetupRun) -> Array:
        """Return `Problem.common`: errors of the grid, and shifts of maps, in a whole field."""
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
                sources.append(PRIOR_SHIFT * spacing[axis] * depth.shape[axis] * slope)
            for source in sources:
                add(rows, means_over(source, self.data["cells"].iloc[rows]))
        return np.array(columns).reshape(-1, len(self.data)).T


def check_sizes(data: pd.DataFrame, computed: Array, parameters: Sequence[Parameter]) -> None:
    """Refuse entries that differ from the first run by a factor above 300, with a line for each."""
    given = ", ".join(f"{p.path} = {in_si(p.start, p.unit)}" for p in parameters)
    sizes = data[["unit", "sigma"]].assign(
        value=data["measured"].abs(), own=np.abs(computed[: len(data)])
    )
    refused = [
        f"{place} was read as {in_si(value, unit)}, and the case gives {in_si(own, unit)} with "
        f"{given}: check the value and its unit, or give a start in fit that is nearer to it"
        for place, unit, sigma, value, own in (
            sizes.groupby(data["place"], sort=False).max().itertuples()
        )
        # A value below its uncertainty is only an upper limit.
        if own > REFUSED * max(value, sigma) or value > REFUSED * own > 0
    ]
    if refused:
        raise CaseError("\n".join(refused))
