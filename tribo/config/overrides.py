"""Change and list the values of a case by path, as ``load.normal``."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

from pydantic import BaseModel

from tribo.case import SHORT
from tribo.component import Component
from tribo.core.errors import CaseError, located
from tribo.core.units import Quantity, each_in, quantities
from tribo.core.words import shown


def apply_settings(
    data: Mapping[str, Any], settings: Mapping[str, Any] | Sequence[str] | str
) -> dict[str, Any]:
    """Return `data`, tables as read from TOML, with values replaced; it is left unchanged.

    `settings` are values by path, as TOML would give them, or texts ``"effects.1.rate=2"``, whose
    value is read as TOML or else as text. Entries of a list count from 1. Setting ``type``, or the
    ``name`` of a material, to another one drops the other keys of the table, which belong to the
    former; such changes are made first, in any order. Of several values for one path the last
    counts. Missing tables are added; unknown keys are left to the validation. `CaseError` if a path
    leads through a value that is not a table.
    """
    if isinstance(settings, str):
        settings = [settings]
    pairs = settings.items() if isinstance(settings, Mapping) else map(_pair, settings)
    changes = [(path_keys(path), value) for path, value in pairs]
    changed = dict(data)
    first = [change for change in changes if _decides(change[0])]
    others = [change for change in changes if not _decides(change[0])]
    for keys, value in sorted(first, key=lambda change: len(change[0])) + others:
        changed = _changed(changed, keys, value)
    return changed


def path_keys(path: str) -> list[str]:
    """Return the keys of a path; a key may be quoted as in TOML."""
    try:
        table: Any = tomllib.loads(f"{path} = 0") if "\n" not in path else {}
    except ValueError:
        table = {}
    keys = []
    while isinstance(table, dict) and len(table) == 1:
        ((key, table),) = table.items()
        keys.append(key)
    if not keys:
        raise CaseError(f"{shown(path)} is not a path to a value of a case, as load.normal is")
    return keys


def parse_value(text: str) -> Any:
    """Return the value of a text as TOML, or else the text; `CaseError` if a bracket is first."""
    with suppress(ValueError, RecursionError):
        read = tomllib.loads(f"value = {text}")
        if len(read) == 1:
            return read["value"]
    if text.startswith(("[", "{")):
        raise CaseError(f'{shown(text)} is not TOML; quote texts in it, as "5 mm"')
    return text


def leaves(
    value: object, annotation: Any = None, place: tuple[str | int, ...] = ()
) -> Iterator[tuple[tuple[str | int, ...], Any, Quantity | None]]:
    """Yield keys, value and quantity of every value in a case that is not a table or list."""
    if isinstance(value, BaseModel):
        if isinstance(value, Component):
            yield (*place, "type"), value.type, None
        for name, field in type(value).model_fields.items():
            yield from leaves(getattr(value, name), field, (*place, name))
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield from leaves(item, annotation, (*place, str(key)))
    elif isinstance(value, list | tuple):
        inside = each_in(annotation, len(value))
        for count, (of, item) in enumerate(zip(inside, value, strict=True), 1):
            yield from leaves(item, of, (*place, count))
    else:
        yield place, value, next(quantities(annotation), None)


def leaves_at(case: BaseModel, path: str) -> list[tuple[str, Any, str]]:
    """Return path, value and unit ("1" for none) of all `leaves` at or below a path."""
    keys = path_keys(path)
    return [
        (".".join(map(str, place)), value, mark.unit if mark else "1")
        for place, value, mark in leaves(case)
        if [str(key) for key in place[: len(keys)]] == keys
    ]


def _pair(text: str) -> tuple[str, Any]:
    path, equals, value = text.partition("=")
    if not equals:
        raise CaseError(f"{shown(text)} is not of the form path=value, as in --set load.normal=50")
    with located(path.strip()):
        return path.strip(), parse_value(value.strip())


def _decides(keys: Sequence[str]) -> bool:
    """Whether the last of some keys decides on the other keys of its table."""
    return keys[-1] == ("name" if keys[-2:-1] == ["material"] else "type")


def _changed(inside: Any, keys: list[str], value: Any, above: tuple[str, ...] = ()) -> Any:
    """Return a copy of what is at `above`, with `value` at `keys` in it."""
    if not keys:
        return value
    key, *rest = keys
    short = SHORT.get(".".join(above))
    if short and not (isinstance(inside, Mapping) or key.isdigit()):
        inside = {short: inside}
    if isinstance(inside, str):
        # The name of a material or a component is short for a table with its name or type.
        inside = {"name" if above[-1:] == ("material",) else "type": inside}
    if isinstance(inside, Mapping):
        if not rest and above and _decides([*above, key]):
            return inside if inside.get(key) == value else {key: value}
        return {**inside, key: _changed(inside.get(key, {}), rest, value, (*above, key))}
    if not isinstance(inside, list):
        raise CaseError("is not a table; nothing in it can be set", ".".join(above))
    at = int(key) - 1 if key.isascii() and key.isdigit() else -1
    if not 0 <= at < len(inside):
        words = f"{key!r} is no entry of this list; allowed: 1 to {len(inside)}"
        raise CaseError(words, ".".join(above))
    return [*inside[:at], _changed(inside[at], rest, value, (*above, key)), *inside[at + 1 :]]
