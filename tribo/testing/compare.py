"""Comparing what components are given and what they answer."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.testing.subject import require


def arrays_in(value: object, path: str = "") -> Iterator[tuple[str, Array]]:
    """Yield every array in nested dataclasses, mappings and sequences, with its path."""
    if isinstance(value, np.ndarray):
        yield path, value
    elif isinstance(value, Mapping):
        for key, inner in value.items():
            yield from arrays_in(inner, f"{path}[{key!r}]")
    elif isinstance(value, list | tuple):
        for number, inner in enumerate(value):
            yield from arrays_in(inner, f"{path}[{number}]")
    elif is_dataclass(value) and not isinstance(value, type):
        for part in fields(value):
            yield from arrays_in(getattr(value, part.name), f"{path}.{part.name}".lstrip("."))


def flattened(value: object, path: str = "") -> Iterator[tuple[str, object]]:
    """Yield every value in nested dataclasses, mappings and sequences, with its path."""
    if isinstance(value, Mapping):
        for key, inner in value.items():
            yield from flattened(inner, f"{path}[{key!r}]" if path else str(key))
    elif isinstance(value, list | tuple):
        for number, inner in enumerate(value):
            yield from flattened(inner, f"{path}[{number}]")
    elif is_dataclass(value) and not isinstance(value, type):
        for part in fields(value):
            yield from flattened(getattr(value, part.name), f"{path}.{part.name}".lstrip("."))
    else:
        yield path, value


def first_difference(one: object, other: object) -> str | None:
    """Return the path of the first value that differs by a bit, or None."""
    left, right = dict(flattened(one)), dict(flattened(other))
    for path in sorted({*left, *right}):
        if path not in left or path not in right or not _same(left[path], right[path]):
            return path or "the answer"
    return None


def _same(one: object, other: object) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        same_kind = one.shape == other.shape and one.dtype == other.dtype
        return same_kind and one.tobytes() == other.tobytes()
    try:
        return bool(one == other) or bool(one != one and other != other)  # NaN is itself here
    except Exception:
        return one is other


def expect_array(name: str, value: object, shape: tuple[int, ...]) -> Array:
    """Return `value` if it is a finite float64 array of the shape, else fail."""
    require(
        isinstance(value, np.ndarray),
        f"{name} is a {type(value).__name__}; an array of shape {shape} is needed",
    )
    array = np.asarray(value)
    require(array.shape == shape, f"{name} has shape {array.shape}; {shape} is needed")
    require(array.dtype == np.float64, f"{name} has dtype {array.dtype}; float64 is needed")
    bad = int(np.count_nonzero(~np.isfinite(array)))
    require(not bad, f"{name} is not finite in {bad} of {array.size} points")
    return array


def expect_close(what: str, found: Array, needed: Array, tolerance: float) -> None:
    """Fail unless two arrays agree to `tolerance` times the largest of `needed`."""
    require(
        np.shape(found) == np.shape(needed),
        f"{what}: shape {np.shape(found)} found, {np.shape(needed)} needed",
    )
    scale = float(np.max(np.abs(needed), initial=0.0))
    worst = float(np.max(np.abs(np.asarray(found) - needed), initial=0.0))
    require(
        worst <= tolerance * scale,
        f"{what}: off by {worst:.3g}, with values up to {scale:.3g}; no more than "
        f"{tolerance:.0e} of that is allowed",
    )
