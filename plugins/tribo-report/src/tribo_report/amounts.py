"""Values of a case in words and in an engineer's units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np
from pydantic import BaseModel
from tribo import CaseError, Component, Quantity, WearLaw
from tribo.kernel_api import default_registry, parts, scale, time_labels

_UNITS = {
    "m": ("m", "mm", "µm", "nm"),
    "Pa": ("GPa", "MPa", "kPa", "Pa"),
    "s": ("h", "min", "s", "ms"),
    "N": ("kN", "N", "mN"),
    "m^2": ("mm^2",),
    "m^3": ("mm^3",),
}
_LONG = 6
"""Most items of a list that are written out, which fill a line."""


def amount(value: float, unit: str) -> str:
    """Return a value, in SI, with the largest unit in which it is 1 or more."""
    if unit == "1":
        return f"{value:.4g}"
    if unit == "K":
        # A temperature in °C has two decimals in K.
        return f"{value:.6g} K"
    known = _UNITS.get(unit, (unit,))
    fitting = next((u for u in known if abs(value) >= float(scale(u)[0])), known[-1])
    factor = float(scale(fitting)[0]) if unit in _UNITS else 1.0
    if value == 0:
        return "0"
    return f"{value / factor:.4g} {fitting}".replace("^2", "²").replace("^3", "³")


def component_words(config: Mapping[str, Any]) -> str:
    """Return the type of a component and its values, those left out of the case too."""
    words = value_words(config, component(config))
    return f"{config.get('type', '')}, {words}".removesuffix(", ")


def component(config: Mapping[str, Any]) -> type[Component] | None:
    """Return the class of a component; None if it is not installed."""
    with suppress(CaseError):
        return default_registry().find(str(config.get("type", "")))
    return None


def part_words(table: type[BaseModel], key: str, value: Any) -> str:
    """Return a part of the case, or of a body, in words; "" if it is left out."""
    words = _value(value, _marks(table, key)) if value else ""
    return words[1:-1] if words.startswith("(") else words


def value_words(config: Mapping[str, Any], table: type[BaseModel] | None) -> str:
    """Return the values of a table of the case, in the units that its model says."""
    return ", ".join(_values(config, table))


def _in_stages(value: Any, key: str) -> bool:
    """Return whether a value is given in stages, as tables with its own key."""
    listed = isinstance(value, list | tuple) and len(value) > 0
    return listed and all(isinstance(stage, Mapping) and key in stage for stage in value)


def _stage_words(stages: Sequence[Mapping[str, Any]], key: str, unit: str) -> str:
    """Return until when each stage goes; of many stages the first and the last."""
    told, times = [], time_labels(np.array([stage.get("until") or stage["at"] for stage in stages]))
    for stage, time in zip(stages, times, strict=True):
        level = amount(float(stage[key]), unit) if stage[key] else "pause"
        # A load is held to a time, or reached at a time in a straight line.
        told.append(f"{level} {'to' if stage.get('until') else 'at'} {time}")
    if len(told) > _LONG:
        return f"{told[0]}, …, {told[-1]} ({len(told)} stages)"
    return ", ".join(told)


def _values(config: Mapping[str, Any], table: type[BaseModel] | None) -> Iterator[str]:
    for key, value in config.items():
        if key == "type" or value is None or value is False or value == []:
            continue
        name = key.replace("_", " ")
        if isinstance(value, bool):
            yield name
            continue
        marks = _marks(table, key)
        staged = _in_stages(value, key)
        words = _stage_words(value, key, _unit(marks)) if staged else _value(value, marks)
        of_law = table is not None and issubclass(table, WearLaw)
        if of_law and _unit(marks) == "1/Pa" and isinstance(value, int | float):
            words += f" = {1e9 * value:.4g} mm³/(N·m)"
        yield f"{name} {words}"


def _value(value: Any, marks: Sequence[Any]) -> str:
    """Return a value in the unit, or by the table, that its annotation names."""
    if isinstance(value, Mapping):
        if "type" in value:
            return component_words(value)
        table = next((m for m in marks if isinstance(m, type) and issubclass(m, BaseModel)), None)
        if table is not None and value.keys() <= table.model_fields.keys():
            return f"({value_words(value, table)})"
        # By the names of bodies, say.
        return ", ".join(f"{key} {_value(each, marks)}" for key, each in value.items())
    if isinstance(value, Sequence) and not isinstance(value, str):
        if len(value) > _LONG or not all(isinstance(each, int | float) for each in value):
            return f"({len(value)} values)"
        return ", ".join(amount(float(each), _unit(marks)) for each in value)
    if isinstance(value, int | float):
        return amount(float(value), _unit(marks))
    return str(value).replace("_", " ")


def _marks(table: type[BaseModel] | None, key: str) -> list[Any]:
    """Return all types and marks of the annotation of a table's key."""
    field = None if table is None else table.model_fields.get(key)
    return [] if field is None else [*parts(field)]


def _unit(marks: Sequence[Any]) -> str:
    return next((mark.unit for mark in marks if isinstance(mark, Quantity)), "1")
