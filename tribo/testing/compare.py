"""Compare what components are given and what they answer, and say what is off."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import TypeVar

import numpy as np

from tribo.core.arrays import Array

T = TypeVar("T")


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


def values_in(value: object, path: str = "") -> Iterator[tuple[str, object]]:
    """Yield every value in nested dataclasses, mappings and sequences, with its path."""
    if isinstance(value, Mapping):
        for key, inner in value.items():
            yield from values_in(inner, f"{path}[{key!r}]" if path else str(key))
    elif isinstance(value, list | tuple):
        for number, inner in enumerate(value):
            yield from values_in(inner, f"{path}[{number}]")
    elif is_dataclass(value) and not isinstance(value, type):
        for part in fields(value):
            yield from values_in(getattr(value, part.name), f"{path}.{part.name}".lstrip("."))
    else:
        yield path, value


def locked(value: T) -> T:
    """Make all arrays in `value` read-only, and return it."""
    for _, part in values_in(value):
        if isinstance(part, np.ndarray):
            part.flags.writeable = False
    return value


def first_difference(one: object, other: object) -> str | None:
    """Return the path of the first value that differs by a bit, or None."""
    left, right = dict(values_in(one)), dict(values_in(other))
    for path in sorted({*left, *right}):
        if path not in left or path not in right or not _same(left[path], right[path]):
            return path or "the answer"
    return None


def _same(one: object, other: object) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        same_kind = one.shape == other.shape and one.dtype == other.dtype
        return same_kind and one.tobytes() == other.tobytes()
    return bool(one == other) or bool(one != one and other != other)  # NaN is itself here


def jump(answer: Callable[[float], Array], low: float, high: float) -> tuple[float, float]:
    """Return where between two values an answer changes most at last, and by how much."""
    below, above = answer(low), answer(high)
    for _ in range(40):
        middle = 0.5 * (low + high)
        half = answer(middle)
        if np.max(np.abs(half - below)) > np.max(np.abs(above - half)):
            high, above = middle, half
        else:
            low, below = middle, half
    return high, float(np.max(np.abs(above - below)))


def expect_close(what: str, found: Array, needed: Array, tolerance: float) -> None:
    """Fail unless two arrays agree to `tolerance` times the largest of `needed`."""
    shapes = np.shape(found), np.shape(needed)
    require(shapes[0] == shapes[1], f"{what}: shape {shapes[0]} found, {shapes[1]} needed")
    size = float(np.max(np.abs(needed), initial=0.0))
    worst = float(np.max(np.abs(np.asarray(found) - needed), initial=0.0))
    require(
        worst <= tolerance * size,
        f"{what}: off by {worst:.3g}, with values up to {size:.3g}; no more than "
        f"{tolerance:.0e} of that is allowed",
    )
