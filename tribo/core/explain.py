"""Error messages for the keys of a table, in the words of a case."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, get_args

from pydantic import BaseModel, ValidationError, ValidationInfo
from pydantic_core import ErrorDetails, InitErrorDetails, PydanticCustomError

from tribo.core.errors import WrongValues
from tribo.core.shorthand import call
from tribo.core.toml import inline
from tribo.core.units import parts
from tribo.core.words import did_you_mean, shown, suggestion

TOLD = "told"
"""Type of an error whose message needs no more explanation."""
UNKNOWN = "unknown_key"
_NEEDED = " is needed, "
_WORDS = {
    kind: template
    for kinds, template in {
        "float_type float_parsing": "a number is needed, {given} was given",
        "int_type int_parsing int_from_float": "a whole number is needed, {given} was given",
        "int_parsing_size": "a smaller whole number is needed, {given} was given",
        "bool_type bool_parsing": "true or false is needed, {given} was given",
        "string_type": "text is needed, {given} was given",
        "model_type model_attributes_type dict_type mapping_type": (
            "a table is needed, {given} was given"
        ),
        "list_type tuple_type set_type frozen_set_type iterable_type": (
            "a list is needed, {given} was given{listed}"
        ),
        "too_short": "at least {min_length} needed, {actual_length} given",
        "too_long": "at most {max_length} allowed, {actual_length} given",
        "missing": "missing",
        "value_error": "{error}",
    }.items()
    for kind in kinds.split()
}
"""Messages, by pydantic's type of an error."""


def told(text: str, kind: str = TOLD) -> PydanticCustomError:
    """Return an error for pydantic with a finished message."""
    return PydanticCustomError(kind, "{message}", {"message": text})


def refused(*lines: tuple[tuple[str, ...], str, object]) -> ValidationError:
    """Return the error of some keys of a table, from the place, text and value of each."""
    return ValidationError.from_exception_data("case", [_line(*line) for line in lines])


def explained(
    error: ValidationError, model: type[BaseModel], data: object, info: ValidationInfo
) -> ValidationError:
    """Return the error of a table of class `model` with its messages in the words of a case.

    `data` is what was given; the context of its validation may have a ``registry``.
    """
    fields = {field.alias or name: field for name, field in model.model_fields.items()}
    allowed = ["type", *fields] if hasattr(model, "type") and "type" not in fields else [*fields]
    lines, missing, meant = [], {}, set()
    for details in error.errors():
        kind, loc, given = details["type"], _keys_of(details, data), details["input"]
        if kind == "extra_forbidden" and len(details["loc"]) == 1:
            text, like = _unknown(details["loc"][0], allowed, data)
            meant.add(like)
            lines.append(_line(details["loc"], text, given, UNKNOWN))
        elif kind == "missing" and len(loc) == 1:
            missing[str(loc[0])] = given
        elif kind == "union_tag_not_found":
            models = get_args(fields[str(loc[0])].annotation)
            names = ", ".join(model.model_fields["type"].default for model in models)
            lines.append(_line((*loc, "type"), f"missing; allowed: {names}", given))
        else:
            loc = (*loc, "type") if kind == "union_tag_invalid" else loc
            # Errors of tables inside have their message already.
            text = message(details, *loc)
            lines.append(_line(loc, text, given, UNKNOWN if kind == UNKNOWN else TOLD))
    # A key that is misspelt is one mistake, not an unknown key and a missing one.
    for key in [key for key in missing if key not in meant]:
        # A pair has the same hint twice.
        hints = dict.fromkeys(m.hint(info) for m in parts(fields[key]) if hasattr(m, "hint"))
        lines.append(_line((key,), "; ".join(["missing", *hints]), missing[key]))
    return ValidationError.from_exception_data(error.title, lines)


def _unknown(key: object, allowed: Sequence[str], data: object) -> tuple[str, str | None]:
    """Return the message for an unknown key, and the key that it is likely to mean."""
    given = data if isinstance(data, Mapping) else {}
    # A key that is given may still be meant: an override adds its key beside it.
    like = did_you_mean(key, [name for name in allowed if name not in given])
    like = like or did_you_mean(key, allowed)
    remedy = suggestion(like)
    if not like and key in call("keys"):
        remedy = "; write it above the first table of the file."
    return f"unknown key{remedy} Allowed: {', '.join(allowed)}", like


def case_error(error: ValidationError) -> WrongValues:
    """Return pydantic's error as one exception, a line for each error, with the first path.

    Unknown keys come first: a misspelt key often explains a missing one.
    """
    lines: dict[str, list[str]] = {}
    for details in sorted(error.errors(), key=lambda details: details["type"] != UNKNOWN):
        # Entries of a list count from 1.
        keys = (key + 1 if isinstance(key, int) else key for key in details["loc"])
        texts = lines.setdefault(path(tuple(keys)), [])
        text = message(details)
        if text not in texts:
            texts.append(text)
    (place, first), *others = ((place, _either(texts)) for place, texts in lines.items())
    return WrongValues("\n".join([first, *(f"{p}: {t}" if p else t for p, t in others)]), place)


def _either(texts: Sequence[str]) -> str:
    """Return the messages of alternatives as one, which says once what was given."""
    *firsts, last = (text.partition(_NEEDED) for text in texts)
    if not all(first[1:] == (_NEEDED, last[2].partition("; ")[0]) for first in firsts):
        return "; or ".join(texts)
    return ", or ".join(needed for needed, *_ in (*firsts, last)) + "".join(last[1:])


def path(keys: tuple[str | int, ...]) -> str:
    """Return the place in a case to which keys and indices lead, as ``effects.2.type``."""
    return ".".join(
        key if key.replace("_", "").replace("-", "").isalnum() else f'"{key}"'
        for key in map(str, keys)
    )


def message(details: ErrorDetails, *keys: str | int) -> str:
    """Return the message of pydantic's error, at some keys, in the words of a case."""
    kind, given, context = details["type"], details["input"], details.get("ctx", {})
    text = details["msg"].removeprefix("Assertion failed, ")
    if kind in _WORDS:
        listed = ""
        if keys and isinstance(keys[-1], str) and isinstance(given, str | float | int | Mapping):
            listed = f"; put it in square brackets, as {keys[-1]} = [{inline(given)}]"
        text = _WORDS[kind].format(given=shown(given), listed=listed, **context)
    elif kind == "literal_error":
        text = _choice(given, context["expected"])
    elif kind == "union_tag_invalid":
        text = _choice(context["tag"], " or ".join(context["expected_tags"].split(", ")))
    if not text and isinstance(given, Mapping) and "type" in given:
        return f"{given['type']!r} refused its keys without saying why"
    text = text or f"{shown(given)} was refused without saying why"
    return text.replace("Input should", f"{shown(given)}: must")


def _line(keys: tuple[str | int, ...], text: str, given: Any, kind: str = TOLD) -> InitErrorDetails:
    return InitErrorDetails(type=told(text, kind), loc=keys, input=given)


def _keys_of(details: ErrorDetails, data: Any) -> tuple[str | int, ...]:
    """Return the keys of a location, without pydantic's marks of the alternatives it tried."""
    loc, finished = details["loc"], details["type"] in (TOLD, UNKNOWN)
    kept: list[str | int] = []
    for i, key in enumerate(loc):
        if isinstance(key, str) == isinstance(data, list | tuple):
            continue
        # What is missing is not there; a name alone stands for a table that lacks its keys.
        left_out = i == len(loc) - 1 and (finished or isinstance(data, Mapping | list | tuple))
        try:
            data = None if isinstance(data, str) else data[key]
            left_out = left_out or data is not None
        except (LookupError, TypeError):
            data = None
        if left_out:
            kept.append(key)
    return tuple(kept)


def _choice(given: object, expected: str) -> str:
    meant = did_you_mean(given, re.findall(r"'([^']*)'", expected))
    return f"{expected} is needed, {shown(given)} was given" + (suggestion(meant) if meant else "")
