"""What a calibration found."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from scipy.special import chdtrc

from tribo.core.arrays import Array


@dataclass(frozen=True)
class Estimate:
    """A fitted parameter.

    Parameters
    ----------
    path : str
        Where it stands in the case.
    unit : str
        SI unit of the values.
    value : float
        The estimate.
    lower, upper : float
        Ends of its interval; infinite, or 0, where the data do not bound it.
        Its bounds where it is held by one.
    resolution_share : float
        Part of its variance that comes from instruments' resolution.
    resolution_limit : float
        How far it may be off through resolution alone, in the worst case,
        relative to `value`.
    held : bool
        Whether it lies on one of its bounds, so that the data are not met as
        well as they could be and give no interval.
    """

    path: str
    unit: str
    value: float
    lower: float
    upper: float
    resolution_share: float
    resolution_limit: float
    held: bool


@dataclass(frozen=True)
class Datum:
    """A measured value beside the computed one.

    `residual` is computed less measured, in units of `sigma`, the standard
    deviation of both: of the measured value, and with which the grid gives the
    computed one; `position` is that of a profile's point, in m.
    """

    body: str
    quantity: str
    time: float | None
    position: float | None
    unit: str
    measured: float
    sigma: float
    computed: float
    residual: float


@dataclass(frozen=True)
class Expected:
    """A quantity at the end of the run that was not measured, with its interval.

    The interval is open, 0 to infinity, where it depends on a parameter that a bound holds.
    """

    body: str
    quantity: str
    unit: str
    value: float
    lower: float
    upper: float


@dataclass(frozen=True)
class Calibration:
    """Estimates, what they rest on, and what they predict.

    Parameters
    ----------
    level : float
        Probability with which each interval is to cover the truth.
    runs : int
        Simulations that it took.
    parameters : tuple of Estimate
        In the order that was asked for.
    data : tuple of Datum
        In the order they were given.
    predictions : tuple of Expected
        What else the fitted case gives.
    chi_square : float
        Sum of the squared residuals.
    degrees_of_freedom : int
        Data less the parameters that no bound holds.
    correlation : ndarray, shape (p, p)
        Between the logarithms of the parameters.
    singular_values : ndarray, shape (p,)
        Of the derivatives of the residuals by the logarithms of the
        parameters, largest first: each is the number of standard deviations
        by which a change by a factor e would show in the data.
    notes : tuple of str
        What to bear in mind.
    """

    level: float
    runs: int
    parameters: tuple[Estimate, ...]
    data: tuple[Datum, ...]
    predictions: tuple[Expected, ...]
    chi_square: float
    degrees_of_freedom: int
    correlation: Array
    singular_values: Array
    notes: tuple[str, ...]

    @property
    def settings(self) -> dict[str, float]:
        """The estimates by path, as `tribo.config.overrides.apply_settings` takes them."""
        return {each.path: each.value for each in self.parameters}

    @property
    def p_value(self) -> float | None:
        """Probability of a misfit at least as large by chance; None without data to spare."""
        if self.degrees_of_freedom == 0:
            return None
        return float(chdtrc(self.degrees_of_freedom, self.chi_square))

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data in SI units; an upper end that is open is None, a lower one 0."""
        return {
            "level": self.level,
            "runs": self.runs,
            "parameters": [_finite(asdict(each)) for each in self.parameters],
            "data": [_datum(each) for each in self.data],
            "predictions": [_finite(asdict(each)) for each in self.predictions],
            "chi_square": self.chi_square,
            "degrees_of_freedom": self.degrees_of_freedom,
            "p_value": self.p_value,
            "correlation": self.correlation.tolist(),
            "singular_values": self.singular_values.tolist(),
            "notes": list(self.notes),
        }


def _datum(each: Datum) -> dict[str, Any]:
    names = {"time": "time_s", "position": "position_m"}
    return {names.get(key, key): value for key, value in asdict(each).items()}


def _finite(values: dict[str, Any]) -> dict[str, Any]:
    """Replace what JSON cannot say."""
    return {
        key: None if isinstance(value, float) and not math.isfinite(value) else value
        for key, value in values.items()
    }
