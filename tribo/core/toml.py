"""Values and tables as TOML."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def to_toml(tables: Mapping[str, Any]) -> str:
    """Return tables as TOML, so that `tribo.config.load.read_toml` gives them back.

    Lists and the tables in them are written in one line. A key whose value is
    None, which TOML lacks, is left out.
    """
    return "\n".join(_lines(tables, ())).strip() + "\n"


def _lines(table: Mapping[str, Any], place: tuple[str, ...]) -> list[str]:
    given = {key: value for key, value in table.items() if value is not None}
    inside = {key: value for key, value in given.items() if isinstance(value, Mapping)}
    own = [f"{_key(key)} = {inline(value)}" for key, value in given.items() if key not in inside]
    if place and (own or not inside):
        own = ["", f"[{'.'.join(map(_key, place))}]", *own]
    return own + [line for key, value in inside.items() for line in _lines(value, (*place, key))]


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _text(key)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def inline(value: Any) -> str:
    """Return a value as TOML, in one line."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, Mapping):
        pairs = (f"{_key(key)} = {inline(part)}" for key, part in value.items() if part is not None)
        return f"{{ {', '.join(pairs)} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(inline, value))}]"
    return _text(str(value))
