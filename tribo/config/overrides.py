"""Changes to a case from the command line."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

from tribo.core.depth import LEVELS, check_depth, too_deep
from tribo.core.errors import CaseError
from tribo.core.words import shown

_Override = tuple[list[str], Any]


def apply_overrides(data: Mapping[str, Any], overrides: Sequence[str]) -> dict[str, Any]:
    """Return `data` with values replaced.

    Setting the ``type`` of a table to another one drops the table's other
    keys, which belong to the former type. Such changes are made first,
    whatever the order in `overrides`; of the others, the last one counts.

    Parameters
    ----------
    data : Mapping
        Tables as read from TOML; left unchanged.
    overrides : sequence of str
        ``"path=value"``, as ``"bodies.ball.wear.k=1e-15"`` or
        ``"effects.0.rate=2"``. The value is read as TOML, or else as text.
        Missing tables are added; what no such case has is left for validation
        to find.

    Raises
    ------
    CaseError
        If an override is not of that form, or its path leads through a value
        that is no table.
    """
    return _applied(data, [_parse(text) for text in overrides])


def apply_settings(data: Mapping[str, Any], settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return `data` with values replaced, as `apply_overrides` does.

    Parameters
    ----------
    data : Mapping
        Tables as read from TOML; left unchanged.
    settings : Mapping
        Values, as TOML would give them, by path.

    Raises
    ------
    CaseError
        If a path is none, or leads through a value that is no table.
    """
    return _applied(data, [(path_keys(path), value) for path, value in settings.items()])


def path_keys(path: str) -> list[str]:
    """Return the keys of a path; a key may be quoted as in TOML.

    Raises
    ------
    CaseError
        If it is no path.
    """
    keys = _keys(path)
    if not keys:
        raise CaseError(f"{path!r} is no path to a value of a case, as load.normal is one")
    return keys


def parse_value(text: str) -> Any:
    """Return what a text says as TOML, or else the text; CaseError if it nests too deeply."""
    try:
        read = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        return text
    check_depth(read, shown(text))
    return read["value"] if len(read) == 1 else text


def _applied(data: Mapping[str, Any], overrides: Sequence[_Override]) -> dict[str, Any]:
    check_depth(data, "the case")
    for keys, value in overrides:
        path = shown(".".join(keys))
        if len(keys) > LEVELS:
            raise too_deep(path)
        check_depth(value, path)
    changed = deepcopy(dict(data))
    types = sorted((o for o in overrides if o[0][-1] == "type"), key=lambda o: len(o[0]))
    for keys, value in types + [o for o in overrides if o[0][-1] != "type"]:
        _set(changed, keys, deepcopy(value))
    return changed


def _parse(text: str) -> _Override:
    path, equals, value = text.partition("=")
    keys = _keys(path.strip())
    if not (equals and keys):
        raise CaseError(f"{text!r} is not of the form path=value, as in load.normal=50")
    return keys, parse_value(value.strip())


def _keys(path: str) -> list[str]:
    try:
        table: Any = tomllib.loads(f"{path} = 0") if "\n" not in path else {}
    except ValueError:
        return []
    keys = []
    while isinstance(table, dict) and len(table) == 1:
        ((key, table),) = table.items()
        keys.append(key)
    return keys


def _set(data: dict[str, Any], keys: list[str], value: Any) -> None:
    holder: Any = {"": data}
    place: Any = ""
    for depth, key in enumerate(keys):
        inside = holder[place]
        if isinstance(inside, str) and depth:
            # The name of a component alone stands for a table with its type.
            inside = holder[place] = {"type": inside}
        if keys[depth:] == ["type"] and depth and isinstance(inside, dict):
            holder[place] = inside if inside.get("type") == value else {"type": value}
            return
        if isinstance(inside, dict):
            if depth < len(keys) - 1:
                inside.setdefault(key, {})
            holder, place = inside, key
        elif isinstance(inside, list):
            holder, place = inside, _index(inside, keys[: depth + 1])
        else:
            raise CaseError("is no table, so that nothing in it can be set", ".".join(keys[:depth]))
    holder[place] = value


def _index(items: list[Any], keys: list[str]) -> int:
    key = keys[-1]
    if not (key.isascii() and key.isdigit() and int(key) < len(items)):
        count = f"0 to {len(items) - 1}" if items else "none: the list is empty"
        raise CaseError(f"{key!r} is no index; allowed: {count}", ".".join(keys[:-1]))
    return int(key)
