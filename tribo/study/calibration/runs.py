"""Runs of a case with other parameters, and what they give for the measured values."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, NumericalError, TriboWarning, located
from tribo.registry.registry import Registry
from tribo.result.read import Result
from tribo.simulation.run import Simulation
from tribo.study.calibration.measured import Measured
from tribo.study.calibration.parameters import Parameter
from tribo.study.calibration.quantities import PROFILES, QUANTITIES, read_profile

Predicted = tuple[str, str]
"""A body and a quantity of it, at the end of the run."""


class Runs:
    """Runs the case with other parameters, and reads off what was measured.

    `count` is the number of runs so far, `notices` are those of the last one,
    `read_off` the standard deviations with which its grid gives the responses,
    and `positive` tells which predictions were above 0 in all of them. `logged`
    marks the responses that go as powers of the parameters; see
    `tribo.study.calibration.fit.Problem`.

    Parameters
    ----------
    tables : Mapping
        The case.
    measured : sequence of Measured
        What is read off, first.
    parameters : sequence of Parameter
        What is changed.
    predicted : sequence of Predicted
        What is read off after it.
    registry : Registry, optional
        Where to look components up.
    """

    def __init__(
        self,
        tables: Mapping[str, Any],
        measured: Sequence[Measured],
        parameters: Sequence[Parameter],
        predicted: Sequence[Predicted],
        registry: Registry | None,
    ) -> None:
        times = sorted({entry.time for entry in measured if entry.time is not None})
        self._tables = apply_settings(tables, {"output.save_times": times, "observers": []})
        self._measured = measured
        self._parameters = parameters
        self._registry = registry
        self._predicted = predicted
        self.count = 0
        self.notices: tuple[str, ...] = ()
        self.read_off = np.zeros(0)
        self.positive = np.ones(len(predicted), dtype=bool)
        plain = [np.full(len(e.values), e.quantity not in PROFILES) for e in measured]
        self.logged = np.concatenate([*plain, self.positive])

    def __call__(self, values: Array) -> Array:
        """Return the computed values of the data, and then those of the predictions."""
        # The logarithm that the fit works with may round to just beyond a bound.
        settings = {
            p.path: min(max(float(value), p.lower), p.upper)
            for p, value in zip(self._parameters, values, strict=True)
        }
        self.count += 1
        with warnings.catch_warnings():
            # The notices of the run with the estimates say the same, once.
            warnings.simplefilter("ignore", TriboWarning)
            try:
                case = validate_case(
                    apply_settings(self._tables, settings), registry=self._registry
                )
                result = Simulation(case, self._registry).run()
            except (CaseError, NumericalError) as error:
                named = ", ".join(f"{path} = {value:.4g}" for path, value in settings.items())
                raise type(error)(f"run {self.count}, with {named}: {error}") from error
        with result:
            self.notices = result.notices
            read = [
                _read(result, entry, f"measured[{i}]") for i, entry in enumerate(self._measured)
            ]
            ends = [(QUANTITIES[q], result.body(body)) for body, q in self._predicted]
            others = np.array([quantity.read(result, body, -1) for quantity, body in ends])
            blurred = np.array([quantity.read_off(result, body, -1) for quantity, body in ends])
        self.read_off = np.concatenate([*(blur for _, blur in read), blurred])
        self.positive &= others > 0
        return np.concatenate([*(values for values, _ in read), np.where(others > 0, others, 1.0)])


def _read(result: Result, entry: Measured, place: str) -> tuple[Array, Array]:
    """Return the computed values of what was measured, and how well the grid gives them."""
    body, save = result.body(entry.body), -1
    if entry.time is not None:
        with located(f"{place}.time"):
            save = result.save_at(entry.time)
    if entry.quantity in PROFILES:
        assert entry.position is not None
        depths = read_profile(result, body, save, entry.quantity, np.array(entry.position))
        return depths, np.zeros_like(depths)
    quantity = QUANTITIES[entry.quantity]
    value = quantity.read(result, body, save)
    if value <= 0:
        raise CaseError(
            f"the {entry.quantity} of {entry.body!r} comes out as 0 in the case; begin with more "
            "wear: give start in fit",
            place,
        )
    return np.array([value]), np.array([quantity.read_off(result, body, save)])
