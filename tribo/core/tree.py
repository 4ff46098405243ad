"""A table of a case as a short tree: what is not at its default, in readable units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import BaseModel

from tribo.core.table import given
from tribo.core.units import quantities, stated

_INDENT = "  "


def tree(table: BaseModel) -> str:
    """Return a table as lines: its numbers beside its name, the tables in it indented below."""
    return "\n".join(_lines(type(table).__name__, table))


def _lines(name: str, value: Any, depth: int = 0) -> Iterator[str]:
    inside: dict[str, Any] = {}
    beside = [value.type] if hasattr(value, "type") else []
    if isinstance(value, BaseModel):
        fields = type(value).model_fields
        for key, inner in given(value).items():
            if _is_table(inner):
                inside[key] = inner
            else:
                beside.append(f"{key} {_text(inner, fields[key])}")
    else:
        pairs = value.items() if isinstance(value, Mapping) else enumerate(value)
        inside = {str(key): inner for key, inner in pairs}
    yield _INDENT * depth + f"{name}: {', '.join(beside)}".removesuffix(": ")
    for key, inner in inside.items():
        yield from _lines(key, inner, depth + 1)


def _is_table(value: Any) -> bool:
    if isinstance(value, Mapping):
        return True
    inner = value[:1] if isinstance(value, tuple) else (value,)
    return any(isinstance(each, BaseModel) for each in inner)


def _text(value: Any, field: Any) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(_text(each, field) for each in value)}]"
    unit = next((mark.unit for mark in quantities(field)), "1")
    return stated(value, unit) if isinstance(value, float) else str(value)
