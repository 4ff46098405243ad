"""Numbers on axes and in legends in units that a person would choose."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.result.read import Result

MM3 = 1e9
"""mm³ in a m³."""
MG = 1e6
"""mg in a kg."""


@dataclass(frozen=True)
class Unit:
    """A unit to show values in.

    Parameters
    ----------
    name : str
        As printed.
    factor : float
        Multiplies a value in SI units.
    """

    name: str
    factor: float

    def of(self, values: Array) -> Array:
        """Convert values from SI units."""
        return np.asarray(self.factor * values)


_LENGTHS = (Unit("mm", 1e3), Unit("µm", 1e6), Unit("nm", 1e9), Unit("pm", 1e12))
_PRESSURES = (Unit("MPa", 1e-6), Unit("kPa", 1e-3), Unit("Pa", 1.0))
_SECONDS, _MILLISECONDS = Unit("s", 1.0), Unit("ms", 1e3)
_TIMES = (Unit("h", 1 / 3600.0), Unit("min", 1 / 60.0), _SECONDS)


def length_unit(largest: float) -> Unit:
    """Return the unit for lengths up to `largest`, in m: mm, µm, nm or pm."""
    return _fitting(_LENGTHS, largest)


def height_unit(largest: float) -> Unit:
    """Return the unit for heights and depths up to `largest`, in m: µm from 1 µm to 1 mm."""
    return next((unit for unit in _LENGTHS if largest * unit.factor >= 1), _LENGTHS[-1])


def pressure_unit(largest: float) -> Unit:
    """Return the unit for pressures up to `largest`, in Pa: MPa, kPa or Pa."""
    return _fitting(_PRESSURES, largest)


def time_unit(times: Array) -> Unit:
    """Return the largest unit in which every one of `times`, in s, is a short number.

    The last may be longer, as after an interruption. If none serves, the one
    that suits the longest.
    """
    longest = float(np.max(times, initial=0.0))
    if longest == 0:
        return _SECONDS
    units = [unit for unit in _TIMES if longest * unit.factor >= 1] or [_MILLISECONDS]
    for part in (times, times[:-1]):
        for unit in units:
            shown = unit.of(part)
            short = np.allclose(shown, np.round(shown, 1), rtol=0.0, atol=1e-9)
            if short and np.any(part > 0):
                return unit
    return next((unit for unit in units if longest * unit.factor >= 10), units[-1])


def time_labels(result: Result) -> list[str]:
    """Return the time of each save, all in one unit: ``"200 s"``."""
    times = result.times
    unit = time_unit(times)
    return [f"{_short(unit.factor * float(time))} {unit.name}" for time in times]


def _short(value: float) -> str:
    """Return four digits of a number, and all of its whole part."""
    return f"{value:.0f}" if abs(value) >= 1e3 else f"{value:.4g}"


def _fitting(units: tuple[Unit, ...], largest: float) -> Unit:
    for unit in units:
        if largest * unit.factor >= 0.1:
            return unit
    return units[0] if largest == 0 else units[-1]
