"""What is wrong with a case, one line an error, in the words of the case."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from tribo.config.place import Place
from tribo.config.slot import Slot
from tribo.core.errors import CaseError
from tribo.core.units import Quantity
from tribo.core.words import did_you_mean, shown, suggestion
from tribo.registry.registry import Registry, default_registry

_NEEDED = {
    "float_type": "a number",
    "float_parsing": "a number",
    "int_type": "a whole number",
    "int_parsing": "a whole number",
    "int_parsing_size": "a smaller whole number",
    "int_from_float": "a whole number",
    "finite_number": "a finite number",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "string_type": "text",
    "model_type": "a table",
    "model_attributes_type": "a table",
    "dict_type": "a table",
    "mapping_type": "a table",
    "list_type": "a list",
    "tuple_type": "a list",
    "set_type": "a list",
    "frozen_set_type": "a list",
    "iterable_type": "a list",
}
_BOUNDS = {
    "greater_than": "greater than {gt}",
    "greater_than_equal": "at least {ge}",
    "less_than": "less than {lt}",
    "less_than_equal": "at most {le}",
    "multiple_of": "a multiple of {multiple_of}",
}


def explain(
    error: ValidationError,
    model: type[BaseModel],
    data: object,
    registry: Registry | None = None,
) -> list[str]:
    """Say what is wrong with `data`.

    Parameters
    ----------
    error : ValidationError
        What pydantic raised.
    model : type
        The model that `data` was validated as.
    data : object
        The tables that were given.
    registry : Registry, optional
        The registry they were validated with; the default one if left out.

    Returns
    -------
    list of str
        ``"path: message"``, an error a line, unknown keys first: a key that is
        misspelt is often also the one that is missing.
    """
    return [
        f"{path}: {text}" if path else text for path, text in _lines(error, model, data, registry)
    ]


def case_error(
    error: ValidationError,
    model: type[BaseModel],
    data: object,
    registry: Registry | None = None,
) -> CaseError:
    """Return what `explain` says as one exception, with the path of the first line."""
    (path, first), *others = _lines(error, model, data, registry)
    return CaseError("\n".join([first, *(f"{p}: {t}" if p else t for p, t in others)]), path)


def _lines(
    error: ValidationError, model: type[BaseModel], data: object, registry: Registry | None
) -> list[tuple[str, str]]:
    known = registry or default_registry()
    errors = error.errors(include_url=False)
    places = [Place.of(details, model, data, known) for details in errors]
    meant = set()
    unknown: dict[str, list[str]] = {}
    lines: dict[str, list[str]] = {}
    for details, place in zip(errors, places, strict=True):
        if details["type"] == "extra_forbidden":
            text, sibling = _unknown_key(place)
            unknown.setdefault(place.path, []).append(text)
            meant.add(sibling)
    for details, place in zip(errors, places, strict=True):
        kind = details["type"]
        if kind == "extra_forbidden" or (kind == "missing" and place.path in meant):
            continue
        path, text = place.path, _message(details, place, known) or _unsaid(details["input"])
        if kind.startswith("union_tag"):
            path = f"{path}.type" if path else "type"
        texts = lines.setdefault(path, [])
        if text not in texts:
            texts.append(text)
    return [(path, "; or ".join(texts)) for path, texts in (unknown | lines).items()]


def _unknown_key(place: Place) -> tuple[str, str | None]:
    """Return the message for an unknown key, and the path of the key that was meant."""
    key = str(place.key)
    if place.table is None:
        return f"unknown key {key!r}", None
    allowed = [name for name in place.fields() if name not in place.siblings or name == key]
    # One that is there already may still be meant: an override adds its key beside it.
    meant = did_you_mean(key, allowed) or did_you_mean(key, place.fields())
    text = f"unknown key {key!r}{suggestion(meant)} Allowed: {', '.join(place.fields())}"
    return text, place.beside(meant) if meant else None


def _message(details: ErrorDetails, place: Place, registry: Registry) -> str:
    kind, given, context = details["type"], shown(details["input"]), details.get("ctx", {})
    if kind == "missing":
        return "missing" + "".join(f"; {hint}" for hint in _hints(place.metadata, registry))
    if kind in _NEEDED:
        return f"{_NEEDED[kind]} is needed, {given} was given"
    if kind in _BOUNDS:
        return f"{given}: must be {_BOUNDS[kind].format(**context)}"
    if kind == "too_short":
        return f"at least {_values(context['min_length'], 'needed')}, {_count(context)} given"
    if kind == "too_long":
        return f"at most {_values(context['max_length'], 'allowed')}, {_count(context)} given"
    if kind == "literal_error":
        return _choice(details["input"], context["expected"])
    if kind == "union_tag_invalid":
        return _choice(context["tag"], " or ".join(map(repr, place.tags())))
    if kind == "union_tag_not_found":
        return f"type is missing; allowed: {', '.join(place.tags())}"
    if kind == "value_error":
        return str(context["error"])
    return _plain(details["msg"])


def _unsaid(given: object) -> str:
    if isinstance(given, Mapping) and "type" in given:
        return f"{given['type']!r} refused its keys without saying why"
    return f"{shown(given)} was refused without saying why"


def _hints(metadata: Sequence[Any], registry: Registry) -> Iterator[str]:
    for mark in metadata:
        if isinstance(mark, Quantity):
            yield mark.needed
        if isinstance(mark, Slot):
            yield f"installed: {registry.choices(mark.kind)}"


def _choice(given: object, expected: str) -> str:
    meant = did_you_mean(given, re.findall(r"'([^']*)'", expected))
    return f"{expected} is needed, {shown(given)} was given" + (suggestion(meant) if meant else "")


def _values(count: int, what: str) -> str:
    return f"1 value is {what}" if count == 1 else f"{count} values are {what}"


def _count(context: dict[str, Any]) -> str:
    count = context.get("actual_length")
    if count is None:
        return "fewer were"
    return f"{count or 'none'} {'was' if count in (0, 1) else 'were'}"


def _plain(message: str) -> str:
    message = message.removeprefix("Assertion failed, ")
    return message.replace("Input should be", "must be").replace("Input should", "must")
