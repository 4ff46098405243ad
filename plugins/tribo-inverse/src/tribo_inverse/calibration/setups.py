"""The different cases among the tests of a calibration, and runs of them."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import compress
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from tribo import Array, Case, CaseError, Finding, Observer, Simulation, TriboWarning
from tribo.kernel_api import (
    Model,
    about,
    apply_settings,
    unknown,
    valid_case,
    validate_case,
)

from tribo_inverse.calibration.measured import MeasuredEntry, TestEntry
from tribo_inverse.calibration.parameters import Parameter
from tribo_inverse.calibration.quantities import (
    AXES,
    QUANTITIES,
    Reading,
    read,
    unavailable,
)

READ = list(Reading._fields)
"""Columns of the data that are the fields of a `Reading`."""


@dataclass(frozen=True)
class Setup:
    """The case of tests under identical conditions."""

    name: str
    """Name of the first test."""
    tables: Mapping[str, Any]
    """Tables of the case, saved at the times of the readings."""
    model: Model


class SetupRun(NamedTuple):
    """Responses of a run."""

    responses: Array
    grid_sigma: Array
    """Their standard deviations due to the grid."""
    findings: tuple[Finding, ...]


def find_setups(
    tables: Mapping[str, Any],
    tests: Mapping[str, TestEntry],
    data: pd.DataFrame,
) -> list[Setup]:
    """Return the different cases of the tests, and add the column `setup` to the data."""
    cases: dict[str, tuple[Case, Model]] = {}
    tests_of: dict[str, list[TestEntry]] = {}
    indices = []
    for place, test in tests.items():
        try:
            # A test may end before times at which the case is saved.
            case = valid_case(tables, {**test.set, "output.save_times": []})
        except CaseError as error:
            raise error if not place else CaseError(str(error), f"{place}set") from None
        if (key := repr(case)) not in cases:
            cases[key] = case, Simulation(case).model
        tests_of.setdefault(key, []).append(test)
        indices.append([*cases].index(key))
        for i, entry in enumerate(test.measured, 1):
            _check_entry(cases[key][1], entry, f"{place}measured.{i}")
    names = [first.name for first, *_ in tests_of.values()]
    for name in names:
        if names.count(name) > 1:
            raise CaseError(f"two tests that differ are called {name!r}; rename one", "test")
    data["setup"] = np.array(indices)[data["of"]]
    return [_setup(tables, tests_of[key], *each) for key, each in cases.items()]


def _setup(
    tables: Mapping[str, Any], tests: Sequence[TestEntry], case: Case, model: Model
) -> Setup:
    """Return the setup of tests that have the same case."""
    changed = apply_settings(tables, tests[0].set)
    entries = [entry for test in tests for entry in test.measured]
    times = sorted({entry.time for entry in entries if entry.time is not None})
    # An observer that may end a run belongs to it.
    ending = [type(each).findings is not Observer.findings for each in case.observers]
    observers = list(compress(changed.get("observers", ()), ending))
    kept: dict[str, Any] = {"output.save_times": times, "observers": observers}
    if model.case.kinematics != case.kinematics:
        # Its positions were chosen.
        kept["kinematics.positions"] = model.data["kinematics"]["positions"]
    return Setup(tests[0].name, apply_settings(changed, kept), model)


def unmeasured(setups: Sequence[Setup], data: pd.DataFrame) -> pd.DataFrame:
    """Return `Experiment.predicted`."""
    ends = np.array([setup.model.end_time for setup in setups])
    at_end = data[~(data["time_s"] < ends[data["setup"]] * (1 - 1e-12))]
    known = {*at_end[["setup", "body", "quantity"]].itertuples(index=False, name=None)}
    rows = [
        (i, setup.name, body, quantity, math.nan)
        for i, setup in enumerate(setups)
        for body in setup.model.case.bodies
        for quantity in QUANTITIES
        if (i, body, quantity) not in known and not unavailable(setup.model, body, quantity)
    ]
    return pd.DataFrame(rows, columns=["setup", "test", *READ])


def make_run(
    tables: Mapping[str, Any],
    parameters: Sequence[Parameter],
    values: Array,
    wanted: Sequence[Reading],
    name: str = "run",
) -> SetupRun:
    """Run a case with other values of its parameters, and compute the readings."""
    # Taking logarithms may round to just beyond a bound.
    settings = {
        p.path: min(max(float(value), p.lower), p.upper)
        for p, value in zip(parameters, values, strict=True)
    }
    with warnings.catch_warnings():
        # The calibration reports the findings of its last run.
        warnings.simplefilter("ignore", TriboWarning)
        numbers = ", ".join(f"{path} = {value:.4g}" for path, value in settings.items())
        with about(f"{name}, with {numbers}"):
            case = validate_case(apply_settings(tables, settings))
            result = Simulation(case).run()
    with result:
        values, errors = np.array([read(result, each) for each in wanted]).T
        return SetupRun(values, errors, result.findings)


def _check_entry(model: Model, entry: MeasuredEntry, place: str) -> None:
    if entry.body and entry.body not in model.case.bodies:
        raise CaseError(unknown("body", entry.body, model.case.bodies), f"{place}.body")
    reason = unavailable(model, entry.body, entry.quantity)
    if reason:
        raise CaseError(reason, f"{place}.quantity")
    if entry.time is not None and entry.time > model.end_time * (1 + 1e-12):
        raise CaseError(
            f"{entry.time:g} s is not reached: the run ends at {model.end_time:g} s",
            f"{place}.time",
        )
    if entry.quantity in AXES:
        width = np.max(entry.values)
        if width > (size := model.grid.size[AXES[entry.quantity]]):
            raise CaseError(
                f"{1e3 * width:g} mm is wider than the window, {1e3 * size:g} mm: check its unit, "
                "or make grid.size larger",
                f"{place}.value",
            )
