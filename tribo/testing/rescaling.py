"""The same model, asked the same, in other units of length, mass, time and temperature."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np
from pydantic import BaseModel

from tribo.core.fields import Field
from tribo.core.material import Material
from tribo.core.units import each_in, quantities, scale
from tribo.testing.compare import NotApplicable, mapped

T = TypeVar("T")

_POWERS = (6, -11, 3, -5, 0, 0)
"""Powers of 2, which cost no digit, by which numbers in m, kg, s, K, mol and laps grow. In these
units the gas constant, Boltzmann's and Stefan's constants and the acceleration of free fall have
the numbers that they have in SI, so that a model may know them."""


def factor(unit: str) -> float:
    """Return by what a number in an SI unit is multiplied."""
    dimension = scale(unit)[1]
    return 2.0 ** sum(power * n for power, n in zip(_POWERS, dimension, strict=True))


def units_of(fields: Mapping[str, Field]) -> dict[str, float]:
    """Return by what values in the units of some fields are multiplied, by the fields' names."""
    return {name: factor(field.unit) for name, field in fields.items()}


UNITS: Mapping[str, float] = MappingProxyType(
    {
        name: factor(unit)
        for unit, names in {
            "m": "distance track gap rate own",
            "1/m": "curvature",
            "s": "time",
            "m/s": "speed",
            "N": "load",
            "Pa": "pressure modulus cap",
            "m/Pa": "local",
            "1/Pa": "swept slope",
        }.items()
        for name in names.split()
    }
)
"""Factors of what components are given, by its name."""


def rescaled(table: T) -> T:
    """Return a table, or a component, with its quantities in the other units."""
    cls: Any = type(table)
    return renewed(
        table,
        {name: _rescaled(field, getattr(table, name)) for name, field in cls.model_fields.items()},
    )


def renewed(table: T, values: Mapping[str, Any]) -> T:
    """Return a table of the same class with some values, beyond its bounds if need be."""
    cls: Any = type(table)
    values = {name: values.get(name, getattr(table, name)) for name in cls.model_fields}
    try:
        made: T = cls.model_validate(values)
    except ValueError:
        made = cls.model_construct(**values)
    return made


def _rescaled(annotation: Any, value: Any) -> Any:
    if isinstance(value, BaseModel):
        return rescaled(value)
    if isinstance(value, Path):
        raise NotApplicable(f"{value.name} is in the units that it is in")
    if isinstance(value, Mapping):
        return {key: _rescaled(annotation, inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        inside = zip(each_in(annotation, len(value)), value, strict=True)
        return type(value)(_rescaled(of, inner) for of, inner in inside)
    unit = next((mark.unit for mark in quantities(annotation)), "1")
    return value * factor(unit) if isinstance(value, float | np.ndarray) else value


def in_other_units(value: T, units: Mapping[str, float]) -> T:
    """Return nested values in the other units, each by the factor of the innermost known name."""

    def change(path: tuple[Any, ...], inner: Any) -> Any:
        if isinstance(inner, Material) and inner.properties:
            others = {name: value * units[name] for name, value in inner.properties.items()}
            return renewed(rescaled(inner), {"properties": others})
        if isinstance(inner, BaseModel):
            return rescaled(inner)
        known = (units[name] for name in reversed(path) if name in units)
        return inner * next(known, 1.0) if isinstance(inner, float | np.ndarray) else inner

    return mapped(value, change)
