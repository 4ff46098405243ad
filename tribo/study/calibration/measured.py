"""The file of measured values: what was measured, how well, and what to fit to it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
import pandas as pd
from pydantic import ValidationError, ValidationInfo, field_validator, model_validator

from tribo.config.load import read_toml
from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.explain import case_error
from tribo.core.table import Table
from tribo.core.units import Quantity
from tribo.study.calibration.quantities import PROFILES, QUANTITIES, in_words

FINEST = 1e-6
"""Smallest uncertainty, relative to the value: runs are good to about a thousandth."""
_BEYOND_NOISE = 3.0
"""Standard deviations below 0 from which noise does not explain a mean."""


class Measured(Table):
    """One measured quantity of one body."""

    body: str
    """Name of the body in the case."""
    quantity: Literal[
        "mass",
        "volume",
        "scar_along",
        "scar_across",
        "depth",
        "crown",
        "section",
        "profile_along",
        "profile_across",
    ]
    """What was measured; what a body lost, the diameters of its scar, its largest depth."""
    value: float | tuple[float, ...] | None = None
    """The value, with its unit; for a profile a list of depths."""
    before: Annotated[float, Quantity("kg", above=0)] | None = None
    """Instead of the value of a mass: the balance's reading before the test."""
    after: Annotated[float, Quantity("kg", above=0)] | None = None
    """The reading after it."""
    position: tuple[Annotated[float, Quantity("m")], ...] | None = None
    """Where a profile's depths were measured, from the centre of the contact."""
    uncertainty: float | None = None
    """Standard deviation; of a profile, that of each depth."""
    resolution: float | None = None
    """Smallest step that the instrument shows."""
    time: Annotated[float, Quantity("s", above=0)] | None = None
    """When it was measured; at the end if left out."""

    @field_validator("value", "uncertainty", "resolution", mode="before")
    @classmethod
    def _in_si(cls, value: Any, info: ValidationInfo) -> Any:
        name = info.data.get("quantity")
        if value is None or name is None:
            return None
        # The depths of a profile may be 0, or below it by noise.
        signed = info.field_name == "value" and name in PROFILES
        mark = Quantity(QUANTITIES[name].unit, above=None if signed else 0)
        try:
            if isinstance(value, list | tuple):
                return tuple(mark.read(part) for part in value)
            return mark.read(value)
        except CaseError as error:
            raise ValueError(str(error)) from None

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        depths = self.value if isinstance(self.value, tuple) else ()
        if self.quantity in PROFILES:
            if not depths or len(depths) != len(self.position or ()):
                raise ValueError(
                    f"{self.quantity} needs value and position, two lists of the same length, not "
                    f"{len(depths)} and {len(self.position or ())} long"
                )
        elif self.position is not None or isinstance(self.value, tuple):
            raise ValueError(
                f"{self.quantity} is one value, without position; a list goes with "
                f"{' or '.join(PROFILES)}"
            )
        is_mass = self.quantity == "mass"
        missing = [reading is None for reading in (self.before, self.after)]
        if not (all(missing) if self.value is not None else is_mass and not any(missing)):
            raise ValueError("give value" + (", or before and after" if is_mass else ""))
        if self.before is not None and self.after is not None and self.before <= self.after:
            raise ValueError(
                f"before, {1e3 * self.before:g} g, is not more than after, {1e3 * self.after:g} g: "
                "no loss was weighed, so no coefficient can be fitted to it"
            )
        if self.uncertainty is None and self.resolution is None:
            raise ValueError(
                "say how well it was measured: uncertainty (a standard deviation), resolution, "
                "or both"
            )
        largest = float(np.max(np.abs(self.values)))
        if self.sigma < FINEST * largest:
            raise ValueError(
                f"known to {in_words(self.quantity, self.sigma)}, less than a millionth of "
                f"{in_words(self.quantity, largest)}: no run is that exact; check the "
                "uncertainty and its unit"
            )
        mean = float(np.mean(self.values))
        if mean < -_BEYOND_NOISE * self.sigma / np.sqrt(len(self.values)):
            raise ValueError(
                f"the depths are negative, {1e6 * mean:.3g} µm in the mean; depths count downwards "
                "from the unworn surface, positive where it is worn: turn the sign round, or level "
                "the profile"
            )
        return self

    @property
    def values(self) -> Array:
        """What was measured, shape (n,); n = 1 but for a profile."""
        if self.before is not None and self.after is not None:
            return np.array([self.before - self.after])
        return np.atleast_1d(np.array(self.value, dtype=float))

    @property
    def from_resolution(self) -> tuple[float, float]:
        """Standard deviation and largest error that follow from the resolution.

        A reading is off by up to half a step, evenly: step/√12. A mass lost is
        the difference of two: step/√6, and at most a whole step.
        """
        step = self.resolution or 0.0
        readings = 2 if self.quantity == "mass" else 1
        return step * np.sqrt(readings / 12), step * readings / 2

    @property
    def sigma(self) -> float:
        """Standard deviation of each value, from uncertainty and resolution."""
        return float(np.hypot(self.uncertainty or 0.0, self.from_resolution[0]))


class Fitted(Table):
    """One parameter to fit."""

    path: str
    """Where it stands in the case, as ``bodies.ball.wear.k``."""
    start: float | str | None = None
    """Where to begin; at the case's own value if left out."""
    lower: float | str | None = None
    """Smallest value allowed."""
    upper: float | str | None = None
    """Largest value allowed."""


class Measurements(Table):
    """What was measured, and what is to be fitted to it."""

    fit: tuple[Fitted, ...] = ()
    """The parameters; if left out, the k of each body that something was measured of."""
    measured: tuple[Measured, ...]
    """The measured values."""

    def table(self) -> pd.DataFrame:
        """Return the measured numbers in SI, one row each.

        `place` is the entry in the file; `step_sigma` and `step_most` are the
        standard deviation and the largest error due to the resolution, `step`.
        """
        rows = []
        for i, each in enumerate(self.measured):
            step_sigma, step_most = each.from_resolution
            rows += [
                {
                    "place": f"measured[{i}]",
                    "body": each.body,
                    "quantity": each.quantity,
                    "time_s": each.time,
                    "position_m": position,
                    "unit": QUANTITIES[each.quantity].unit,
                    "measured": value,
                    "sigma": each.sigma,
                    "step": each.resolution or 0.0,
                    "step_sigma": step_sigma,
                    "step_most": step_most,
                }
                for value, position in zip(each.values, each.position or (None,), strict=True)
            ]
        return pd.DataFrame(rows).astype({"time_s": float, "position_m": float})

    @field_validator("measured")
    @classmethod
    def _some(cls, measured: tuple[Measured, ...]) -> tuple[Measured, ...]:
        if not measured:
            raise ValueError("nothing is measured; give each value as [[measured]]")
        return measured


def read_measurements(source: Measurements | Mapping[str, Any] | str | Path) -> Measurements:
    """Read measured values from a TOML file, or from its tables.

    Raises
    ------
    CaseError
        If the file cannot be read, or what it says is wrong; one line an error.
    """
    if isinstance(source, Measurements):
        return source
    data = read_toml(source) if isinstance(source, str | Path) else source
    if "bodies" in data and "measured" not in data:
        name = "this" if isinstance(source, Mapping) else f"{source}"
        raise CaseError(f"{name} is a case, not measured values; those are entries [[measured]]")
    try:
        return Measurements.model_validate(data)
    except ValidationError as error:
        raise case_error(error) from None
