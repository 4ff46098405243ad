"""What is asked of a case: its tests, parameters and data, and the runs that answer."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tribo.case import Case
from tribo.config.load import case_tables, validate_case
from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.registry.registry import Registry
from tribo.study.calibration.bench import Bench, Run, benches, make_run
from tribo.study.calibration.linearised import Problem
from tribo.study.calibration.measured import Measurements, read_measurements
from tribo.study.calibration.parameters import Parameter, check_set, find_parameters
from tribo.study.calibration.quantities import PROFILES, Reading


@dataclass(frozen=True)
class Posed:
    """Parameters of a case, the tests that tell them, and what was measured.

    Parameters
    ----------
    tested : list of Bench
        The tests, those alike as one.
    parameters : list of Parameter
        What is fitted.
    data : DataFrame
        As `Measurements.table` has it, with `bench` and, as `edge`, the
        standard deviation of a computed diameter.
    repeatability : float or None
        From test to test; None if it is to be estimated.
    registry : Registry, optional
        Where to look components up.
    runs : dict
        What has been run, by the bytes of the parameters.
    """

    tested: list[Bench]
    parameters: list[Parameter]
    data: pd.DataFrame
    repeatability: float | None
    registry: Registry | None
    runs: dict[bytes, Run] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        case: Case | Mapping[str, Any] | str | Path,
        measured: Measurements | Mapping[str, Any] | str | Path,
        registry: Registry | None = None,
    ) -> Posed:
        """Read a case and measured values; CaseError if they are wrong or do not fit together."""
        tables, asked = case_tables(case), read_measurements(measured)
        if asked.map:
            raise CaseError("asks for local coefficients; see calibrate_maps", "map")
        base = validate_case(tables, registry=registry)
        data = asked.table()
        tested = benches(tables, asked.tests, data, registry)
        parameters = find_parameters(base, asked.fit, data["body"].unique())
        for place, test in asked.tests.items():
            check_set(parameters, test.set, f"{place}set")
        data["edge"] = [
            tested[each.bench].edge(each.quantity)
            for each in data[["bench", "quantity"]].itertuples()
        ]
        repeated = data[~data["below"]].groupby(
            ["bench", "body", "quantity", "time_s", "position_m"], dropna=False
        )["specimen"]
        repeatability = asked.repeatability
        if repeatability is None and not np.any(repeated.nunique() > 1):
            repeatability = 0.0
        return cls(tested, parameters, data, repeatability, registry)

    @property
    def start(self) -> Array:
        """Where the fit begins, rounded as in the fit, which works with logarithms."""
        return np.exp(np.log([p.start for p in self.parameters]))

    @property
    def predicted(self) -> list[tuple[str, Reading]]:
        """What is read off but was not measured, with the name of its test."""
        return [(bench.name, each) for bench in self.tested for each in bench.predicted]

    @property
    def made(self) -> int:
        """How many simulations were run."""
        return len(self.tested) * len(self.runs)

    def run(self, values: Array) -> Run:
        """Return the responses for parameters: those to the data, then the predictions.

        Raises
        ------
        CaseError, NumericalError
            If a run fails, or a measured quantity comes out as 0.
        """
        key = values.tobytes()
        if key in self.runs:
            return self.runs[key]
        count = len(self.data)
        responses, read_off = np.empty((2, count + len(self.predicted)))
        notices: dict[str, None] = {}
        for i, bench in enumerate(self.tested, 1):
            name = f"run {self.made + i}"
            made = make_run(
                bench.tables, self.parameters, values, bench.wanted, self.registry, name
            )
            rows = [*bench.rows, *range(count, count + len(bench.predicted))]
            count += len(bench.predicted)
            responses[rows], read_off[rows] = made.responses, made.read_off
            notices |= dict.fromkeys(made.notices)
        self._check_positive(responses)
        self.runs[key] = Run(responses, read_off, tuple(notices))
        return self.runs[key]

    def problem(self, read_off: Array) -> Problem:
        """Return what is to be fitted; the grid gives the responses as well as `read_off` says."""
        data, parameters = self.data, self.parameters
        quantities = [*data["quantity"], *(each.quantity for _, each in self.predicted)]
        return Problem(
            names=tuple(p.path for p in parameters),
            observed=data["measured"].to_numpy(),
            sigma=np.hypot(data["sigma"], read_off[: len(data)]).to_numpy(),
            below=data["below"].to_numpy(),
            specimen=data["specimen"].to_numpy(),
            repeatability=self.repeatability,
            logged=np.array([name not in PROFILES for name in quantities]),
            lower=np.array([math.log(p.lower) if p.lower > 0 else -math.inf for p in parameters]),
            upper=np.array([math.log(p.upper) for p in parameters]),
        )

    def _check_positive(self, computed: Array) -> None:
        data = self.data
        nothing = data[data["position_m"].isna() & (computed[: len(data)] <= 0)]
        for each in nothing.itertuples():
            raise CaseError(
                f"the {each.quantity} of {each.body!r} comes out as 0 in the case; begin with more "
                "wear: give start in fit",
                each.place,
            )
