"""Where a case has a key that was written in another table."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from inspect import isclass
from typing import Any, get_origin

from pydantic import BaseModel, ValidationInfo

from tribo.case import Case
from tribo.component import Component, registry_of
from tribo.core.units import parts


def home(key: object, table: type[BaseModel], info: ValidationInfo) -> str:
    """Return the end of a sentence on an unknown key of a class of tables: where it belongs."""
    roots: dict[type[BaseModel], str] = {table: "its ", Case: ""}
    for root, whose in roots.items():
        types = defaultdict(list)
        for place, each in _tables(root, "", registry_of(info)):
            if key in {field.alias or name for name, field in each.model_fields.items()}:
                types[place].append(_type(each))
        if "" in types:
            return "; write it above the first table of the file."
        outer = [at for at in types if not any(at.startswith(f"{each}.") for each in types)]
        if outer:
            return f"; write it in {' or '.join(f'{whose}{at}{_of(types[at])}' for at in outer)}."
    return "."


def _tables(
    table: type[BaseModel], place: str, registry: Any
) -> Iterator[tuple[str, type[BaseModel]]]:
    """Yield place and class of a table and of those in it, with all models that can stand there."""
    yield place, table
    for name, field in table.model_fields.items():
        inside = f"{place}.{name}".removeprefix(".")
        inside += ".NAME" * (get_origin(field.annotation) is dict)
        for part in parts(field):
            if not isclass(part) or not issubclass(part, BaseModel) or part is table:
                continue
            if Component in part.__bases__:
                kind = part.kind()  # type: ignore[attr-defined]
                yield from ((inside, registry.components[own]) for own in registry.names(kind))
            else:
                yield from _tables(part, inside, registry)


def _type(table: type[BaseModel]) -> str:
    """Return the name that stands for a class in a case; empty for a table without a type."""
    field = table.model_fields.get("type")
    return field.default if field else getattr(table, "type", "")


def _of(types: list[str]) -> str:
    return f" of type {' or '.join(map(repr, types))}" if all(types) else ""
