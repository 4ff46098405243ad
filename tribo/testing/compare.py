"""Compare what components are given and what they answer, and say what is off."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np
from scipy.optimize import brentq

from tribo.core.arrays import Array

T = TypeVar("T")

_AS_THEY_ARE: Mapping[str, str] = MappingProxyType({})
Order = Callable[[list[Any]], Iterable[Any]]


class CheckFailed(AssertionError):
    """The fact that a check states does not hold."""


class NotApplicable(Exception):
    """A check says nothing about this configuration."""


def require(holds: object, message: str) -> None:
    """Raise `CheckFailed` with `message` unless `holds`."""
    if not holds:
        raise CheckFailed(message)


def apply_if(applies: object, otherwise: str) -> None:
    """Raise `NotApplicable` with the reason `otherwise` unless `applies`."""
    if not applies:
        raise NotApplicable(otherwise)


def mapped(
    value: T,
    change: Callable[[tuple[Any, ...], Any], Any],
    names: Mapping[str, str] = _AS_THEY_ARE,
    path: tuple[Any, ...] = (),
    order: Order = iter,
) -> T:
    """Return a copy of nested dataclasses, mappings and sequences with other values.

    Each value is what `change` makes of the keys that lead to it and of itself. Keys that are
    among `names` are replaced, and mappings have another `order`.
    """
    new: Any = value
    if isinstance(value, Mapping):
        items = [(names.get(key, key), inner) for key, inner in value.items()]
        new = {key: mapped(of, change, names, (*path, key), order) for key, of in order(items)}
    elif isinstance(value, list | tuple):
        numbered = enumerate(value)
        new = type(value)(mapped(of, change, names, (*path, at), order) for at, of in numbered)
    elif is_dataclass(value) and not isinstance(value, type):
        inner = {part.name: getattr(value, part.name) for part in fields(value) if part.init}
        new = replace(value, **mapped(inner, change, names, path, order))
    else:
        new = change(path, value)
    return new  # type: ignore[no-any-return]


def renamed(value: T, names: Sequence[str], others: Sequence[str]) -> T:
    """Return nested values with other names in place of some, among the keys and the values."""
    new = dict(zip(names, others, strict=True))
    return mapped(value, lambda _, v: new.get(v, v) if isinstance(v, str) else v, new)


def values_in(value: object) -> dict[str, Any]:
    """Return every value in nested dataclasses, mappings and sequences by its path."""
    values: dict[str, Any] = {}
    mapped(value, lambda path, inner: values.setdefault(".".join(map(str, path)), inner))
    return values


def locked(value: T) -> T:
    """Make all arrays in `value` read-only, and return it."""
    for part in values_in(value).values():
        if isinstance(part, np.ndarray):
            part.flags.writeable = False
    return value


def first_difference(one: object, other: object) -> str | None:
    """Return the path of the first value that differs by a bit, or None."""
    left, right = values_in(one), values_in(other)
    for path in sorted({*left, *right}):
        if path not in left or path not in right or not _same(left[path], right[path]):
            return path or "the answer"
    return None


def _same(one: object, other: object) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        same_kind = one.shape == other.shape and one.dtype == other.dtype
        return same_kind and one.tobytes() == other.tobytes()
    return bool(one == other) or bool(one != one and other != other)  # NaN is itself here


def largest_jump(answer: Callable[[float], Array], ladder: Array) -> tuple[float, float]:
    """Return where between values of a ladder an answer jumps most, and by what part of its size.

    A jump is what is left of the largest step of a point next to where the answer is in its middle.
    """
    rungs = np.stack([answer(value) for value in ladder.tolist()])
    steps, sizes = np.abs(np.diff(rungs, axis=0)), np.abs(rungs)
    # Of what is small beside the rest, a step is no jump.
    sizes = np.maximum(np.maximum(sizes[1:], sizes[:-1]), max(0.1 * np.max(sizes), 1e-300))
    at, *point = worst = np.unravel_index(int(np.argmax(steps / sizes)), steps.shape)
    middle, (low, high) = np.mean(rungs[at : at + 2], axis=0)[*point], ladder[at : at + 2]
    near = 1e-12 * (high - low)
    where = brentq(lambda value: answer(value)[*point] - middle, low, high, xtol=near)
    sides = np.clip([where - 2 * near, where + 2 * near], low, high).tolist()
    below, above = (answer(value)[*point] for value in sides)
    return float(where), float(abs(above - below) / sizes[worst])


def expect_close(what: str, found: Any, needed: Any, tolerance: float) -> None:
    """Fail unless numbers and arrays in two values agree to `tolerance` times the largest needed.

    The values may be nested, and an array may broadcast to the other.
    """
    known = values_in(found)
    for path, value in values_in(needed).items():
        if not isinstance(value, float | np.ndarray):
            continue
        one = known[path]
        size, worst = (float(np.max(np.abs(a), initial=0.0)) for a in (value, one - value))
        both = isinstance(one, float) and isinstance(value, float)
        numbers = f"{one:.6g} instead of {value:.6g}, " if both else ""
        require(
            worst <= tolerance * size,
            f"{path} {what}: {numbers}off by {worst:.3g}, with values up to {size:.3g}; no more "
            f"than {tolerance:.0e} of that is allowed".lstrip(),
        )
