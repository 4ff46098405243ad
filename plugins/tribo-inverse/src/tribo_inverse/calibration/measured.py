"""The file of measured values, their uncertainties, and the parameters to fit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np
import pandas as pd
from pydantic import (
    AfterValidator,
    ValidationError,
    ValidationInfo,
    field_validator,
    model_validator,
)
from tribo import Array, CaseError, Quantity, Table
from tribo.kernel_api import case_error, read_toml, to_toml

from tribo_inverse.calibration.quantities import quantity


def _parts(text: str, entry: Mapping[str, Any]) -> tuple[float, ...]:
    """Return the parts of the values of an entry that a text in per cent states."""
    try:
        part = float(text[:-1]) / 100
    except ValueError:
        raise CaseError(f"{text!r} is no number of per cent; write '5 %'") from None
    if not 0 < part < 1:
        raise CaseError(f"{text!r}: an uncertainty is above 0 % and below 100 %")
    values, are_right = _given(entry), {"value", "before", "after"} <= entry.keys()
    if are_right and not values.size:
        raise CaseError(f"{text!r} of a value that is not given; to plan, give it with a unit")
    return tuple(part * values)


def _beside(name: str, info: ValidationInfo) -> str:
    """Return the name of a file from the folder of the file of measured values, if there is one."""
    return str(Path(info.context or "", name))


BesideFile = Annotated[str, AfterValidator(_beside)]
"""Name of a file; a relative one starts at the folder of the file of measured values."""

LOCAL = "local coefficients are fitted to one map: give one [[map]], in a file of its own"
UNSEEN = "half the limit of detection stands for what was not seen, with that uncertainty"


_EXAMPLE = {"body": "ball", "quantity": "mass", "value": "2 mg", "resolution": "0.1 mg"}


class MeasuredEntry(Table):
    """One measured quantity of one body, or of a run as a package reads it."""

    body: str = ""
    """Name of the body in the case; none for a quantity of the run."""
    quantity: str
    """Measured quantity: one of `QUANTITIES`, or of a package."""
    value: float | tuple[float, ...] | None = None
    """The value with its unit; none in a planned test.

    A list of values for repeated tests.
    """
    before: Annotated[float, Quantity("kg", above=0)] | None = None
    """Instead of the value of a mass: the balance's reading before the test."""
    after: Annotated[float, Quantity("kg", above=0)] | None = None
    """The reading after it."""
    uncertainty: float | tuple[float, ...] | None = None
    """Standard deviation, of each value where it is a part of them, as ``"5 %"``."""
    resolution: float | None = None
    """Smallest step that the instrument shows."""
    time: Annotated[float, Quantity("s", above=0)] | None = None
    """When it was measured; at the end if left out."""

    @field_validator("quantity")
    @classmethod
    def _known(cls, name: str) -> str:
        try:
            quantity(name)
        except CaseError as error:
            raise ValueError(str(error)) from None
        return name

    @field_validator("value", "uncertainty", "resolution", mode="plain")
    @classmethod
    def _in_si(cls, value: Any, info: ValidationInfo) -> Any:
        if value is None or (name := info.data.get("quantity")) is None:
            return None
        is_value = info.field_name == "value"
        mark = Quantity(quantity(name).unit, above=0, remedy=UNSEEN if is_value else None)

        try:
            if info.field_name == "uncertainty" and str(value).rstrip().endswith("%"):
                return _parts(str(value).strip(), info.data)
            if is_value and isinstance(value, list | tuple):
                return tuple(map(mark.read, value))
            return mark.read(value)
        except CaseError as error:
            raise ValueError(str(error)) from None

    @model_validator(mode="after")
    def _has_its_keys(self) -> Self:
        name, found = self.quantity, quantity(self.quantity)
        for key in ("before", "after"):
            if name != "mass" and getattr(self, key) is not None:
                raise ValueError(f"{name} has no {key}; give its value")
        if found.label and self.time is not None:
            raise ValueError(f"{name} belongs to a whole run; leave time out")
        if (found.of == "run") == bool(self.body):
            raise ValueError(f"{name} is of the run; leave body out" if self.body else "give body")
        return self

    @model_validator(mode="after")
    def _has_its_numbers(self) -> Self:
        if self.value == ():
            raise ValueError("the list of values is empty; give one for each test")
        if self.before is None and self.after is None:
            return self
        if self.before is None or self.after is None or self.value is not None:
            raise ValueError("give value, or before and after")
        if self.before <= self.after:
            raise ValueError(
                f"before, {1e3 * self.before:g} g, is not more than after, {1e3 * self.after:g} g: "
                "no loss was weighed, so no coefficient can be fitted to it"
            )
        return self

    @model_validator(mode="after")
    def _says_how_exact(self) -> Self:
        if self.uncertainty is None and self.resolution is None:
            raise ValueError(
                "the uncertainty is missing; give uncertainty (a standard deviation), resolution, "
                "or both"
            )
        return self

    @property
    def values(self) -> Array:
        """One value per test, shape (n,); NaN for none."""
        given = _given(vars(self))
        return given if len(given) else np.array([np.nan])

    def rows(self) -> pd.DataFrame:
        """Return one row of `Measurements.table` per value."""
        values = pd.DataFrame({"measured": self.values})
        return values.assign(
            specimen=values.index,
            body=self.body,
            quantity=self.quantity,
            time_s=math.nan if self.time is None else self.time,
            unit=quantity(self.quantity).unit,
            sigma=self.sigma,
            step=self.resolution or 0.0,
        )

    @property
    def from_resolution(self) -> float:
        """Standard deviation of a reading, or of the difference of two."""
        readings = 2 if self.quantity == "mass" else 1
        return (self.resolution or 0.0) * math.sqrt(readings / 12)

    @property
    def sigma(self) -> Array | float:
        """Standard deviation of each value, from uncertainty and resolution."""
        return np.hypot(self.uncertainty or 0.0, self.from_resolution)


def _given(entry: Mapping[str, Any]) -> Array:
    """Return the values of an entry, none in a planned test."""
    value, before, after = (entry.get(key) for key in ("value", "before", "after"))
    if before is not None and after is not None:
        return np.array([before - after])
    return np.array([] if value is None else value, dtype=float).reshape(-1)


class FitEntry(Table):
    """One parameter to fit."""

    path: str
    """Where it stands in the case, as ``bodies.ball.wear.k``."""
    start: float | str | None = None
    """Where to begin; at the case's own value if left out."""
    lower: float | str | None = None
    """Smallest value allowed."""
    upper: float | str | None = None
    """Largest value allowed."""


def _by_path(table: Any, prefix: str = "") -> Any:
    """Return values by path; a path may be a quoted key, or tables in each other."""
    if not isinstance(table, Mapping):
        return table
    found: dict[str, Any] = {}
    for key, value in table.items():
        path = f"{prefix}{key}"
        nested = isinstance(value, Mapping) and value
        for name, item in (_by_path(value, f"{path}.") if nested else {path: value}).items():
            if name in found:
                raise CaseError(f"{name!r} is given twice", "set")
            found[name] = item
    return found


class TestEntry(Table):
    """A test, or several repeated ones, on a changed case."""

    name: str = ""
    """What it is called in tables."""
    set: Mapping[str, Any] = {}
    """Settings in which it differs from the case, by path, as ``load.normal = "50 N"``."""
    measured: tuple[MeasuredEntry, ...]
    """Values measured in it. The nth values of all lists are of the nth test."""

    @field_validator("set", mode="before")
    @classmethod
    def _flat(cls, value: Any) -> Any:
        try:
            return _by_path(value)
        except CaseError as error:
            raise ValueError(str(error)) from None


class MapEntry(Table):
    """A depth map of a body, and the prior of its local wear coefficient."""

    body: str
    """Name of the body in the case."""
    depth: BesideFile
    """File of a height map: depths in m, positive where material is gone, NaN where missing."""
    pitch: Annotated[float, Quantity("m", above=0)] | None = None
    """Distance between its pixels; the file's if left out."""
    uncertainty: Annotated[float, Quantity("m", above=0)]
    """Standard deviation of the depth of a cell of the grid; of a track that is averaged along its
    length, of the mean of a line along it."""
    spread: Annotated[float, Quantity("1", above=0, below=3)] = 0.5
    """Prior standard deviation of the logarithm of the coefficient from place to place."""
    length: Annotated[float, Quantity("m", above=0)]
    """Correlation length of the coefficient."""


class Measurements(Table):
    """Measured values, and the parameters to fit."""

    fit: tuple[FitEntry, ...] = ()
    """The parameters; if left out, the k of each measured body."""
    measured: tuple[MeasuredEntry, ...] = ()
    """Values measured in a test of the case as it is."""
    test: tuple[TestEntry, ...] = ()
    """Tests that differ from it."""
    map: tuple[MapEntry, ...] = ()
    """A depth map, instead, to which local coefficients are fitted."""
    repeatability: Annotated[float, Quantity("1", at_least=0, below=3)] | None = None
    """Relative standard deviation of the parameters from test to test; estimated if left out."""

    @property
    def tests(self) -> dict[str, TestEntry]:
        """All tests, by their place in the file."""
        own = {"": TestEntry(measured=self.measured)} if self.measured else {}
        return own | {
            f"test.{i}.": each.model_copy(update={"name": each.name or f"test {i}"})
            for i, each in enumerate(self.test, 1)
        }

    def table(self) -> pd.DataFrame:
        """Return the measured numbers in SI, one row each.

        `place` is the entry in the file, `test` the name of its test, `of` the index of the test in
        `tests`, `specimen` the number of the single test, `step` the resolution.
        """
        tables, specimens = [], 0
        for of, (place, test) in enumerate(self.tests.items()):
            named = [
                entry.rows().assign(place=f"{place}measured.{i}")
                for i, entry in enumerate(test.measured, 1)
            ]
            one = pd.concat(named).assign(test=test.name, of=of)
            one["specimen"] += specimens
            specimens = int(one["specimen"].max()) + 1
            tables.append(one)
        return pd.concat(tables, ignore_index=True)

    @model_validator(mode="after")
    def _some(self, info: ValidationInfo) -> Self:
        others = self.tests or self.fit or self.repeatability is not None
        if self.map and (others or len(self.map) > 1):
            raise ValueError(LOCAL)
        if self.map:
            return self
        if not self.tests or not all(test.measured for test in self.tests.values()):
            in_file = f"\n[[measured]]\n{to_toml(_EXAMPLE)}".rstrip()
            example = in_file if info.context else f" {{'measured': [{_EXAMPLE}]}}"
            raise ValueError(f"nothing is measured; give each value, as{example}")
        return self


def read_measurements(source: Measurements | Mapping[str, Any] | str | Path) -> Measurements:
    """Read measured values from a TOML file, or from its tables; CaseError if they are wrong."""
    if isinstance(source, Measurements):
        return source
    data: Mapping[str, Any]
    if isinstance(source, Mapping):
        data, folder = source, None
    else:
        hint = "a file of measured values has entries [[measured]]"
        data = read_toml(source, "measured values", hint)
        folder = Path(source).parent
    try:
        return Measurements.model_validate(data, context=folder)
    except ValidationError as error:
        raise case_error(error) from None
