"""The tests that a case is fitted to: what is run, and what is read off."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from tribo.case import Case
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, NumericalError, TriboWarning
from tribo.registry.registry import Registry
from tribo.simulation.model import Model
from tribo.simulation.positions import chosen
from tribo.simulation.run import Simulation
from tribo.study.calibration.measured import Measured, Tested
from tribo.study.calibration.parameters import Parameter
from tribo.study.calibration.quantities import (
    AXES,
    EDGES,
    PROFILES,
    QUANTITIES,
    Reading,
    read,
    unavailable,
)
from tribo.study.variation import unknown_body, valid_case


@dataclass(frozen=True)
class Bench:
    """One case among the tests, and all that is read off its runs.

    Parameters
    ----------
    name : str
        Of the first test.
    case, tables : Mapping
        Tables of the case, and with what the readings need.
    model : Model
        What is run.
    rows : list of int
        The measured numbers, by their row in `Measurements.table`.
    measured, predicted : list of Reading
        What is read off: what was measured, and what else there is at the end.
    """

    name: str
    case: Mapping[str, Any]
    tables: Mapping[str, Any]
    model: Model
    rows: list[int]
    measured: list[Reading]
    predicted: list[Reading]

    @property
    def wanted(self) -> list[Reading]:
        """All that is read off."""
        return [*self.measured, *self.predicted]

    def edge(self, quantity: str) -> float:
        """Return the standard deviation of a diameter due to the grid; else 0."""
        if quantity not in AXES or quantity in PROFILES:
            return 0.0
        return EDGES * self.model.grid.spacing[AXES[quantity]]


def benches(
    tables: Mapping[str, Any],
    tests: Mapping[str, Tested],
    data: pd.DataFrame,
    registry: Registry | None = None,
) -> list[Bench]:
    """Return the cases of the tests, those alike as one, and add the column `bench` to the data.

    Raises
    ------
    CaseError
        If what a test sets or measures does not go with the case.
    """
    cases: dict[str, tuple[Tested, Case, Model]] = {}
    of = []
    given = validate_case(tables, registry=registry).output.save_times
    for place, test in tests.items():
        try:
            # A test may end before times at which the case is saved.
            case = valid_case(tables, {**test.set, "output.save_times": []}, registry)
        except CaseError as error:
            raise error if not place else CaseError(str(error), f"{place}set") from None
        key = repr(case)
        cases.setdefault(key, (test, case, Simulation(case, registry).model))
        of.append([*cases].index(key))
        for i, entry in enumerate(test.measured):
            _check_entry(cases[key][2], entry, f"{place}measured[{i}]")
    data["bench"] = np.array(of)[data["of"]]
    found = []
    for number, (test, case, model) in enumerate(cases.values()):
        own = data[data["bench"] == number]
        columns = own[["body", "quantity", "time_s", "position_m"]]
        measured = [Reading(*row) for row in columns.itertuples(index=False)]
        kept = {
            "output.save_times": sorted(own["time_s"].dropna().unique().tolist()),
            "observers": [],
            **chosen(case, model),
        }
        changed = apply_settings(tables, test.set)
        reached = [time for time in given if time <= model.end_time]
        if len(reached) < len(given):
            changed = apply_settings(changed, {"output.save_times": reached})
        predicted = _not_measured(model, measured)
        found.append(
            Bench(
                test.name,
                changed,
                apply_settings(changed, kept),
                model,
                [*own.index],
                measured,
                predicted,
            )
        )
        if test.name in [other.name for other in found[:-1]]:
            raise CaseError(f"two tests that differ are called {test.name!r}; rename one", "test")
    return found


class Run(NamedTuple):
    """Responses of a run, their standard deviations due to the grid, and its notices."""

    responses: Array
    read_off: Array
    notices: tuple[str, ...]


def make_run(
    tables: Mapping[str, Any],
    parameters: Sequence[Parameter],
    values: Array,
    wanted: Sequence[Reading],
    registry: Registry | None = None,
    name: str = "run",
) -> Run:
    """Run a case with other values of its parameters, and read numbers off the result."""
    # Taking logarithms may round to just beyond a bound.
    settings = {
        p.path: min(max(float(value), p.lower), p.upper)
        for p, value in zip(parameters, values, strict=True)
    }
    with warnings.catch_warnings():
        # The calibration has the notices of the last run.
        warnings.simplefilter("ignore", TriboWarning)
        try:
            case = validate_case(apply_settings(tables, settings), registry=registry)
            result = Simulation(case, registry).run()
        except (CaseError, NumericalError) as error:
            named = ", ".join(f"{path} = {value:.4g}" for path, value in settings.items())
            raise type(error)(f"{name}, with {named}: {error}") from error
    with result:
        given, blurred = np.array([read(result, each) for each in wanted]).T
        return Run(given, blurred, result.notices)


def _check_entry(model: Model, entry: Measured, place: str) -> None:
    if entry.body not in model.bodies:
        raise unknown_body(entry.body, model.bodies, f"{place}.body")
    reason = unavailable(model, entry.body, entry.quantity)
    if reason:
        raise CaseError(reason, f"{place}.quantity")
    if entry.time is not None and entry.time > model.end_time * (1 + 1e-12):
        raise CaseError(
            f"{entry.time:g} s is not reached: the run ends at {model.end_time:g} s",
            f"{place}.time",
        )
    for position in entry.position or ():
        half = 0.5 * model.grid.size[AXES[entry.quantity]]
        if abs(position) > half:
            raise CaseError(
                f"{1e3 * position:g} mm lies outside the window, which reaches "
                f"{1e3 * half:g} mm from the centre",
                f"{place}.position",
            )


def _not_measured(model: Model, measured: Sequence[Reading]) -> list[Reading]:
    """Return all quantities at the end of the run that were not measured."""
    known = {
        (entry.body, entry.quantity)
        for entry in measured
        if not entry.time_s < model.end_time * (1 - 1e-12)
    }
    return [
        Reading(body, quantity)
        for body in model.bodies
        for quantity in QUANTITIES
        if quantity not in PROFILES
        and (body, quantity) not in known
        and not unavailable(model, body, quantity)
    ]
