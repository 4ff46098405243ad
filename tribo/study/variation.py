"""Variants of a case: which values vary, and the cases that follow."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from typing import Any

from tribo.case import Case
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings, parse_value, path_keys
from tribo.core.errors import CaseError, about, located
from tribo.simulation.run import Simulation

Point = dict[str, Any]
"""The settings of a variant: values by path."""


def read_axes(texts: Iterable[str]) -> dict[str, tuple[Any, ...]]:
    """Return values by path of texts ``"path=a,b"``, or ``"path=[a, b]"`` with a list in TOML.

    Without brackets each value is read as TOML, or else as text; CaseError if
    a text is not of that form.
    """
    axes = [_axis(text) for text in texts]
    check_distinct(path for path, _ in axes)
    return dict(axes)


def points_of(vary: Mapping[str, Sequence[Any]] | Sequence[Mapping[str, Any]]) -> list[Point]:
    """Return the settings of each variant: every combination of values by path, or as listed."""
    if isinstance(vary, Mapping):
        check_distinct(vary)
        for path, values in vary.items():
            if not isinstance(values, Iterable) or isinstance(values, str | Mapping):
                raise CaseError(f"{values!r} is no list of values; give [{values!r}]", path)
        # The last path varies first.
        points = [dict(zip(vary, values, strict=True)) for values in product(*vary.values())]
    elif all(isinstance(point, Mapping) for point in vary):
        points = [dict(point) for point in vary]
    else:
        points = []
    if not any(points):
        raise CaseError('nothing varies; give values by path, as {"load.normal": [50, 100]}')
    return points


def check_distinct(paths: Iterable[str]) -> None:
    """Check that no path is given twice, quoted or not; CaseError if one is."""
    seen = set()
    for path in paths:
        keys = tuple(path_keys(path))
        if keys in seen:
            raise CaseError("varies twice; give all its values together", path)
        seen.add(keys)


def variants(data: Mapping[str, Any], points: Sequence[Point]) -> dict[str, Case]:
    """Return the cases that follow from `data` with each of the points, by their labels.

    All are validated and composed first, so that wrong input costs no run. CaseError names a
    variant that is not valid, or two of the same case.
    """
    found: dict[str, Case] = {}
    same: dict[str, str] = {}
    for point in points:
        label = _label(point)
        with about(f"with {label}"):
            case = valid_case(data, point)
        other = same.setdefault(repr(case), label)
        if other != label or label in found:
            raise CaseError(f"{other} and {label} are the same case; leave one of them out")
        found[label] = case
    return found


def valid_case(data: Mapping[str, Any], point: Point) -> Case:
    """Return the validated case that follows from `data` with one point; CaseError if not valid."""
    case = validate_case(apply_settings(data, point))
    Simulation(case)
    return case


def short_labels(points: Sequence[Point]) -> list[str]:
    """Return the values alone where all points are of the same paths, else paths and values."""
    short = [", ".join(dict.fromkeys(map(_shown, point.values()))) for point in points]
    alike = len({tuple(point) for point in points}) == 1 and len(set(short)) == len(short)
    return short if alike else [_label(point) for point in points]


def _axis(text: str) -> tuple[str, tuple[Any, ...]]:
    path, equals, given = map(str.strip, text.partition("="))
    if not equals:
        raise CaseError(
            f"{text!r} is not of the form path=values, as in --vary contact.type=winkler,dcfft"
        )
    path_keys(path)
    with located(path):
        if given.startswith("["):
            values = tuple(parse_value(given))
        else:
            values = tuple(parse_value(part.strip()) for part in given.split(","))
    if not values or "" in values:
        raise CaseError(
            f"a value is missing; write the values with commas between them, as in {path}=1,2", path
        )
    return path, values


def _label(point: Point) -> str:
    return ", ".join(f"{path}={_shown(value)}" for path, value in point.items())


def _shown(value: Any) -> str:
    """Return a value as short text: of a table its type, and its other keys."""
    if isinstance(value, Mapping):
        items = ((key, _shown(item)) for key, item in value.items())
        return " ".join(text if key == "type" else f"{key}={text}" for key, text in items)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_shown, value))}]"
    return str(value).lower() if isinstance(value, bool) else str(value)
