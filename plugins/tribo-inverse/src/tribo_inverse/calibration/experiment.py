"""The tests, parameters and data of a calibration, and runs of the model for them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from tribo import Array, Case, CaseError, Finding
from tribo.kernel_api import case_tables, validate_case

from tribo_inverse.calibration.linearised import Problem
from tribo_inverse.calibration.measured import Measurements, read_measurements
from tribo_inverse.calibration.parameters import Parameter, check_set, find_parameters
from tribo_inverse.calibration.quantities import (
    Reading,
    in_si,
)
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


@dataclass(frozen=True)
class Experiment:
    """Parameters of a case, its tests, and the measured data."""

    tables: Mapping[str, Any]
    """Of the case."""
    setups: list[Setup]
    parameters: list[Parameter]
    data: pd.DataFrame
    """`Measurements.table` with `setup`."""
    predicted: pd.DataFrame
    """Quantities at the end that were not measured: `setup`, `test` and `READ`."""
    repeatability: float | None
    """From test to test; None to estimate it."""
    runs: dict[bytes, SetupRun] = field(default_factory=dict)
    """Runs by the bytes of the parameters, with responses of the data, then of predictions."""

    @classmethod
    def of(
        cls,
        case: Case | Mapping[str, Any] | str | Path,
        measured: Measurements | Mapping[str, Any] | str | Path,
    ) -> Experiment:
        """Read a case and measured values; CaseError if they are wrong or do not fit together."""
        tables, measurements = case_tables(case), read_measurements(measured)
        if measurements.map:
            raise CaseError("asks for local coefficients; see calibrate_map", "map")
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
        return cls(tables, setups, parameters, data, unmeasured(setups, data), repeatability)

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
        """Readings of each setup, and their rows in the data followed by the predictions."""
        both = pd.concat([self.data, self.predicted], ignore_index=True)
        return [
            (own.index.to_numpy(), [Reading(*row) for row in own[READ].itertuples(index=False)])
            for _, own in both.groupby("setup")
        ]

    def run(self, values: Array) -> SetupRun:
        """Return a run, which is cached."""
        key = values.tobytes()
        if key in self.runs:
            return self.runs[key]
        responses, grid_sigma = np.empty((2, len(self.data) + len(self.predicted)))
        runs: dict[str, tuple[Finding, list[str]]] = {}
        for i, (rows, wanted) in enumerate(self.readings):
            tables, name = self.setups[i].tables, f"run {self.run_count + i + 1}"
            made = make_run(tables, self.parameters, values, wanted, name)
            responses[rows], grid_sigma[rows] = made.responses, made.grid_sigma
            for finding in made.findings:
                names = runs.setdefault(str(finding), (finding, []))[1]
                names.append(self.setups[i].name or "the case as it is")
        none = ~(responses > 0)[: len(self.data)]
        for each in self.data[none].itertuples():
            value, remedy = responses[each.Index], "begin with more wear: give start in fit"
            if np.isnan(value):
                raise CaseError(f"the case gives no {named(each)}; leave it out", each.place)
            raise CaseError(f"the case gives {value:g} as {named(each)}; {remedy}", each.place)
        findings = tuple(
            of_run(finding, () if len(names) == len(self.setups) else names)
            for finding, names in runs.values()
        )
        self.runs[key] = SetupRun(responses, grid_sigma, findings)
        return self.runs[key]

    def problem(self, values: Array) -> Problem:
        """Return the least-squares problem, with the errors of the grid in a run of `values`."""
        data, run = self.data, self.run(values)
        sigma = np.hypot(data["sigma"], run.grid_sigma[: len(data)]).to_numpy()
        with np.errstate(divide="ignore"):
            lower, upper = np.log([(p.lower, p.upper) for p in self.parameters]).T
        return Problem(
            names=tuple(p.path for p in self.parameters),
            observed=data["measured"].to_numpy(),
            sigma=sigma,
            specimen=data["specimen"].to_numpy(),
            repeatability=self.repeatability,
            lower=lower,
            upper=upper,
        )


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
