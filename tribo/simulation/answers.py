"""Hold what components answer to the contract: finite numbers, and arrays of the right shape."""

from __future__ import annotations

import math
from contextlib import suppress
from numbers import Number
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tribo.core.arrays import Array
from tribo.core.errors import PluginError


class BadValues(PluginError):
    """An answer of the right form whose values are not finite, or negative.

    A state that a step only tries may be one that a model was not made for, and
    a shorter step then does; the same answer at an accepted state is a fault.
    """


def number(who: object, what: str, value: object) -> float:
    """Return `value` as a finite float.

    Parameters
    ----------
    who : object
        Who gave it, as its text stands in the message; see `tribo.simulation.calling.named`.
    what : str
        What it is meant to be, as ``"an approach"``.
    value : object
        What was given.

    Raises
    ------
    PluginError
        If it is anything else.
    """
    if type(value) is float and math.isfinite(value):
        return value
    plain = _plain(value)
    if plain is None or plain.shape != () or not np.isfinite(plain):
        raise PluginError(f"{who} gave {what} that is not a finite number: {_shown(value)}")
    return float(plain)


def field(
    who: object, what: str, values: object, shape: tuple[int, ...], when: str = ""
) -> tuple[Array, float, float]:
    """Return `values` as finite floats of just this shape, the smallest and the largest of them.

    Parameters
    ----------
    who, what
        As in `number`.
    values : object
        What was given.
    shape : tuple of int
        What it must have.
    when : str, optional
        End of the message that says when.

    Raises
    ------
    BadValues
        If they are not finite.
    PluginError
        If they are anything else.
    """
    plain = _plain(values)
    if plain is None or plain.shape != shape:
        raise PluginError(
            f"{who} gave {what} that is not an array of shape {shape}: {_shown(values)}"
        )
    # Sums depend on the order in memory, and a checkpoint keeps but one.
    array = np.asarray(plain, dtype=np.float64, order="C")
    low, high = (
        float(np.minimum.reduce(array, axis=None)),
        float(np.maximum.reduce(array, axis=None)),
    )
    # Both are NaN if any value is.
    if not -np.inf < low <= high < np.inf:
        bad = np.count_nonzero(~np.isfinite(array))
        raise BadValues(f"{who} gave {what} that is not finite in {bad} cells{when}")
    return array, low, high


def spread(
    who: object, what: str, values: object, shape: tuple[int, ...], when: str = ""
) -> tuple[Array, float, float]:
    """Return what `field` does, for values that need only broadcast to `shape`."""
    plain = _plain(values)
    if plain is not None and plain.shape != shape:
        with suppress(ValueError):
            values = np.broadcast_to(plain, shape)
    return field(who, what, values, shape, when)


def _plain(value: object) -> NDArray[Any] | None:
    """Return `value` as an array, or None where it is not one of real numbers."""
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):
        return None
    return array if array.dtype.kind in "fiub" else None


def _shown(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype} of shape {value.shape}"
    return repr(value) if isinstance(value, Number) else f"a {type(value).__name__}"
