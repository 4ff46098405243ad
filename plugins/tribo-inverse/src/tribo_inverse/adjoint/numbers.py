"""The numbers of a case, by their path in it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, cast

from pydantic import BaseModel, ValidationError
from tribo import Case, CaseError
from tribo.kernel_api import did_you_mean, leaves, path_keys, suggestion

ANY = "*"
"""The key that stands for each body, as in ``bodies.*.material.hardness``."""
PHYSICS = ("bodies", "load", "kinematics", "friction", "effects", "contact", "stop")
"""Parts of a case with numbers that a result follows; the rest is its numerics and output."""


def find(case: Case, asked: Sequence[str] | None) -> list[tuple[str, list[tuple[Any, ...]], float]]:
    """Return path, places and value of the numbers asked for, or of all numbers.

    Numbers of a table, such as measured heights, must be named.

    Raises
    ------
    CaseError
        If a path leads to no number with decimals, or to several different numbers.
    """
    known = {
        place: value
        for place, value, _ in leaves(case)
        if isinstance(value, float) and place[0] in PHYSICS
        if not str(place[-1]).endswith("tolerance")
    }
    if asked is None:
        return [
            (".".join(map(str, place)), [place], value)
            for place, value in known.items()
            if value != 0
            if not any(isinstance(i, int) and isinstance(j, int) for i, j in pairwise(place))
        ]
    return [_named(known, path) for path in listed(asked)]


def listed(names: Sequence[str]) -> Sequence[str]:
    """Return names; `CaseError` for a single string, whose letters would be taken as names."""
    if isinstance(names, str):
        raise CaseError(f"a list of names is needed, {names!r} was given; give [{names!r}]")
    return names


def _named(
    known: Mapping[tuple[Any, ...], float], path: str
) -> tuple[str, list[tuple[Any, ...]], float]:
    keys = path_keys(path.replace(ANY, "any-body"))
    keys = [ANY if key == "any-body" else key for key in keys]
    places = [place for place in known if _fits(place, keys)]
    if not places:
        paths = [".".join(map(str, place)) for place in known]
        meant = suggestion(did_you_mean(path, paths))
        raise CaseError(f"is no number of {', '.join(PHYSICS)} with decimals{meant}", path)
    values = {known[place] for place in places}
    if len(values) > 1:
        raise CaseError(f"stands for different numbers: {sorted(values)}", path)
    return path, places, values.pop()


def _fits(place: Sequence[Any], keys: Sequence[str]) -> bool:
    return len(place) == len(keys) and all(
        key in (ANY, str(at)) for key, at in zip(keys, place, strict=True)
    )


def changed(case: Case, path: str, places: Sequence[Sequence[Any]], number: float) -> Case:
    """Return a case with a number at the places that a path stands for."""
    found: Any = case
    try:
        for place in places:
            found = _with(found, place, number)
    except ValidationError as error:
        raise CaseError(f"may not be {number:g}: {error.errors()[0]['msg']}", path) from None
    return cast(Case, found)


def _with(value: Any, place: Sequence[Any], number: float) -> Any:
    """Return a part of a case with the number at a place in it."""
    if not place:
        return number
    key, *rest = place
    if isinstance(value, BaseModel):
        inside = _with(getattr(value, key), rest, number)
        return type(value).model_validate({**dict(value), key: inside})
    if isinstance(value, Mapping):
        return {**value, key: _with(value[key], rest, number)}
    return tuple(_with(v, rest, number) if i == key else v for i, v in enumerate(value, 1))
