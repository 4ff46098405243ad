"""Error messages for the keys of a table, in the words of a case."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import get_args

from pydantic import BaseModel, ValidationError, ValidationInfo
from pydantic_core import ErrorDetails, InitErrorDetails, PydanticCustomError

from tribo.core.errors import CaseError
from tribo.core.units import parts
from tribo.core.words import did_you_mean, shown, suggestion

TOLD = "told"
"""Type of an error whose message needs no more explanation."""
UNKNOWN = "unknown_key"
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


def told(text: str, kind: str = TOLD) -> PydanticCustomError:
    """Return an error for pydantic with a finished message."""
    return PydanticCustomError(kind, "{message}", {"message": text})


def refused_at(key: str, text: str, value: object) -> ValidationError:
    """Return the error of one key of a table."""
    details = InitErrorDetails(type=told(text), loc=(key,), input=value)
    return ValidationError.from_exception_data("case", [details])


def explained(
    error: ValidationError, model: type[BaseModel], data: object, info: ValidationInfo
) -> ValidationError:
    """Return the error of a table with every message in the words of a case.

    Parameters
    ----------
    error : ValidationError
        What pydantic raised.
    model : type
        The class of the table.
    data : object
        What was given.
    info : ValidationInfo
        How it is validated; its context may have a ``registry``.
    """
    errors = error.errors(include_url=False)
    fields = {field.alias or name: field for name, field in model.model_fields.items()}
    allowed = ["type", *fields] if hasattr(model, "type") and "type" not in fields else [*fields]
    given = set(data) if isinstance(data, Mapping) else set()
    meant = set()
    lines: list[InitErrorDetails] = []
    for details in errors:
        if details["type"] == "extra_forbidden" and len(details["loc"]) == 1:
            key = str(details["loc"][0])
            # One that is there already may still be meant: an override adds its key beside it.
            like = did_you_mean(key, [name for name in allowed if name not in given])
            like = like or did_you_mean(key, allowed)
            meant.add(like)
            text = f"unknown key {key!r}{suggestion(like)} Allowed: {', '.join(allowed)}"
            lines.append(_details(details, (key,), told(text, UNKNOWN)))
    for details in errors:
        kind, loc = details["type"], _keys_of(details, data)
        if kind == "extra_forbidden" and len(details["loc"]) == 1:
            continue
        if kind == "missing" and len(loc) == 1:
            if loc[0] not in meant:
                field = fields[str(loc[0])]
                marks = parts((field.annotation, *field.metadata))
                hints = [mark.hint(info) for mark in marks if hasattr(mark, "hint")]
                lines.append(_details(details, loc, told("; ".join(["missing", *hints]))))
            continue
        if kind.startswith("union_tag"):
            loc = (*loc, "type")
        text = message(details) or _unsaid(details["input"])
        if kind == "union_tag_not_found":
            models = get_args(fields[str(loc[0])].annotation)
            names = [m.model_fields["type"].default for m in models]
            text = f"type is missing; allowed: {', '.join(names)}"
        lines.append(_details(details, loc, told(text, kind if kind == UNKNOWN else TOLD)))
    return ValidationError.from_exception_data(error.title, lines)


def case_error(error: ValidationError) -> CaseError:
    """Return pydantic's error as one exception, a line for each error, with the first path.

    Unknown keys come first: a key that is misspelt is often also the one that is missing.
    """
    lines: dict[str, list[str]] = {}
    errors = error.errors(include_url=False)
    for details in sorted(errors, key=lambda details: details["type"] != UNKNOWN):
        texts = lines.setdefault(path(details["loc"]), [])
        text = message(details) or _unsaid(details["input"])
        if text not in texts:
            texts.append(text)
    (place, first), *others = ((place, "; or ".join(texts)) for place, texts in lines.items())
    return CaseError("\n".join([first, *(f"{p}: {t}" if p else t for p, t in others)]), place)


def path(keys: tuple[str | int, ...]) -> str:
    """Return the place in a case to which keys and indices lead, as ``effects[1].type``."""
    text = ""
    for key in keys:
        if isinstance(key, int):
            text += f"[{key}]"
        else:
            plain = key.replace("_", "").replace("-", "").isalnum()
            text += ("." if text else "") + (key if plain else f'"{key}"')
    return text


def message(details: ErrorDetails) -> str:
    """Return the message of pydantic's error in the words of a case; it may be empty."""
    kind, given, context = details["type"], shown(details["input"]), details.get("ctx", {})
    if kind in _NEEDED:
        return f"{_NEEDED[kind]} is needed, {given} was given"
    if kind in _BOUNDS:
        return f"{given}: must be {_BOUNDS[kind].format(**context)}"
    if kind == "too_short":
        length = context.get("actual_length")
        given = "fewer" if length is None else str(length)
        return f"at least {context['min_length']} needed, {given} given"
    if kind == "too_long":
        given = str(context.get("actual_length") or "more")
        return f"at most {context['max_length']} allowed, {given} given"
    if kind == "literal_error":
        return _choice(details["input"], context["expected"])
    if kind == "union_tag_invalid":
        return _choice(context["tag"], " or ".join(context["expected_tags"].split(", ")))
    if kind == "missing":
        return "missing"
    if kind == "value_error":
        return str(context["error"])
    text = details["msg"].removeprefix("Assertion failed, ")
    return text.replace("Input should be", "must be").replace("Input should", "must")


def _details(
    details: ErrorDetails, loc: tuple[str | int, ...], kind: PydanticCustomError
) -> InitErrorDetails:
    return InitErrorDetails(type=kind, loc=loc, input=details["input"])


def _keys_of(details: ErrorDetails, data: object) -> tuple[str | int, ...]:
    """Return the keys of a location, without pydantic's marks of the alternatives it tried."""
    loc, finished = details["loc"], details["type"] in (TOLD, UNKNOWN)
    kept: list[str | int] = []
    for i, key in enumerate(loc):
        inside = _get(data, key)
        # What is missing is not there; a name alone stands for a table that lacks its keys.
        left_out = i == len(loc) - 1 and (finished or isinstance(data, Mapping | list | tuple))
        if inside is not None or left_out:
            kept.append(key)
            data = inside[0] if inside else None
    return tuple(kept)


def _get(value: object, key: str | int) -> tuple[object] | None:
    if isinstance(value, Mapping) and key in value:
        return (value[key],)
    if isinstance(value, list | tuple) and isinstance(key, int) and key < len(value):
        return (value[key],)
    return None


def _unsaid(given: object) -> str:
    if isinstance(given, Mapping) and "type" in given:
        return f"{given['type']!r} refused its keys without saying why"
    return f"{shown(given)} was refused without saying why"


def _choice(given: object, expected: str) -> str:
    meant = did_you_mean(given, re.findall(r"'([^']*)'", expected))
    return f"{expected} is needed, {shown(given)} was given" + (suggestion(meant) if meant else "")
