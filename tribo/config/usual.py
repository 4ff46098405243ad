"""Values that are possible but so far from the usual that a unit is more likely forgotten."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, get_args

from pydantic import BaseModel

from tribo.core.units import Quantity


def unusual(value: object, place: str = "") -> list[str]:
    """Ask about each quantity that is out of its usual range.

    Parameters
    ----------
    value : BaseModel, Mapping or sequence
        A case, a table of it, or several by their place.
    place : str, optional
        Where in the case it stands.

    Returns
    -------
    list of str
        As ``"bodies.ball.surface.radius is 5 m, usual are 1e-09 to 1 m: a unit
        forgotten, as in '5 mm'?"``.
    """
    # Of a pair written as one value both are the same.
    return list(dict.fromkeys(_asked(value, (), place)))


def quantities(annotation: Any) -> Iterator[Quantity]:
    """Yield the quantities in an annotation, however it is wrapped."""
    if isinstance(annotation, Quantity):
        yield annotation
    for part in annotation if isinstance(annotation, tuple) else get_args(annotation):
        yield from quantities(part)


def _asked(value: object, annotation: tuple[Any, ...], place: str) -> Iterator[str]:
    if isinstance(value, BaseModel):
        for name, field in type(value).model_fields.items():
            declared = (field.annotation, *field.metadata)
            yield from _asked(getattr(value, name), declared, _joined(place, name))
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield from _asked(item, annotation, _joined(place, str(key)))
    elif isinstance(value, list | tuple):
        for index, item in enumerate(value):
            inside = place if isinstance(item, float) else f"{place}[{index}]"
            yield from _asked(item, annotation, inside)
    elif isinstance(value, float):
        for mark in quantities(annotation):
            doubt = mark.doubt(value)
            if doubt is not None:
                yield f"{place} is {doubt}"


def _joined(place: str, key: str) -> str:
    return f"{place}.{key}" if place else key
