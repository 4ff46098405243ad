"""Units that a person would choose for numbers on axes and in legends."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from tribo.core.arrays import Array
from tribo.core.column import labelled
from tribo.core.units import scale

_UNITS = {
    "m": ("mm", "µm", "nm", "pm"),
    "Pa": ("MPa", "kPa", "Pa"),
    "m^2": ("mm²",),
    "m^3": ("mm³",),
    "1/Pa": ("mm³/(N·m)",),
    "m^3/J": ("mm³/J",),
}
"""Units that are shown, by SI unit, the largest first."""
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

UNITS = ("1/Pa", "m/s", "J/m^2", "m^3", "m^2", "J", "N m", "N", "s", "Pa", "m")
"""Units of columns; the inverse of a pressure comes before the pressure, whose end is the same."""
NAMES = {
    "load.normal": "normal load",
    "wear.k": "specific wear rate",
    "wear_volume": "worn volume",
    "surface.radius": "radius",
    "grid.cells": "cells along an edge",
    "kinematics.speed": "sliding speed",
}
"""Labels of paths of a case and of columns, without the name of the body."""


def size(unit: str) -> float:
    """Return the size of a unit in SI."""
    return float(scale(unit)[0])


def fitting(si: str, largest: float, least: float = 0.1) -> str:
    """Return the unit for values up to `largest`, in SI, which is at least `least` in it."""
    units = _UNITS[si]
    if largest == 0:
        return units[0]
    return next((unit for unit in units if largest / size(unit) >= least), units[-1])


def axis_units(reaches: Sequence[float]) -> list[str]:
    """Return the units of axes that reach so far, in m: one, but for lengths that differ much."""
    one = fitting("m", max(reaches))
    if min(reaches) >= 0.01 * size(one):
        return [one] * len(reaches)
    return [fitting("m", reach) for reach in reaches]


def height_unit(largest: float) -> str:
    """Return the unit of heights up to `largest`, in m: µm from 1 µm to 1 mm and of 0."""
    return fitting("m", largest, least=1.0) if largest else "µm"


def shown_in(unit: str, values: Array) -> tuple[str, float]:
    """Return the unit in which values in an SI unit are shown, "" for none, and its size in SI."""
    largest = float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values)))
    if unit not in _UNITS or (unit == "m" and largest >= 1):
        return ("" if unit == "1" else unit.replace("^2", "²").replace("^3", "³")), 1.0
    shown = height_unit(largest) if unit == "m" else fitting(unit, largest)
    power = math.floor(math.log10(largest / size(shown))) if largest else 0
    if power >= -2 or len(_UNITS[unit]) > 1:
        return shown, size(shown)
    # Matplotlib would put the power far from the unit.
    return f"10{str(power).translate(_RAISED)} {shown}", size(shown) * 10.0**power


def row_name(name: str, unit: str, values: ArrayLike) -> tuple[str, float]:
    """Return a name with the unit in which values in an SI unit are shown, and its size in SI."""
    shown, size = shown_in(unit, np.asarray(values, dtype=float))
    return f"{name}, {shown}".removesuffix(", "), size


def time_unit(times: Array) -> str:
    """Return the largest unit in which every one of `times`, in s, is a short number."""
    longest = float(np.max(times, initial=0.0))
    for unit in ("h", "min"):
        shown = times / size(unit)
        if longest >= size(unit) and np.allclose(shown, np.round(shown, 1), rtol=0.0, atol=1e-9):
            return unit
    return "ms" if 0 < longest < 1 else "s"


def time_labels(times: Array) -> list[str]:
    """Return times, in s, with four digits and all in one unit: ``"200 s"``."""
    unit = time_unit(times)
    shown = [float(time) / size(unit) for time in times]
    return [f"{time:.0f} {unit}" if time >= 1e3 else f"{time:.4g} {unit}" for time in shown]


def column_label(name: str, values: Array) -> tuple[str, str, float]:
    """Return the label of a column, the unit for its values, "" for none, and its size."""
    si = next((unit for unit in UNITS if name.endswith(labelled("", unit))), "1")
    path, body = name.removesuffix(labelled("", si)), ""
    if path.startswith("bodies."):
        _, body, path = path.split(".", 2)
    words = NAMES.get(path, path.replace("_", " ").replace(".", " ").replace("max ", "largest "))
    return f"{words} of {body}" if body else words, *shown_in(si, values)
