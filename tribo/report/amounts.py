"""Values of a case in words and in an engineer's units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

from pydantic import BaseModel

from tribo.core.dimensions import scale
from tribo.core.errors import CaseError
from tribo.core.material import Material
from tribo.core.units import quantities
from tribo.lab.conversion import in_mm3_per_newton_metre
from tribo.registry.registry import default_registry

_UNITS = {
    "m": ("m", "mm", "µm", "nm"),
    "Pa": ("GPa", "MPa", "kPa", "Pa"),
    "s": ("h", "min", "s", "ms"),
    "N": ("kN", "N", "mN"),
    "m^3": ("mm^3",),
}
_LONG = 6
"""Most items of a list that are written out."""


def amount(value: float, unit: str) -> str:
    """Return a value, in SI, with the largest unit in which it is 1 or more."""
    if unit == "1":
        return f"{value:.4g}"
    if unit == "1/Pa":
        return f"{value:.4g} 1/Pa = {in_mm3_per_newton_metre(value):.4g} mm³/(N·m)"
    known = _UNITS.get(unit, (unit,))
    fitting = next((u for u in known if abs(value) >= float(scale(u)[0])), known[-1])
    factor = float(scale(fitting)[0]) if unit in _UNITS else 1.0
    if value == 0:
        return "0"
    return f"{value / factor:.4g} {fitting}".replace("^2", "²").replace("^3", "³")


def component_words(config: Mapping[str, Any]) -> str:
    """Return the type of a component and its values, those left out of the case too."""
    name, table = str(config.get("type", "")), None
    with suppress(CaseError):
        table = default_registry().find(name)
    return f"{name}, {value_words(config, table)}".removesuffix(", ")


def value_words(config: Mapping[str, Any], table: type[BaseModel] | None) -> str:
    """Return the values of a table of the case, in the units that its model says."""
    return ", ".join(_values(config, table))


def load_words(load: Mapping[str, Any]) -> str:
    """Return the normal load, or its range over the stages."""
    normal = load.get("normal")
    if isinstance(normal, int | float):
        return amount(float(normal), "N")
    stages = [float(s["normal"]) for s in normal or () if isinstance(s, Mapping)]
    if not stages:
        return "as the case says"
    if min(stages) == max(stages):
        return amount(stages[0], "N")
    return f"{amount(min(stages), 'N')} to {amount(max(stages), 'N')}"


def _values(config: Mapping[str, Any], table: type[BaseModel] | None) -> Iterator[str]:
    for key, value in config.items():
        if key == "type" or value is None or value is False or value == []:
            continue
        unit = _unit(table, key)
        name = key.replace("_", " ")
        if isinstance(value, Mapping):
            words = component_words(value) if "type" in value else value_words(value, Material)
            yield f"{name} {words}"
        elif isinstance(value, bool):
            yield name
        elif isinstance(value, Sequence) and not isinstance(value, str):
            yield f"{name} {_listed(value, unit)}"
        elif isinstance(value, int | float):
            yield f"{name} {amount(float(value), unit)}"
        else:
            yield f"{name} {str(value).replace('_', ' ')}"


def _listed(values: Sequence[Any], unit: str) -> str:
    if len(values) > _LONG or not all(isinstance(value, int | float) for value in values):
        return f"({len(values)} values)"
    return ", ".join(amount(float(value), unit) for value in values)


def _unit(table: type[BaseModel] | None, key: str) -> str:
    field = None if table is None else table.model_fields.get(key)
    if field is None:
        return "1"
    marks = (field.annotation, *field.metadata)
    return next((mark.unit for mark in quantities(marks)), "1")
